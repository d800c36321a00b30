// Closing slits between parts: grey-scale closing of a pair of depth images (Serra 1982) by a flat disc.
#pragma once
#include <vector>

namespace glcast {

/// First and last depth of each pixel in samples; no_depth and -no_depth where nothing was hit.
struct EndDepths {
    std::vector<float> front, back;
};

/// Slits narrower than 2 `radius` + 1 samples are closed when they are deeper than a few samples; everything
/// else, every convex body in particular, comes back unchanged. Radius 0 changes nothing.
EndDepths close_depths(const EndDepths& captured, int n, double radius);

} // namespace glcast
