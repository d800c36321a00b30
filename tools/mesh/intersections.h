// Where a mesh passes through itself.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

using TrianglePair = std::pair<std::uint32_t, std::uint32_t>; ///< the smaller number first

/// All pairs of triangles that meet elsewhere than in the corners or the edge that they share by index
/// (triangle_contact.h), sorted. Exact; a touch counts, and so do two triangles that lie on one another.
/// Triangles with a corner that is no vertex, or with equal corners, are passed over. All cores; memory
/// proportional to the mesh and to the pairs found.
std::vector<TrianglePair> find_self_intersections(std::span<const glm::dvec3> positions,
                                                  std::span<const Triangle> triangles);

/// Only pairs with a triangle of `probes` in them. `others`: the triangles that are looked at, probes among
/// them; both sorted, each number once.
std::vector<TrianglePair> find_intersections_of(std::span<const glm::dvec3> positions,
                                                std::span<const Triangle> triangles,
                                                std::span<const std::uint32_t> probes,
                                                std::span<const std::uint32_t> others);

/// How many pairs find_self_intersections() would find, without holding them.
std::size_t count_self_intersections(std::span<const glm::dvec3> positions,
                                     std::span<const Triangle> triangles);

} // namespace glcast
