// One vertex per surface patch of each cell.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "tools/reconstruct/crossings.h"

namespace glcast {

/// Position of a cell's corner c in samples.
inline std::array<int, 3> cell_sample(int x, int y, int z, int corner) {
    return {x - 1 + (corner & 1), y - 1 + (corner >> 1 & 1), z - 1 + (corner >> 2)};
}

/// Sample coordinates, where the crossings' planes meet within the cell.
std::vector<glm::dvec3> contour_vertices(const EdgeCrossings& crossings, const CellGrid& grid);

/// Corners of the sub-cubes around the samples: the middles of the cells; where a cell has several patches, a
/// twentieth of a sample or less off it towards the vertex's own, so that they do not touch.
std::vector<glm::dvec3> cube_vertices(const CellGrid& grid);

struct PlacedCell {
    const Cell& cell;
    int y, z;
};
PlacedCell find_cell(const CellGrid& grid, std::uint32_t vertex);

/// Where else a vertex may go, ever safer and ever less exact. On rung 0 it is where contour_vertices() put
/// it; on rung 1 it keeps to its cell; then it goes by the mean of its crossings to where cube_vertices() has
/// it, on the last.
inline constexpr int last_rung = 6;
glm::dvec3 vertex_on_rung(const Rays& rays, const CellGrid& grid, std::uint32_t vertex, int rung);

} // namespace glcast
