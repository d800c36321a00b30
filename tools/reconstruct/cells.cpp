#include "tools/reconstruct/cells.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <tbb/parallel_for.h>

#include "tools/reconstruct/patches.h"

namespace glcast {
namespace {

constexpr int slab_layers = 8;

/// One slice of samples as bits: bit x + 1 of row y + 1, with a border of empty samples all around.
class Slice {
  public:
    explicit Slice(int n) : words((n + 2 + 63) / 64), bits(words * (n + 2)) {}
    std::uint64_t* row(int y) { return &bits[words * (y + 1)]; }
    const std::uint64_t* row(int y) const { return &bits[words * (y + 1)]; }
    void clear() { std::fill(bits.begin(), bits.end(), 0); }
    const std::size_t words;

  private:
    std::vector<std::uint64_t> bits;
};

void fill(const Volume& volume, int z, Slice& slice) {
    slice.clear();
    if (z < 0 || z >= volume.n) return;
    for (int y = 0; y < volume.n; ++y)
        for (const Run* run = volume.begin(y, z); run != volume.end(y, z); ++run)
            set_range(slice.row(y), run->first + 1, run->last + 1);
}

/// Cells of some layers, before they are joined to the whole.
struct Slab {
    std::vector<Cell> cells;
    std::vector<std::uint32_t> row_cells;
    std::vector<std::uint32_t> layer_quads; ///< of the slab up to the end of each layer
    std::uint32_t vertices = 0, quads = 0;
};

unsigned two_bits(const std::uint64_t* row, int x) {
    const std::uint64_t word = row[x >> 6] >> (x & 63);
    return unsigned((x & 63) == 63 ? word | row[(x >> 6) + 1] << 1 : word) & 3;
}

int config_of(const Rays& rays, int x, int y, int z) {
    int config = 0;
    for (int c = 0; c < 8; ++c)
        config |= int(rays.filled({x - 1 + (c & 1), y - 1 + (c >> 1 & 1), z - 1 + (c >> 2)})) << c;
    return config;
}

/// The face that must be flipped because both cells meet it twice (patches.cpp).
int flipped_face(const Rays& rays, int config, int x, int y, int z) {
    const int face = patch_table().twice[config];
    if (face == no_face) return no_face;
    std::array<int, 3> next{x, y, z};
    next[face >> 1] += face & 1 ? 1 : -1;
    if (next[face >> 1] < 0 || next[face >> 1] > rays.n) return no_face;
    return patch_table().twice[config_of(rays, next[0], next[1], next[2])] == (face ^ 1) ? face : no_face;
}

void add_cell(Slab& slab, const Rays& rays, int config, int x, int y, int z) {
    const int flipped = flipped_face(rays, config, x, y, z);
    slab.cells.push_back(
        {std::uint16_t(x), std::uint8_t(config), std::uint8_t(flipped), slab.vertices, slab.quads});
    slab.vertices += patch_table().count[config][flipped];
    for (int axis = 0; axis < 3; ++axis) slab.quads += owns_quad(slab.cells.back(), axis);
}

void find_row(Slab& slab, const Rays& rays, const Slice& low, const Slice& high, int y, int z) {
    const std::uint64_t* rows[4] = {low.row(y - 1), low.row(y), high.row(y - 1), high.row(y)};
    std::uint64_t carry_any = 0, carry_all = 0; // of the word after, its lowest bit
    const std::size_t before = slab.cells.size();
    for (std::size_t w = 0; w < low.words; ++w) {
        const std::uint64_t any = rows[0][w] | rows[1][w] | rows[2][w] | rows[3][w];
        const std::uint64_t all = rows[0][w] & rows[1][w] & rows[2][w] & rows[3][w];
        carry_any = carry_all = 0;
        if (w + 1 < low.words) {
            carry_any = (rows[0][w + 1] | rows[1][w + 1] | rows[2][w + 1] | rows[3][w + 1]) << 63;
            carry_all = (rows[0][w + 1] & rows[1][w + 1] & rows[2][w + 1] & rows[3][w + 1]) << 63;
        }
        std::uint64_t mixed = (any | any >> 1 | carry_any) & ~(all & (all >> 1 | carry_all));
        for (; mixed; mixed &= mixed - 1) {
            const int x = int(w * 64) + std::countr_zero(mixed);
            if (x > rays.n) break;
            unsigned config = 0;
            for (int r = 0; r < 4; ++r) config |= two_bits(rows[r], x) << (2 * r);
            add_cell(slab, rays, int(config), x, y, z);
        }
    }
    slab.row_cells.push_back(std::uint32_t(slab.cells.size() - before));
}

Slab sweep_slab(const Rays& rays, int z0, int z1) {
    Slab slab;
    Slice low(rays.n), high(rays.n);
    Slice *below = &low, *above = &high;
    fill(rays.volume, z0 - 1, *below);
    for (int z = z0; z < z1; ++z) {
        fill(rays.volume, z, *above);
        for (int y = 0; y <= rays.n; ++y) find_row(slab, rays, *below, *above, y, z);
        slab.layer_quads.push_back(slab.quads);
        std::swap(below, above);
    }
    return slab;
}

CellGrid join(const std::vector<Slab>& slabs, int n) {
    CellGrid grid;
    grid.n = n;
    std::size_t cells = 0;
    for (const Slab& slab : slabs) cells += slab.cells.size();
    if (cells > 0xffffffffu) throw std::runtime_error("the surface has too many cells for this resolution");
    grid.cells.reserve(cells);
    grid.row_start.reserve(std::size_t(n + 1) * (n + 1) + 1);
    grid.row_start.push_back(0);
    grid.quad_start.push_back(0);
    for (const Slab& slab : slabs) {
        const std::size_t quads = grid.quad_start.back();
        for (Cell cell : slab.cells) {
            cell.first += grid.vertices;
            cell.first_quad += std::uint32_t(quads);
            grid.cells.push_back(cell);
        }
        for (std::uint32_t count : slab.row_cells) grid.row_start.push_back(grid.row_start.back() + count);
        for (std::uint32_t upto : slab.layer_quads) grid.quad_start.push_back(quads + upto);
        grid.vertices += slab.vertices;
    }
    return grid;
}

} // namespace

CellGrid find_cells(const Rays& rays) {
    const int layers = rays.n + 1, count = (layers + slab_layers - 1) / slab_layers;
    patch_table();
    std::vector<Slab> slabs(count);
    tbb::parallel_for(0, count, [&](int i) {
        slabs[i] = sweep_slab(rays, i * slab_layers, std::min(layers, (i + 1) * slab_layers));
    });
    CellGrid grid = join(slabs, rays.n);
    if (grid.cells.empty()) throw std::runtime_error("the images enclose nothing: no sample is filled");
    return grid;
}

} // namespace glcast
