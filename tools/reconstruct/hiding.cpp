#include "tools/reconstruct/hiding.h"

#include <algorithm>

#include "tools/reconstruct/region.h"
#include "tools/reconstruct/space.h"

namespace glcast {
namespace {

/// The samples in cells of one state, a row for each row of cells.
class CellRows {
  public:
    CellRows(const Sight& sight, Sight::Cell state, int n)
        : sight(sight), words(words_of(n)), bits(std::size_t(sight.cells) * sight.cells * words, 0) {
        const int scale = sight.scale, m = sight.cells;
        for (int row = 0; row < m * m; ++row)
            for (int x = 0; x < m; ++x)
                if (sight.state[std::size_t(row) * m + x] == state)
                    set_range(&bits[row * words], x * scale, std::min(n, (x + 1) * scale) - 1);
    }
    const Word* row(int y, int z) const { return &bits[first(y, z)]; }
    Volume common(const Volume& space) const {
        return make_volume(space.n, [&](int y, int z, Word* out) {
            space.set_bits(y, z, out);
            for (std::size_t w = 0; w < words; ++w) out[w] &= row(y, z)[w];
        });
    }

  private:
    std::size_t first(int y, int z) const {
        return (std::size_t(z / sight.scale) * sight.cells + y / sight.scale) * words;
    }
    const Sight& sight;
    const std::size_t words;
    std::vector<Word> bits;
};

/// Two floods that start at once, from hidden and from open samples: a sample is open when the open ones come
/// to it first.
Region::Set nearer_to_hidden(const Region& region, const Region::Set& hidden, const Region::Set& open,
                             int most) {
    using Set = Region::Set;
    Set reach = hidden;
    for (int level = 1; level < most; ++level) {
        Set next = region.grown(reach, region.all());
        if (next == reach) break;
        reach = std::move(next);
    }
    Set others = region.all();
    for (std::size_t i = 0; i < others.size(); ++i) others[i] &= ~reach[i];
    Set from_open = region.grown(others, reach), from_hidden = hidden, out = reach;
    for (std::size_t i = 0; i < reach.size(); ++i) from_open[i] = (from_open[i] | open[i]) & reach[i];
    for (int level = 1;; ++level) {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] &= ~(from_open[i] & ~from_hidden[i]);
        if (level == most || from_hidden == reach) return out;
        from_hidden = region.grown(from_hidden, reach);
        from_open = region.grown(from_open, reach);
    }
}

} // namespace

Volume without_hidden(const Rays& rays, const SliceHits& along_z, const Volume& space, const Sight& sight) {
    const int n = space.n;
    const CellRows hidden(sight, Sight::hidden, n);
    const auto without_cells = [&](auto also) {
        return make_volume(n, [&](int y, int z, Word* bits) {
            space.set_bits(y, z, bits);
            for (std::size_t w = 0; w < words_of(n); ++w) bits[w] &= ~hidden.row(y, z)[w];
            also(y, z, bits);
        });
    };
    if (sight.scale == 1) return without_cells([](int, int, Word*) {}); // every cell is decided
    const Region undecided(rays, along_z, CellRows(sight, Sight::not_free, n).common(space));
    const auto beside = [&](const Volume& decided) {
        return undecided.common(grown(rays, along_z, decided));
    };
    const Region::Set besides =
        nearer_to_hidden(undecided, beside(hidden.common(space)),
                         beside(CellRows(sight, Sight::open, n).common(space)), 4 * sight.scale);
    return without_cells([&](int y, int z, Word* bits) { undecided.clear(besides, y, z, bits); });
}

} // namespace glcast
