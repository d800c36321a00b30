// A run of edge collapses that is not glcast's: the shortest edge first, on plain arrays.
#pragma once
#include <random>

#include "tools/simplify/collapse_log.h"

namespace glcast::test {

/// Where the vertex that is kept goes.
enum class Placement {
    half,   ///< it stays: a half-edge collapse
    middle, ///< to the middle of the edge, off it by a random hundredth of its length
};

struct Collapses {
    CollapseLog log;
    std::vector<Mesh> meshes; ///< after 0, every, 2 every, ... collapses; none where `every` is 0
};

/// Until `triangles` are left or no edge may go. An edge may go where the surface stays a two-manifold of its
/// topology (link condition, Dey et al. 1999).
Collapses shortest_edges(const Mesh& mesh, std::size_t triangles, Placement placement, unsigned seed = 1,
                         std::size_t every = 0);

} // namespace glcast::test
