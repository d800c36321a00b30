// A quad per sign-changing lattice edge, between the vertices of the four cells around it, as two triangles.
#pragma once
#include <array>
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/reconstruct/crossings.h"

namespace glcast {

struct QuadReport {
    std::size_t crossings = 0, unsupported = 0;
    /// Quads that may pass through others: two that are not among them never meet (mend.cpp). Sorted.
    std::vector<std::uint32_t> suspects;
    /// The quads owned by the cells of row r are first_quad[r] .. first_quad[r + 1] (CellGrid::row).
    std::vector<std::uint32_t> first_quad;
    float stray = 0;                   ///< samples that a vertex is outside its cell along an axis, at most
    double unsupported_area_share = 0; ///< of the area of all quads
};

/// Triangles 2 q and 2 q + 1 are quad q. Counter-clockwise from outside. `positions` in samples; `rounding`:
/// how far they may be moved afterwards without asking again which quads are suspect.
std::vector<Triangle> make_triangles(const EdgeCrossings& crossings, const CellGrid& grid,
                                     const std::vector<glm::dvec3>& positions, double rounding,
                                     QuadReport& report);

} // namespace glcast
