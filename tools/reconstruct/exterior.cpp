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

Volume together(const Volume& a, const Volume& b) {
    return make_volume(a.n, [&](int y, int z, Word* bits) {
        a.set_bits(y, z, bits);
        b.set_bits(y, z, bits);
    });
}

/// Of free space about each eye the nearest sample that `is_wanted`, a few steps away at most, no wall
/// between.
template <class IsWanted>
std::vector<SampleId> nearest(const Rays& rays, std::span<const SampleId> eyes, int most,
                              IsWanted is_wanted) {
    std::vector<SampleId> out;
    for (const SampleId eye : eyes) {
        std::pair<int, SampleId> best{most + 1, 0};
        flood(rays, {eye}, 0, most, [](const auto&, SampleId) {
            return true;
        }).for_each([&](SampleId id, int steps) {
            if (is_wanted(sample_of(id, rays.n))) best = std::min(best, {steps, id});
        });
        if (best.first <= most) out.push_back(best.second);
    }
    return out;
}

/// `open` without what is out of sight, but for where one of the eyes stands.
Volume in_sight(const Rays& rays, const SliceHits& along_z, const Volume& open,
                std::span<const SampleId> eyes) {
    auto sight = find_sight(open);
    if (!sight) return open;
    Volume seen = without_hidden(rays, along_z, open, *sight);
    std::vector<SampleId> within;
    for (const SampleId eye : eyes)
        if (const auto s = sample_of(eye, rays.n); open.has(s) && !seen.has(s)) within.push_back(eye);
    if (within.empty()) return seen;
    const auto is_hidden = [&](const auto& s) { return open.has(s) && sight->at(s) == Sight::hidden; };
    std::vector<std::array<int, 3>> chambers;
    for (const SampleId id : nearest(rays, within, 4 * sight->scale, is_hidden))
        chambers.push_back(sample_of(id, rays.n));
    sight = find_sight(open, chambers);
    return sight ? without_hidden(rays, along_z, open, *sight) : open;
}

} // namespace

Exterior find_exterior(const Rays& rays, double close_gaps, std::span<const SampleId> eyes) {
    const int radius = int(std::lround(close_gaps));
    const SliceHits along_z(rays);
    const Volume wide = wide_space(rays, along_z, radius);
    const auto at = nearest(rays, eyes, step_of(radius), [&](const auto& s) { return wide.has(s); });
    const auto connected = connections(rays, along_z, wide, radius, at);
    const Volume reached = marked_runs(wide, connected, with_border);
    Exterior out;
    Volume outside = in_sight(rays, along_z, reached, at);
    out.hidden_samples = reached.samples() - outside.samples();
    if (!at.empty()) outside = together(outside, marked_runs(wide, connected, with_eye));
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
