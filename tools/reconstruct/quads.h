// A quad per sign-changing lattice edge, between the vertices of the four cells around it, as two triangles.
#pragma once
#include "tools/mesh/mesh.h"
#include "tools/reconstruct/cells.h"

namespace glcast {

struct QuadReport {
    std::size_t crossings = 0, unsupported = 0;
};

/// Triangles 2 q and 2 q + 1 are quad q. Counter-clockwise from outside. `positions` in samples.
std::vector<Triangle> make_triangles(const Rays& rays, const CellGrid& grid,
                                     const std::vector<glm::dvec3>& positions, QuadReport& report);

} // namespace glcast
