#include "tools/reconstruct/space.h"

#include <algorithm>
#include <optional>

namespace glcast {
namespace {

/// Ones move to all samples within so many steps along x and along y; `bits` holds n rows of `words`.
void spread(std::vector<Word>& bits, int n, std::size_t words, int along_x, int along_y) {
    std::vector<Word> row(words), before;
    for (int step = 0; step < along_x; ++step)
        for (int y = 0; y < n; ++y) {
            Word* at = &bits[words * y];
            for (std::size_t w = 0; w < words; ++w)
                row[w] = at[w] | moved_up(at, w) | moved_down(at, w, words);
            std::copy(row.begin(), row.end(), at);
        }
    for (int step = 0; step < along_y; ++step) {
        before = bits;
        for (std::size_t w = 0; w + words < bits.size(); ++w) {
            bits[w] |= before[w + words];
            bits[w + words] |= before[w];
        }
    }
}

/// Samples of a slice near walls: what a wall across an axis touches, `radius` samples further to its sides,
/// so that the ends of sheets count, and `radius` - 1 along the axis.
struct NearWalls {
    std::vector<Word> of_slice;       ///< of walls across x and y; goes `radius` slices up and down
    std::vector<Word> between_slices; ///< of walls across z; goes one slice less
    std::vector<Word> x_walls;

    void load(const Walls& walls, int n, int radius) {
        const std::size_t words = walls.words;
        std::vector<Word> across_x(words * n);
        of_slice.resize(words * n);
        between_slices.resize(words * n);
        for (int y = 0; y < n; ++y)
            for (std::size_t w = 0; w < words; ++w) {
                across_x[words * y + w] = walls.x(y)[w] | moved_up(walls.x(y), w);
                of_slice[words * y + w] = walls.y(y)[w] | walls.y(y - 1)[w];
                between_slices[words * y + w] = walls.above(y)[w] | walls.below(y)[w];
            }
        spread(across_x, n, words, radius - 1, radius);
        spread(of_slice, n, words, radius, radius - 1);
        spread(between_slices, n, words, radius, radius);
        for (std::size_t w = 0; w < of_slice.size(); ++w) of_slice[w] |= across_x[w];
    }
};

/// Runs of ones, ended also behind every one of `walls`.
void add_divided_row(SliceRuns& slice, const Word* bits, const Word* walls, int n) {
    const std::size_t before = slice.runs.size();
    for (int x = next_bit(bits, 0, n, true); x < n;) {
        const int zero = next_bit(bits, x, n, false);
        const int end = std::min(zero, next_bit(walls, x, zero, true) + 1);
        slice.runs.push_back({std::uint16_t(x), std::uint16_t(end - 1)});
        x = next_bit(bits, end, n, true);
    }
    slice.row_runs.push_back(std::uint32_t(slice.runs.size() - before));
}

/// Union-find whose roots are the smallest members, so that the result does not depend on the order.
class Sets {
  public:
    explicit Sets(std::size_t count) : parent(count) {
        for (std::size_t i = 0; i < count; ++i) parent[i] = std::uint32_t(i);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent;
};

/// Is there a sample of first..last without a wall?
bool has_passage(const Word* walls, int first, int last) {
    return next_bit(walls, first, last + 1, false) <= last;
}

/// `walls` null: none.
void join_rows(const Volume& space, std::size_t row, std::size_t other, const Word* walls, Sets& sets) {
    std::uint32_t a = space.start[row], b = space.start[other];
    while (a < space.start[row + 1] && b < space.start[other + 1]) {
        const Run &p = space.runs[a], &q = space.runs[b];
        const int first = std::max(p.first, q.first), last = std::min(p.last, q.last);
        if (first <= last && (!walls || has_passage(walls, first, last))) sets.join(a, b);
        if (p.last < q.last)
            ++a;
        else
            ++b;
    }
}

/// The slices z - 1, z, z + 1 of a set as bits.
class Window {
  public:
    explicit Window(const Volume& space) : words(words_of(space.n)), space(space) {
        for (auto& slice : slices) slice.resize(words * (space.n + 2));
    }
    void load(int z) {
        if (loaded == z - 1) {
            std::rotate(slices, slices + 1, slices + 3);
            fill(z + 1, slices[2]);
        } else {
            for (int k = 0; k < 3; ++k) fill(z - 1 + k, slices[k]);
        }
        loaded = z;
    }
    /// y from -1 to n, dz from -1 to 1.
    const Word* row(int y, int dz) const { return &slices[dz + 1][words * (y + 1)]; }
    const std::size_t words;

