// What is nearer to hidden than to open samples, against a flood of one sample after another.
#include <deque>

#include "tests/reconstruct/cast.h"
#include "tests/reconstruct/random_bodies.h"
#include "tools/reconstruct/hiding.h"
#include "tools/reconstruct/space.h"
#include "tools/reconstruct/step.h"

namespace glcast::test {
namespace {

constexpr int n = 70; // more than a word

Rays rays_of(const Body& body) {
    HitBuilder hits;
    for (const ViewImage& image : cast_layers(body, test_box, n)) hits.add(image);
    Rays rays;
    rays.n = n;
    rays.axis = hits.finish();
    return rays;
}

Sight random_sight(Dice& dice, int scale) {
    Sight sight;
    sight.scale = scale;
    sight.cells = (n + scale - 1) / scale;
    sight.state.resize(std::size_t(sight.cells) * sight.cells * sight.cells);
    for (Sight::Cell& cell : sight.state) {
        const int k = dice.up_to(400);
        cell = k < 2 ? Sight::hidden : k < 4 ? Sight::open : Sight::not_free;
    }
    return sight;
}

constexpr int never = 1 << 20;
using Levels = std::vector<int>; // by SampleId

/// Steps from the samples at level 1, by those that may be passed.
template <class Passable>
Levels levels_from(const Rays& rays, const std::vector<SampleId>& first, int most, Passable passable) {
    Levels level(std::size_t(n) * n * n, never);
    std::deque<SampleId> queue(first.begin(), first.end());
    for (SampleId id : first) level[id] = 1;
    for (; !queue.empty(); queue.pop_front()) {
        const SampleId from = queue.front();
        if (level[from] == most) continue;
        for_steps(rays, sample_of(from, n), [&](const std::array<int, 3>& s) {
            const SampleId to = id_of(s, n);
            if (level[to] != never || !passable(to)) return;
            level[to] = level[from] + 1;
            queue.push_back(to);
        });
    }
    return level;
}

template <class Passable, class Source>
std::vector<SampleId> beside_any(const Rays& rays, Passable passable, Source source) {
    std::vector<SampleId> out;
    for (SampleId id = 0; id < SampleId(n) * n * n; ++id) {
        bool any = false;
        for_steps(rays, sample_of(id, n), [&](const auto& s) { any |= source(id_of(s, n)); });
        if (any && passable(id)) out.push_back(id);
    }
    return out;
}

/// By SampleId: is it in what is left of the space?
std::vector<bool> expected(const Rays& rays, const Volume& space, const Sight& sight) {
    const int most = 4 * sight.scale;
    const auto is = [&](SampleId id, Sight::Cell state) {
        return space.has(sample_of(id, n)) && sight.at(sample_of(id, n)) == state;
    };
    const auto undecided = [&](SampleId id) { return is(id, Sight::not_free); };
    const auto hidden = [&](SampleId id) { return is(id, Sight::hidden); };
    const Levels from_hidden = levels_from(rays, beside_any(rays, undecided, hidden), most, undecided);
    const auto reached = [&](SampleId id) { return from_hidden[id] != never; };
    const auto open = [&](SampleId id) { return is(id, Sight::open) || (undecided(id) && !reached(id)); };
    const Levels from_open = levels_from(rays, beside_any(rays, reached, open), most, reached);
    std::vector<bool> left(std::size_t(n) * n * n);
    for (SampleId id = 0; id < left.size(); ++id) {
        const bool goes = hidden(id) || (reached(id) && from_hidden[id] <= from_open[id]);
        left[id] = space.has(sample_of(id, n)) && !goes;
    }
    return left;
}

TEST(Hiding, SamplesGoWithTheNearerSide) {
    std::size_t hidden = 0, kept = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        Dice dice(seed);
        const Rays rays = rays_of(*random_body(dice));
        const SliceHits along_z(rays);
        const Volume runs = wide_space(rays, along_z, int(seed % 2)); // 0: walls within it
        const Volume space =
            marked_runs(runs, std::vector<std::uint8_t>(runs.runs.size(), with_border), with_border);
        const Sight sight = random_sight(dice, int(seed % 3) + 2);
        const std::vector<bool> want = expected(rays, space, sight);
        const Volume got = without_hidden(rays, along_z, space, sight);
        std::size_t wrong = 0;
        for (SampleId id = 0; id < want.size(); ++id) wrong += got.has(sample_of(id, n)) != want[id];
        EXPECT_EQ(wrong, 0u) << seed;
        hidden += space.samples() - got.samples();
        kept += got.samples();
    }
    EXPECT_GT(hidden, 100000u);
    EXPECT_GT(kept, 100000u);
}

} // namespace
} // namespace glcast::test
