// Tangent planes at the hits: the captured normal where the depths bear it out, else fitted to the depths.
#pragma once
#include "tools/reconstruct/hits.h"

namespace glcast {

/// Fills hits.plane; n x n pixels.
void find_planes(AxisHits& hits, Axis axis, int n);

} // namespace glcast
