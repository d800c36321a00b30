// Notation: wide space is what is off every wall by the gap radius; open space is the part of it that is
// connected with the border of the box and in sight. Outside is open space and what lies a few steps from it.
#include "tools/reconstruct/exterior.h"

#include <algorithm>
#include <cmath>

#include "tools/reconstruct/hiding.h"
#include "tools/reconstruct/sheets.h"
#include "tools/reconstruct/space.h"
#include "tools/reconstruct/step.h"

namespace glcast {
namespace {

constexpr int shallow = 3; // samples: a groove no deeper than this stays open, however narrow

int step_of(int radius) { return 3 * radius + shallow; }

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
        open = without_hidden(rays, along_z, open, *sight);
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
