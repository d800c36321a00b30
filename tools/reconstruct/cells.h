// The cells that the surface passes through, found by sweeping the volume in slabs with two slices of bits
// alive.
#pragma once
#include <cstddef>

#include "tools/reconstruct/rays.h"

namespace glcast {

/// Cell coordinate c of an axis spans samples c - 1 and c, so 0..n, and samples beyond the box count as
/// empty.
struct Cell {
    std::uint16_t x;
    std::uint8_t config;  ///< bit per corner, patches.h
    std::uint8_t flipped; ///< its flipped face, or no_face
    std::uint32_t first;  ///< its first vertex; one per patch
};

struct CellGrid {
    int n = 0;                            ///< samples; n + 1 cells
    std::vector<Cell> cells;              ///< by z, y, x
    std::vector<std::uint32_t> row_start; ///< of row z * (n + 1) + y; one more at the end
    std::vector<std::size_t> quad_start;  ///< quads owned by the layers before; one more at the end
    std::uint32_t vertices = 0;

    std::size_t row(int y, int z) const { return std::size_t(z) * (n + 1) + y; }
};

/// Bytes out do not depend on the number of threads. Throws std::runtime_error when nothing is filled.
CellGrid find_cells(const Rays& rays);

} // namespace glcast
