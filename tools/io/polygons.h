// Polygons into triangles.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::format {

/// Appends the triangles of a polygon (n - 2 of them), concave, with holes bridged by doubled edges or not flat: seen along its
/// normal they turn as it does, by ear clipping (Meisters 1975) with exact predicates; a fan from the first corner
/// where that is as right. `picked` gets, for each corner of each triangle, its number in `corners`.
/// Positions must be finite. Throws std::runtime_error when a polygon would take minutes.
void cut_polygon(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& picked);

} // namespace glcast::format
