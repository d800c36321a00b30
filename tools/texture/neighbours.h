// Which triangles meet at an edge and around a vertex.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

inline constexpr std::uint32_t no_triangle = ~0u;

struct Neighbours {
    /// Beyond edge k (corner k to corner k + 1) of each triangle; no_triangle at a boundary and where an edge
    /// has more than two triangles.
    std::vector<std::array<std::uint32_t, 3>> across;
    /// Corners 3 t + k by vertex: corners[start[v]] .. corners[start[v + 1] - 1], ascending.
    std::vector<std::uint32_t> start, corners;

    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        return {corners.data() + start[vertex], start[vertex + 1] - start[vertex]};
    }
};

Neighbours find_neighbours(const Mesh& mesh);

} // namespace glcast
