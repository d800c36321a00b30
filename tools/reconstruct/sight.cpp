#include "tools/reconstruct/sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

constexpr int most_cells = 128;
constexpr int directions = 192, directions_a_round = 48;
constexpr int enough = 10;         // of 192 directions: a cell that sees out in as many is open
constexpr double opening = 0.01;   // of a chamber's walls: a chamber with less is hidden
constexpr std::size_t least = 100; // cells: what is smaller may be a crevice that the grid is too coarse for

/// Bits of a cube of cells; row (b, c) holds the cells along a.
struct BitCube {
    explicit BitCube(int m) : m(m), words(words_of(m)), bits(words * m * m) {}
    Word* row(int b, int c) { return &bits[(std::size_t(c) * m + b) * words]; }
    const Word* row(int b, int c) const { return &bits[(std::size_t(c) * m + b) * words]; }
    int m;
    std::size_t words;
    std::vector<Word> bits;
};

/// Cells all of whose samples are free.
BitCube free_cells(const Volume& free, int m, int scale) {
    BitCube cube(m);
    tbb::parallel_for(0, m, [&](int cz) {
        std::vector<int> covered(m);
        for (int cy = 0; cy < m; ++cy) {
            std::fill(covered.begin(), covered.end(), 0);
            const int rows_y = std::min(scale, free.n - cy * scale),
                      rows_z = std::min(scale, free.n - cz * scale);
            for (int k = 0; k < rows_y * rows_z; ++k) {
                const int y = cy * scale + k % rows_y, z = cz * scale + k / rows_y;
                for (const Run* run = free.begin(y, z); run != free.end(y, z); ++run) {
                    const int last = run->last == free.n - 1 ? m : (run->last + 1) / scale;
                    for (int cx = (run->first + scale - 1) / scale; cx < last; ++cx) ++covered[cx];
                }
            }
            for (int cx = 0; cx < m; ++cx)
                if (covered[cx] == rows_y * rows_z) set_bit(cube.row(cy, cz), cx);
        }
    });
    return cube;
}

/// Transposes 64 rows of 64 bits (Warren, Hacker's Delight, 7-3).
void transpose(std::array<Word, 64>& rows) {
    Word mask = 0x00000000ffffffffull;
    for (int j = 32; j; j >>= 1, mask ^= mask << j)
        for (int k = 0; k < 64; k = ((k | j) + 1) & ~j) {
            const Word swap = (rows[k] >> j ^ rows[k | j]) & mask;
            rows[k] ^= swap << j;
            rows[k | j] ^= swap;
        }
}

/// The same with x and z exchanged.
BitCube turned(const BitCube& in) {
    BitCube out(in.m);
    tbb::parallel_for(0, in.m, [&](int b) {
        std::array<Word, 64> block;
        for (std::size_t wz = 0; wz < in.words; ++wz)
            for (std::size_t wx = 0; wx < in.words; ++wx) {
                const int z0 = int(wz) * 64, x0 = int(wx) * 64;
                for (int k = 0; k < 64; ++k) block[k] = z0 + k < in.m ? in.row(b, z0 + k)[wx] : 0;
                transpose(block);
                for (int k = 0; k < 64 && x0 + k < in.m; ++k) out.row(b, x0 + k)[wz] = block[k];
            }
    });
    return out;
}

/// Counts up to 15 how often each cell was seen, a plane of bits for each digit.
struct Counter {
    explicit Counter(int m) : digit{BitCube(m), BitCube(m), BitCube(m), BitCube(m)} {}
    /// Adds `ones` times 1 << `power`; stays at 15 where that is too much.
    void add(std::size_t w, Word ones, int power = 0) {
        Word carry = ones;
        for (int k = power; k < 4; ++k) {
            const Word sum = digit[k].bits[w] ^ carry;
            carry &= digit[k].bits[w];
            digit[k].bits[w] = sum;
        }
        for (BitCube& plane : digit) plane.bits[w] |= carry;
    }
    void add(const Counter& other) {
        for (int k = 0; k < 4; ++k)
            for (std::size_t w = 0; w < other.digit[k].bits.size(); ++w) add(w, other.digit[k].bits[w], k);
    }
    Word at_least_ten(std::size_t w) const {
        return digit[3].bits[w] & (digit[2].bits[w] | digit[1].bits[w]);
    }
    std::array<BitCube, 4> digit;
};
static_assert(enough == 10);

