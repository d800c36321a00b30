// Where the surface crosses a lattice edge, and its tangent plane there.
#pragma once
#include <glm/vec3.hpp>

#include "tools/reconstruct/cells.h"

namespace glcast {

struct Crossing {
    float at = 0;           ///< coordinate along the edge's axis, samples
    glm::vec3 normal{0};    ///< outward, unit; 0 where unknown
    bool supported = false; ///< a ray saw it; else estimated from what rays saw near by
    bool has_plane() const { return normal != glm::vec3(0); }
};

/// The crossing of the edge from sample `low` to its next along `axis`, one of which is filled.
Crossing find_crossing(const Rays& rays, int axis, const std::array<int, 3>& low, bool low_filled);

/// The crossings of all edges that change sign, by the number of their quads, in nine bytes each.
class EdgeCrossings {
  public:
    EdgeCrossings(const Rays& rays, const CellGrid& grid);
    Crossing operator[](std::size_t quad) const {
        return {at[quad], normal[quad] ? unpack_normal(normal[quad]) : glm::vec3(0), supported[quad] != 0};
    }

  private:
    std::vector<float> at;
    std::vector<std::uint32_t> normal;
    std::vector<std::uint8_t> supported;
};

} // namespace glcast
