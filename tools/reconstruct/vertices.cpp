#include "tools/reconstruct/vertices.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
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
constexpr float apart = 0.1f;   // of the way from a cell's middle to the edges of each of its patches

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

using Patches = std::array<Patch, 4>;

/// crossing_of(axis, corner): of the edge from that corner of the cell.
template <class CrossingOf> Patches patches_of(const Cell& cell, int y, int z, CrossingOf crossing_of) {
    Patches patches;
    const auto& patch_of = patch_table().patch[cell.config][cell.flipped];
    const std::array<int, 3> origin = cell_sample(cell.x, y, z, 0);
    for (int edge = 0; edge < 12; ++edge) {
        if (patch_of[edge] == 255) continue;
        const int corner = edge_corner(edge), axis = edge_axis(edge);
        add_crossing(patches[patch_of[edge]], crossing_of(axis, corner), axis,
                     {corner & 1, corner >> 1 & 1, corner >> 2}, float(origin[axis]));
    }
    return patches;
}

glm::dvec3 origin_of(const Cell& cell, int y, int z) { return {cell.x - 1, y - 1, z - 1}; }

/// The cells of a row; `owners` are the rows of the cells that own their edges: bit 0 one on in y, bit 1 in
/// z.
void place_row(const EdgeCrossings& crossings, const CellGrid& grid, int y, int z,
               std::vector<glm::dvec3>& positions) {
    RowCursor owners[4] = {{grid, y, z}, {grid, y + 1, z}, {grid, y, z + 1}, {grid, y + 1, z + 1}};
    for (std::size_t c = grid.row_start[grid.row(y, z)]; c < grid.row_start[grid.row(y, z) + 1]; ++c) {
        const Cell& cell = grid.cells[c];
        for (RowCursor& row : owners) row.forward(cell.x);
        const Patches patches = patches_of(cell, y, z, [&](int axis, int corner) {
            return crossings[quad_of(owners[corner >> 1].cell(cell.x + (corner & 1)), axis)];
        });
        for (int k = 0; k < patch_table().count[cell.config][cell.flipped]; ++k)
            positions[cell.first + k] = glm::dvec3(patches[k].vertex()) + origin_of(cell, y, z);
    }
}

glm::vec3 safe_place(const Cell& cell, int patch) {
    if (patch_table().count[cell.config][cell.flipped] == 1) return glm::vec3(0.5f);
    return 0.5f + apart * patch_table().towards[cell.config][cell.flipped][patch];
}

template <class Place> void for_rows(const CellGrid& grid, Place place) {
    tbb::parallel_for(0, grid.n + 1, [&](int z) {
        for (int y = 0; y <= grid.n; ++y)
            for (std::size_t c = grid.row_start[grid.row(y, z)]; c < grid.row_start[grid.row(y, z) + 1]; ++c)
                place(grid.cells[c], y, z);
    });
}

} // namespace

std::vector<glm::dvec3> contour_vertices(const EdgeCrossings& crossings, const CellGrid& grid) {
    std::vector<glm::dvec3> positions(grid.vertices);
    tbb::parallel_for(0, grid.n + 1, [&](int z) {
        for (int y = 0; y <= grid.n; ++y) place_row(crossings, grid, y, z, positions);
    });
    return positions;
}

std::vector<glm::dvec3> cube_vertices(const CellGrid& grid) {
    std::vector<glm::dvec3> positions(grid.vertices);
    for_rows(grid, [&](const Cell& cell, int y, int z) {
        for (int k = 0; k < patch_table().count[cell.config][cell.flipped]; ++k)
            positions[cell.first + k] = glm::dvec3(safe_place(cell, k)) + origin_of(cell, y, z);
    });
    return positions;
}

PlacedCell find_cell(const CellGrid& grid, std::uint32_t vertex) {
    const auto after = std::upper_bound(grid.cells.begin(), grid.cells.end(), vertex,
                                        [](std::uint32_t v, const Cell& cell) { return v < cell.first; });
    const auto number = std::uint32_t(after - grid.cells.begin() - 1);
    const auto row =
        std::upper_bound(grid.row_start.begin(), grid.row_start.end(), number) - grid.row_start.begin() - 1;
    return {after[-1], int(row % (grid.n + 1)), int(row / (grid.n + 1))};
}

glm::dvec3 vertex_on_rung(const Rays& rays, const CellGrid& grid, std::uint32_t vertex, int rung) {
    const auto [cell, y, z] = find_cell(grid, vertex);
    const int k = int(vertex - cell.first);
    const auto crossing_of = [&, &cell = cell, y = y, z = z](int axis, int corner) {
        return find_crossing(rays, axis, cell_sample(cell.x, y, z, corner), cell.config >> corner & 1);
    };
    const Patch patch = patches_of(cell, y, z, crossing_of)[k];
    const glm::vec3 mean = glm::clamp(patch.quadric.mean(), patch.lo, patch.hi);
    glm::vec3 place = mean;
    if (rung == 0) place = patch.vertex();
    if (rung == 1 || rung == 2) place = patch.quadric.minimum(patch.lo, patch.hi);
    if (rung == 2) place = 0.5f * (place + mean);
    if (rung > 3) place = glm::mix(mean, safe_place(cell, k), float(rung - 3) / float(last_rung - 3));
    return glm::dvec3(place) + origin_of(cell, y, z);
}

} // namespace glcast
