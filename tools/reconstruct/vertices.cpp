#include "tools/reconstruct/vertices.h"

#include <algorithm>
#include <tbb/parallel_for.h>

#include "tools/reconstruct/crossings.h"
#include "tools/reconstruct/patches.h"
#include "tools/reconstruct/qef.h"

namespace glcast {
namespace {

constexpr float estimated_weight = 0.25f;
constexpr float sharp = 0.02f;  // samples: planes that cannot all be met within the cell
constexpr float leeway = 0.25f; // samples beyond the cell that a vertex may go to meet them
constexpr float margin = 1e-3f; // off the cell's sides, so that vertices of neighbours never coincide

struct Patch {
    Quadric quadric;
    glm::vec3 lo{margin}, hi{1 - margin}; ///< the cell; a sheet's true depth may lie a little outside

    /// In the cell; but where an edge of the body passes just beside the cell, on that edge.
    glm::vec3 vertex() const {
        const glm::vec3 inside = quadric.minimum(lo, hi);
        const float off = quadric.distance(inside);
        if (off < sharp) return inside;
        const glm::vec3 beside = quadric.minimum(lo - leeway, hi + leeway);
        return quadric.distance(beside) < 0.25f * off ? beside : inside;
    }
};

void add_crossing(Patch& patch, const Crossing& crossing, int axis, const glm::vec3& corner, float origin) {
    glm::vec3 point = corner;
    point[axis] = crossing.at - origin;
    patch.lo[axis] = std::min(patch.lo[axis], point[axis]);
    patch.hi[axis] = std::max(patch.hi[axis], point[axis]);
    const float weight = crossing.supported ? 1 : estimated_weight;
    if (crossing.has_plane())
        patch.quadric.add(point, crossing.normal, weight);
    else
        patch.quadric.add(point, weight);
}

void place_cell(const Rays& rays, const Cell& cell, int y, int z, std::vector<glm::dvec3>& positions) {
    Patch patches[4];
    const auto& patch_of = patch_table().patch[cell.config][cell.flipped];
    const std::array<int, 3> origin = cell_sample(cell.x, y, z, 0);
    for (int edge = 0; edge < 12; ++edge) {
        if (patch_of[edge] == 255) continue;
        const int corner = edge_corner(edge), axis = edge_axis(edge);
        const auto low = cell_sample(cell.x, y, z, corner);
        const Crossing crossing = find_crossing(rays, axis, low, cell.config >> corner & 1);
        add_crossing(patches[patch_of[edge]], crossing, axis, {corner & 1, corner >> 1 & 1, corner >> 2},
                     float(origin[axis]));
    }
    for (int k = 0; k < patch_table().count[cell.config][cell.flipped]; ++k) {
        positions[cell.first + k] =
            glm::dvec3(patches[k].vertex()) + glm::dvec3(origin[0], origin[1], origin[2]);
    }
}

template <class Place> void for_rows(const CellGrid& grid, Place place) {
    tbb::parallel_for(0, grid.n + 1, [&](int z) {
        for (int y = 0; y <= grid.n; ++y)
            for (std::size_t c = grid.row_start[grid.row(y, z)]; c < grid.row_start[grid.row(y, z) + 1]; ++c)
                place(grid.cells[c], y, z);
    });
}

} // namespace

std::vector<glm::dvec3> contour_vertices(const Rays& rays, const CellGrid& grid) {
    std::vector<glm::dvec3> positions(grid.vertices);
    for_rows(grid, [&](const Cell& cell, int y, int z) { place_cell(rays, cell, y, z, positions); });
    return positions;
}

std::vector<glm::dvec3> cube_vertices(const CellGrid& grid) {
    std::vector<glm::dvec3> positions(grid.vertices);
    for_rows(grid, [&](const Cell& cell, int y, int z) {
        for (int k = 0; k < patch_table().count[cell.config][cell.flipped]; ++k)
            positions[cell.first + k] = glm::dvec3(cell.x - 0.5, y - 0.5, z - 0.5);
    });
    return positions;
}

} // namespace glcast
