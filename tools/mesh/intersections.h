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

struct PairCount {
    std::size_t pairs = 0;
    bool complete = true; ///< else there are more: counting stopped
};

inline constexpr std::size_t most_pairs_counted = 1'000'000;

/// How many pairs find_self_intersections() would find, without holding them, up to most_pairs_counted: of n
/// triangles that lie on one another there are n². Pairs that are near but do not meet are bounded too, by 10
/// million and 400 a triangle.
PairCount count_pairs_that_meet(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles);

/// The pairs of count_pairs_that_meet().
std::size_t count_self_intersections(std::span<const glm::dvec3> positions,
                                     std::span<const Triangle> triangles);

} // namespace glcast
