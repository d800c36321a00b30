// One vertex per surface patch of each cell.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "tools/reconstruct/cells.h"

namespace glcast {

/// Position of a cell's corner c in samples.
inline std::array<int, 3> cell_sample(int x, int y, int z, int corner) {
    return {x - 1 + (corner & 1), y - 1 + (corner >> 1 & 1), z - 1 + (corner >> 2)};
}

/// Sample coordinates, where the crossings' planes meet within the cell.
std::vector<glm::dvec3> contour_vertices(const Rays& rays, const CellGrid& grid);

/// Corners of the sub-cubes around the samples: the middles of the cells.
std::vector<glm::dvec3> cube_vertices(const CellGrid& grid);

} // namespace glcast
