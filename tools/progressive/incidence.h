// Which triangles are at which vertex of a mesh that grows by vertex splits. Internal.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::progressive {

/// A corner is 3 · triangle + 0, 1 or 2.
class Incidence {
  public:
    void add_vertices(std::size_t count) { first.resize(first.size() + count, none); }

    void add_triangle(const Triangle& corners) {
        for (const std::uint32_t vertex : corners) {
            next.push_back(first[vertex]);
            first[vertex] = std::uint32_t(next.size() - 1);
        }
    }

    /// Corners at the vertex, growing. Valid until the next call.
    const std::vector<std::uint32_t>& around(std::uint32_t vertex) {
        found.clear();
        for (std::uint32_t c = first[vertex]; c != none; c = next[c]) found.push_back(c);
        std::sort(found.begin(), found.end());
        return found;
    }

    /// Of what around() gave for `vertex`, corners whose `moved` says so go to `to`.
    void move(std::uint32_t vertex, std::uint32_t to, const std::vector<bool>& moved) {
        first[vertex] = none;
        for (std::size_t k = 0; k < found.size(); ++k) {
            std::uint32_t& head = first[moved[k] ? to : vertex];
            next[found[k]] = head, head = found[k];
        }
    }

  private:
    static constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> first, next, found;
};

} // namespace glcast::progressive
