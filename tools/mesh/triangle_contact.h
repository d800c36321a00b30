// Do two triangles of a mesh meet anywhere but where they are joined?
#pragma once
#include <span>

#include "tools/mesh/mesh.h"

namespace glcast {

/// Exact. Triangles without a common vertex (by index) meet when they have a point in common, be it a touch;
/// with one common vertex, when they have a point in common besides it; with a common edge, when they lie
/// folded on one another.
bool triangles_meet(std::span<const glm::dvec3> positions, const Triangle& first, const Triangle& second);

} // namespace glcast
