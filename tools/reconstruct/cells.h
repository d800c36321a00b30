// The cells that the surface passes through, found by sweeping the volume in slabs with two slices of bits
// alive.
#pragma once
#include <cstddef>
#include <stdexcept>

#include "tools/reconstruct/rays.h"

namespace glcast {

/// Cell coordinate c of an axis spans samples c - 1 and c, so 0..n, and samples beyond the box count as
/// empty.
struct Cell {
    std::uint16_t x;
    std::uint8_t config;      ///< bit per corner, patches.h
    std::uint8_t flipped;     ///< its flipped face, or no_face
    std::uint32_t first;      ///< its first vertex; one per patch
    std::uint32_t first_quad; ///< of the edges from its corner 0 that change sign, along x, y, z
};

struct CellGrid {
    int n = 0;                            ///< samples; n + 1 cells
    std::vector<Cell> cells;              ///< by z, y, x
    std::vector<std::uint32_t> row_start; ///< of row z * (n + 1) + y; one more at the end
    std::vector<std::size_t> quad_start;  ///< quads owned by the layers before; one more at the end
    std::uint32_t vertices = 0;

    std::size_t row(int y, int z) const { return std::size_t(z) * (n + 1) + y; }
};

/// The cells of a row from the x asked last on; x never decreases. A row off the grid has none.
class RowCursor {
  public:
    RowCursor(const CellGrid& grid, int y, int z) {
        if (y < 0 || z < 0 || y > grid.n || z > grid.n) return;
        at = grid.cells.data() + grid.row_start[grid.row(y, z)];
        end = grid.cells.data() + grid.row_start[grid.row(y, z) + 1];
    }
    void forward(int x) {
        while (at != end && at->x < x) ++at;
    }
    /// x is that of forward() or the next. Throws std::logic_error when there is none.
    const Cell& cell(int x) const {
        const Cell* found = at != end && at->x < x ? at + 1 : at;
        if (found >= end || found->x != x)
            throw std::logic_error("a sign-changing edge has no cell beside it");
        return *found;
    }

  private:
    const Cell *at = nullptr, *end = nullptr;
};

/// Does the edge from the cell's corner 0 along the axis change sign?
inline bool owns_quad(const Cell& cell, int axis) {
    return (cell.config >> (1 << axis) & 1) != (cell.config & 1);
}
/// The quad of that edge.
inline std::uint32_t quad_of(const Cell& cell, int axis) {
    std::uint32_t quad = cell.first_quad;
    for (int before = 0; before < axis; ++before) quad += owns_quad(cell, before);
    return quad;
}

/// Bytes out do not depend on the number of threads. Throws std::runtime_error when nothing is filled.
CellGrid find_cells(const Rays& rays);

} // namespace glcast
