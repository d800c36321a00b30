// Closing slits between parts: grey-scale closing of a pair of depth images (Serra 1982) by a flat disc.
#pragma once
#include "tools/reconstruct/rays.h"

namespace glcast {

/// Depths that decide filled or empty, as AxisRays::depth.
struct ClosedDepths {
    std::vector<float> front, back;
};

/// Slits narrower than 2 `radius` + 1 samples are closed when they are deeper than a few samples; everything
/// else, every convex body in particular, comes back unchanged. Radius 0 changes nothing.
ClosedDepths close_depths(const AxisRays& rays, int n, double radius);

} // namespace glcast