/// The row moved by d samples, d in -1..1; what moves in from outside the box is free.
void move_row(const Word* in, Word* out, std::size_t words, int m, int d) {
    for (std::size_t w = 0; w < words; ++w)
        out[w] = d == 0 ? in[w] : d > 0 ? moved_up(in, w) : moved_down(in, w, words);
    if (d > 0) out[0] |= 1;
    if (d < 0) set_bit(out, m - 1);
}

/// Marks the cells from which a straight line leads out through free cells. The line goes one slice a step;
/// slices follow one another along y or z, and step_x and step_other are its slopes along x and the third
/// axis.
void look(const BitCube& free, bool along_z, double step_x, double step_other, int sign, Counter& seen) {
    const int m = free.m;
    const std::size_t words = free.words, a_slice = along_z ? words * m : words,
                      a_row = along_z ? words : words * m;
    std::vector<Word> before(words * m, ~Word(0)), here(words * m), moved(words);
    for (int k = 0; k < m; ++k) {
        const int slice = sign > 0 ? k : m - 1 - k;
        const int dx = int(std::lround((k + 1) * step_x) - std::lround(k * step_x));
        const int dr = int(std::lround((k + 1) * step_other) - std::lround(k * step_other));
        for (int row = 0; row < m; ++row) {
            if (row - dr < 0 || row - dr >= m)
                std::fill(moved.begin(), moved.end(), ~Word(0));
            else
                move_row(&before[words * (row - dr)], moved.data(), words, m, dx);
            const std::size_t at = a_slice * slice + a_row * row;
            for (std::size_t w = 0; w < words; ++w) {
                here[words * row + w] = free.bits[at + w] & moved[w];
                seen.add(at + w, here[words * row + w]);
            }
        }
        std::swap(before, here);
    }
}