  private:
    void fill(int z, std::vector<Word>& out) const {
        std::fill(out.begin(), out.end(), 0);
        if (z < 0 || z >= space.n) return;
        for (int y = 0; y < space.n; ++y) space.set_bits(y, z, &out[words * (y + 1)]);
    }
    const Volume& space;
    int loaded = -9;
    std::vector<Word> slices[3];
};

/// Word w of the samples of row y with a neighbour in the window's set and no wall between.
Word reached(const Window& in, const Walls& walls, int y, std::size_t w) {
    const Word *here = in.row(y, 0), *x = walls.x(y);
    const auto open_before = [&](std::size_t k) { return here[k] & ~x[k]; }; // may step to the next sample
    Word out = open_before(w) << 1 | (w ? open_before(w - 1) >> 63 : 0);
    out |= moved_down(here, w, in.words) & ~x[w];
    out |= in.row(y - 1, 0)[w] & ~walls.y(y - 1)[w];
    out |= in.row(y + 1, 0)[w] & ~walls.y(y)[w];
    out |= in.row(y, -1)[w] & ~walls.below(y)[w];
    out |= in.row(y, 1)[w] & ~walls.above(y)[w];
    return out;
}

std::optional<std::uint32_t> run_of(const Volume& space, const std::array<int, 3>& s) {
    for (std::uint32_t i = space.start[space.row(s[1], s[2])]; i < space.start[space.row(s[1], s[2]) + 1];
         ++i)
        if (space.runs[i].first <= s[0] && s[0] <= space.runs[i].last) return i;
    return std::nullopt;
}

/// Calls visit(y, z, row of the set, samples one step from it) for every row, slabs of them on all cores.
template <class Visit>
void for_reached_rows(const Rays& rays, const SliceHits& along_z, const Volume& space, Visit visit) {
    for_slabs(rays.n, [&](int z0, int z1) {
        Walls walls(rays, along_z);
        Window in(space);
        std::vector<Word> row(in.words);
        for (int z = z0; z < z1; ++z) {
            walls.load(z);
            in.load(z);
            for (int y = 0; y < rays.n; ++y) {
                for (std::size_t w = 0; w < in.words; ++w) row[w] = reached(in, walls, y, w);
                visit(y, z, in.row(y, 0), row);
            }
        }
    });
}

} // namespace

Volume wide_space(const Rays& rays, const SliceHits& along_z, int radius) {
    const int n = rays.n;
    const std::size_t words = words_of(n);
    std::vector<SliceRuns> slices(n);
    for_slabs(n, [&](int z0, int z1) {
        Walls walls(rays, along_z);
        const int low = std::max(0, z0 - radius), high = std::min(n, z1 + radius);
        std::vector<NearWalls> near(high - low);
        for (int z = low; z < high; ++z) {
            walls.load(z);
            if (radius) near[z - low].load(walls, n, radius);
            near[z - low].x_walls.assign(walls.x(0), walls.x(0) + words * n);
        }
        std::vector<Word> row(words);
        for (int z = z0; z < z1; ++z)
            for (int y = 0; y < n; ++y) {
                std::fill(row.begin(), row.end(), 0);
                for (int k = std::max(low, z - radius); radius && k < std::min(high, z + radius + 1); ++k)
                    for (std::size_t w = 0; w < words; ++w) {
                        row[w] |= near[k - low].of_slice[words * y + w];
                        if (std::abs(k - z) < radius) row[w] |= near[k - low].between_slices[words * y + w];
                    }
                for (Word& word : row) word = ~word;
                add_divided_row(slices[z], row.data(), &near[z - low].x_walls[words * y], n);
            }
    });
    return Volume(n, slices);
}

std::vector<std::uint8_t> connections(const Rays& rays, const SliceHits& along_z, const Volume& space,
                                      int radius, std::span<const SampleId> eyes) {
    const int n = rays.n;
    Sets sets(space.runs.size());
    const auto join_slice = [&](int z, const Walls* walls, bool within) {
        for (int y = 0; y < n; ++y) {
            const std::size_t row = space.row(y, z);
            if (within && y + 1 < n) join_rows(space, row, row + 1, walls ? walls->y(y) : nullptr, sets);
            if (!within) join_rows(space, row, row + n, walls ? walls->above(y) : nullptr, sets);
        }
    };
    const auto with_walls = [&](int z0, int z1, auto step) {
        std::optional<Walls> walls;
        if (!radius) walls.emplace(rays, along_z);
        for (int z = z0; z < z1; ++z) {
            if (walls) walls->load(z);
            step(z, walls ? &*walls : nullptr);
        }
    };
    for_slabs(n, [&](int z0, int z1) {
        with_walls(z0, z1, [&](int z, const Walls* walls) {
            join_slice(z, walls, true);
            if (z + 1 < z1) join_slice(z, walls, false);
        });
    });
    for (int z = slab - 1; z + 1 < n; z += slab)
        with_walls(z, z + 1, [&](int at, const Walls* walls) { join_slice(at, walls, false); });

    std::vector<std::uint8_t> of_root(space.runs.size(), 0), marks(space.runs.size());
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (std::uint32_t i = space.start[space.row(y, z)]; i < space.start[space.row(y, z) + 1]; ++i) {
                const bool edge = !y || !z || y == n - 1 || z == n - 1;
                if (edge || !space.runs[i].first || space.runs[i].last == n - 1)
                    of_root[sets.find(i)] = with_border;
            }
    for (const SampleId eye : eyes)
        if (const auto i = run_of(space, sample_of(eye, n)); i && !of_root[sets.find(*i)])
            of_root[sets.find(*i)] = with_eye;
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = of_root[sets.find(std::uint32_t(i))];
    return marks;
}

Volume marked_runs(const Volume& space, std::span<const std::uint8_t> marks, std::uint8_t mark) {
    Volume out;
    out.n = space.n;
    out.start.reserve(space.start.size());
    out.start.push_back(0);
    for (std::size_t row = 0; row + 1 < space.start.size(); ++row) {
        for (std::uint32_t i = space.start[row]; i < space.start[row + 1]; ++i) {
            if (marks[i] != mark) continue;
            const bool joins =
                out.runs.size() > out.start.back() && out.runs.back().last + 1 == space.runs[i].first;
            if (joins)
                out.runs.back().last = space.runs[i].last;
            else
                out.runs.push_back(space.runs[i]);
        }
        out.start.push_back(std::uint32_t(out.runs.size()));
    }
    return out;
}

Volume grown(const Rays& rays, const SliceHits& along_z, const Volume& space) {
    std::vector<SliceRuns> slices(rays.n);
    for_reached_rows(rays, along_z, space, [&](int, int z, const Word* here, std::vector<Word>& row) {
        for (std::size_t w = 0; w < row.size(); ++w) row[w] |= here[w];
        slices[z].add_row(row.data(), rays.n);
    });
    return Volume(rays.n, slices);
}

std::vector<SampleId> beside(const Rays& rays, const SliceHits& along_z, const Volume& space) {
    const int n = rays.n;
    std::vector<std::vector<SampleId>> slices(n);
    for_reached_rows(rays, along_z, space, [&](int y, int z, const Word* here, std::vector<Word>& row) {
        for (std::size_t w = 0; w < row.size(); ++w) row[w] &= ~here[w];
        for (int x = next_bit(row.data(), 0, n, true); x < n; x = next_bit(row.data(), x + 1, n, true))
            slices[z].push_back(id_of({x, y, z}, n));
    });
    std::vector<SampleId> out;
    for (const auto& slice : slices) out.insert(out.end(), slice.begin(), slice.end());
    return out;
}

} // namespace glcast
