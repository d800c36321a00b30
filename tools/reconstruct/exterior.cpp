// Notation: wide space is what is off every wall by the gap radius; open space is the part of it that is
// connected with the border of the box and in sight. Outside is open space and what lies a few steps from it.
#include "tools/reconstruct/exterior.h"

#include <algorithm>
#include <cmath>

#include "tools/reconstruct/sheets.h"
#include "tools/reconstruct/sight.h"
#include "tools/reconstruct/space.h"
#include "tools/reconstruct/step.h"

namespace glcast {
namespace {

constexpr int shallow = 3; // samples: a groove no deeper than this stays open, however narrow

int step_of(int radius) { return 3 * radius + shallow; }

/// The hidden coarse cell's samples and, of those beside walls, which no coarse cell holds whole, the ones
/// that are nearer to hidden samples than to open ones.
class Hiding {
  public:
    Hiding(const Rays& rays, const SliceHits& along_z, const Volume& space, const Sight& sight)
        : rays(rays), space(space), sight(sight), n(rays.n) {
        if (sight.scale > 1) find_undecided(along_z);
    }
    Volume open_space() const {
        return make_volume(n, [&](int y, int z, Word* bits) {
            space.set_bits(y, z, bits);
            for_hidden(y, z, [&](int x) { bits[x >> 6] &= ~(Word(1) << (x & 63)); });
            const SampleId row = id_of({0, y, z}, n);
            for (auto at = std::lower_bound(besides.begin(), besides.end(), row);
                 at != besides.end() && *at < row + n; ++at)
                bits[(*at - row) >> 6] &= ~(Word(1) << ((*at - row) & 63));
        });
    }

  private:
    bool hidden_cell(const std::array<int, 3>& s) const { return sight.at(s) == Sight::hidden; }
    /// The row's samples of the space in hidden cells.
    template <class Visit> void for_hidden(int y, int z, Visit visit) const {
        for (const Run* run = space.begin(y, z); run != space.end(y, z); ++run)
            for (int x = run->first; x <= run->last; ++x)
                if (hidden_cell({x, y, z})) visit(x);
    }
    Volume in_hidden_cells() const {
        return make_volume(
            n, [&](int y, int z, Word* bits) { for_hidden(y, z, [&](int x) { set_bit(bits, x); }); });
    }
    void find_undecided(const SliceHits& along_z) {
        const auto undecided = [&](const std::array<int, 3>& s) {
            return space.has(s) && sight.at(s) == Sight::not_free;
        };
        std::vector<SampleId> first = beside(rays, along_z, in_hidden_cells());
        std::erase_if(first, [&](SampleId id) { return !undecided(sample_of(id, n)); });
        const int most = 4 * sight.scale;
        const auto from_hidden = flood(rays, first, 1, most, [&](auto& s, SampleId) { return undecided(s); });
        std::vector<SampleId> rim;
        from_hidden.for_each([&](SampleId id, int) {
            for_steps(rays, sample_of(id, n), [&](const std::array<int, 3>& s) {
                if (space.has(s) && !hidden_cell(s) && !from_hidden.contains(id_of(s, n))) rim.push_back(id);
            });
        });
        std::sort(rim.begin(), rim.end());
        rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
        const auto from_open =
            flood(rays, rim, 1, most, [&](auto&, SampleId id) { return from_hidden.contains(id); });
        from_hidden.for_each([&](SampleId id, int level) {
            const int open = from_open.at(id);
            if (open == SampleLevels::none || level <= open) besides.push_back(id);
        });
        std::sort(besides.begin(), besides.end());
    }
    const Rays& rays;
    const Volume& space;
    const Sight& sight;
    const int n;
    std::vector<SampleId> besides;
};

/// Samples in narrow places that belong to the outside: those few steps from it, unless the place goes on
/// deeper than that: then it is a slit, and closed flush.
std::vector<SampleId> shallow_places(const Rays& rays, const SliceHits& along_z, const Volume& outside,
                                     int radius) {
    const int most = step_of(radius);
    const auto narrow = [&](const std::array<int, 3>& s, SampleId) { return !outside.has(s); };
    const auto level = flood(rays, beside(rays, along_z, outside), 2, most + 1, narrow);
    std::vector<SampleId> deep;
    level.for_each([&](SampleId id, int steps) {
        if (steps > most) deep.push_back(id);
    });
    const auto closed =
        flood(rays, deep, 0, most, [&](const auto&, SampleId id) { return level.contains(id); });
    std::vector<SampleId> out;
    level.for_each([&](SampleId id, int) {
        if (!closed.contains(id)) out.push_back(id);
    });
    return out;
}

Volume complement(const Volume& outside) {
    return make_volume(outside.n, [&](int y, int z, Word* bits) {
        outside.set_bits(y, z, bits);
        for (std::size_t w = 0; w < words_of(outside.n); ++w) bits[w] = ~bits[w];
    });
}

} // namespace

Exterior find_exterior(const Rays& rays, double close_gaps) {
    const int radius = int(std::lround(close_gaps));
    const SliceHits along_z(rays);
    Volume open = wide_space(rays, along_z, radius);
    open = marked_runs(open, connected_to_border(rays, along_z, open, radius));
    Exterior out;
    if (const auto sight = find_sight(open)) {
        const std::size_t before = open.samples();
        open = Hiding(rays, along_z, open, *sight).open_space();
        out.hidden_samples = before - open.samples();
    }
    Volume outside = open;
    if (radius) {
        for (int k = 0; k < radius + 1; ++k) outside = grown(rays, along_z, outside);
        outside.add(shallow_places(rays, along_z, outside, radius));
    }
    out.volume = complement(outside);
    const std::size_t thick = out.volume.samples();
    out.volume.add(sheet_samples(rays, along_z, out.volume));
    out.thin_samples = out.volume.samples() - thick;
    return out;
}

} // namespace glcast
