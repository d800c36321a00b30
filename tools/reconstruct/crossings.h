// Where the surface crosses a lattice edge, and its tangent plane there.
#pragma once
#include <glm/vec3.hpp>

#include "tools/reconstruct/rays.h"

namespace glcast {

struct Crossing {
    float at = 0;           ///< coordinate along the edge's axis, samples
    glm::vec3 normal{0};    ///< outward, unit; 0 where unknown
    bool supported = false; ///< a ray saw it; else estimated from what rays saw near by
    bool has_plane() const { return normal != glm::vec3(0); }
};

/// The crossing of the edge from sample `low` to its next along `axis`, one of which is filled.
Crossing find_crossing(const Rays& rays, int axis, const std::array<int, 3>& low, bool low_filled);

} // namespace glcast