/// Evenly about the sphere (Fibonacci lattice), taken in an order that covers it early.
glm::dvec3 direction(int i) {
    const int k = (i * 79) % directions; // 79 and 192 have no common factor
    const double z = 1 - (2 * k + 1.0) / directions, angle = k * M_PI * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

class Looking {
  public:
    explicit Looking(const BitCube& free)
        : upright(free), lying(turned(free)), counts([m = free.m] {
              return Counts{Counter(m), Counter(m)};
          }) {}
    void round(int first) {
        tbb::parallel_for(first, first + directions_a_round, [&](int i) {
            const glm::dvec3 d = direction(i);
            const glm::dvec3 size(std::abs(d.x), std::abs(d.y), std::abs(d.z));
            Counts& count = counts.local();
            if (size.x > size.y && size.x > size.z)
                look(lying, true, d.z / size.x, d.y / size.x, d.x > 0 ? 1 : -1, count.lying);
            else if (size.y > size.z)
                look(upright, false, d.x / size.y, d.z / size.y, d.y > 0 ? 1 : -1, count.upright);
            else
                look(upright, true, d.x / size.z, d.y / size.z, d.z > 0 ? 1 : -1, count.upright);
        });
    }
    /// Free cells that see out in fewer than `enough` directions, ascending. Each counter is exact as far as
    /// that, so it does not matter which thread looked in which direction.
    std::vector<std::uint32_t> dim_cells() const {
        Counter sum(upright.m), sideways(upright.m);
        for (const Counts& count : counts) {
            sum.add(count.upright);
            sideways.add(count.lying);
        }
        for (BitCube& plane : sideways.digit) plane = turned(plane);
        sum.add(sideways);
        std::vector<std::uint32_t> out;
        const int m = upright.m;
        for (int row = 0; row < m * m; ++row)
            for (std::size_t w = 0; w < upright.words; ++w) {
                const std::size_t at = row * upright.words + w;
                for (Word dim = upright.bits[at] & ~sum.at_least_ten(at); dim; dim &= dim - 1)
                    out.push_back(std::uint32_t(std::size_t(row) * m + w * 64 + std::countr_zero(dim)));
            }
        return out;
    }

  private:
    struct Counts {
        Counter upright, lying;
    };
    const BitCube upright, lying; ///< lying: x and z exchanged
    tbb::enumerable_thread_specific<Counts> counts;
};

/// Calls visit(cell, state) for the six neighbours; what is outside the box is open.
template <class Visit> void for_neighbours(const Sight& sight, std::uint32_t cell, Visit visit) {
    const std::uint32_t m = std::uint32_t(sight.cells), step[3] = {1, m, m * m};
    const std::uint32_t at[3] = {cell % m, cell / m % m, cell / step[2]};
    for (int axis = 0; axis < 3; ++axis) {
        if (at[axis] > 0)
            visit(cell - step[axis], sight.state[cell - step[axis]]);
        else
            visit(cell, Sight::open);
        if (at[axis] + 1 < m)
            visit(cell + step[axis], sight.state[cell + step[axis]]);
        else
            visit(cell, Sight::open);
    }
}

/// What a cell adds to the openings and walls of its chamber, in faces. Cells beside a wall are not free as a
/// whole, so an opening looks narrower than it is, by about a cell and a half on each side.
struct Faces {
    int open = 0, walls = 0;
    double opening() const { return open ? open + 1.5 * walls : 0; }
};

/// The dim cells connected with `seed`; they stay hidden when their openings are small.
bool judge_chamber(Sight& sight, std::uint32_t seed, std::span<const std::uint32_t> seen,
                   std::vector<std::uint8_t>& judged) {
    std::vector<std::uint32_t> chamber{seed};
    judged[seed] = 1;
    double openings = 0, walls = 0;
    for (std::size_t i = 0; i < chamber.size(); ++i) {
        Faces faces;
        for_neighbours(sight, chamber[i], [&](std::uint32_t next, Sight::Cell state) {
            faces.open += state == Sight::open;
            faces.walls += state == Sight::not_free;
            if (state != Sight::hidden || judged[next]) return;
            judged[next] = 1;
            chamber.push_back(next);
        });
        openings += faces.opening();
        walls += faces.walls;
    }
    const bool is_seen = std::any_of(chamber.begin(), chamber.end(),
                                     [&](std::uint32_t cell) { return std::ranges::count(seen, cell) > 0; });
    if (!is_seen && chamber.size() >= least && openings < opening * walls) return true;
    // Not before all chambers are judged: an open one must not count as opening of the next.
    for (std::uint32_t cell : chamber) judged[cell] = 2;
    return false;
}

} // namespace

std::optional<Sight> find_sight(const Volume& free, std::span<const std::array<int, 3>> seen) {
    Sight sight;
    sight.scale = (free.n + most_cells - 1) / most_cells;
    sight.cells = (free.n + sight.scale - 1) / sight.scale;
    const int m = sight.cells;
    const BitCube cells = free_cells(free, m, sight.scale);
    Looking looking(cells);
    std::vector<std::uint32_t> dim;
    for (int first = 0; first < directions; first += directions_a_round) {
        looking.round(first);
        dim = looking.dim_cells();
        if (dim.empty()) return std::nullopt;
    }
    sight.state.assign(std::size_t(m) * m * m, Sight::not_free);
    tbb::parallel_for(0, m, [&](int z) {
        for (int y = 0; y < m; ++y)
            for (int x = 0; x < m; ++x)
                if (test_bit(cells.row(y, z), x)) sight.state[(std::size_t(z) * m + y) * m + x] = Sight::open;
    });
    for (std::uint32_t cell : dim) sight.state[cell] = Sight::hidden;
    std::vector<std::uint32_t> seen_cells;
    for (const auto& s : seen) seen_cells.push_back(std::uint32_t(sight.cell_of(s)));
    std::vector<std::uint8_t> judged(sight.state.size(), 0);
    bool any = false;
    for (std::uint32_t cell : dim)
        if (!judged[cell]) any |= judge_chamber(sight, cell, seen_cells, judged);
    if (!any) return std::nullopt;
    for (std::uint32_t cell : dim)
        if (judged[cell] == 2) sight.state[cell] = Sight::open;
    return sight;
}

} // namespace glcast
