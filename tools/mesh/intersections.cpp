// A tree of boxes over the triangles in the order of their centres along a Morton curve (Lauterbach et al.
// 2009), and the exact test of every pair whose boxes overlap. Neighbours on the curve look through the tree
// together.
#include "tools/mesh/intersections.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numeric>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "tools/mesh/morton.h"
#include "tools/mesh/triangle_contact.h"

namespace glcast {
namespace {

constexpr std::size_t leaf_size = 4;     // triangles
constexpr std::size_t most_grouped = 16; // triangles
constexpr int group_shift = 6;           // bits of the key: a group stays in 4 x 4 x 4 cells of the curve
constexpr float far_away = std::numeric_limits<float>::infinity();

/// Holds what was added to it; floats, rounded outwards.
struct Bounds {
    glm::vec3 lo{far_away}, hi{-far_away};

    Bounds() = default;
    Bounds(const glm::dvec3& low, const glm::dvec3& high) : lo(low), hi(high) {
        for (int k = 0; k < 3; ++k) {
            if (double(lo[k]) > low[k]) lo[k] = std::nextafter(lo[k], -far_away);
            if (double(hi[k]) < high[k]) hi[k] = std::nextafter(hi[k], far_away);
        }
    }
    void add(const Bounds& other) {
        lo = glm::min(lo, other.lo);
        hi = glm::max(hi, other.hi);
    }
    bool overlaps(const Bounds& o) const {
        return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y && lo.z <= o.hi.z &&
               o.lo.z <= hi.z;
    }
};

struct Boxed {
    std::uint32_t triangle;
    Bounds bounds;
};

class Tree {
  public:
    Tree(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
         std::span<const std::uint32_t> which);
    std::size_t groups() const { return group.empty() ? 0 : group.size() - 1; }
    /// Calls visit(t) for the triangles of a group: they are near to one another.
    template <class Visit> void for_group(std::size_t g, Visit visit) const {
        for (std::uint32_t k = group[g]; k < group[g + 1]; ++k) visit(order[k]);
    }
    /// Adds the triangles whose boxes overlap `wanted`.
    void overlapping(const Bounds& wanted, std::vector<Boxed>& out) const;
    Bounds bounds_of(std::uint32_t t) const {
        const glm::dvec3 &a = positions[triangles[t][0]], &b = positions[triangles[t][1]],
                         &c = positions[triangles[t][2]];
        return {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
    }

  private:
    void sort(std::span<const std::uint32_t> which);
    std::span<const glm::dvec3> positions;
    std::span<const Triangle> triangles;
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> group;       ///< where each starts in `order`; one more at the end
    std::vector<std::vector<Bounds>> level; ///< [0]: of leaf_size triangles each; then of two below each
};

void Tree::sort(std::span<const std::uint32_t> which) {
    glm::dvec3 lo = positions[triangles[which[0]][0]], hi = lo;
    for (std::uint32_t t : which) {
        lo = glm::min(lo, positions[triangles[t][0]]);
        hi = glm::max(hi, positions[triangles[t][0]]);
    }
    const glm::dvec3 size = glm::max(hi - lo, glm::dvec3(1e-300));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> keys(which.size());
    tbb::parallel_for(std::size_t(0), which.size(), [&](std::size_t i) {
        const Triangle& t = triangles[which[i]];
        const glm::dvec3 centre = (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3.0;
        std::uint32_t key = 0;
        for (int k = 0; k < 3; ++k)
            key |= spread_bits(std::uint32_t(std::clamp((centre[k] - lo[k]) / size[k], 0.0, 1.0) * 1023))
                   << k;
        keys[i] = {key, which[i]};
    });
    tbb::parallel_sort(keys.begin(), keys.end());
    order.resize(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        order[i] = keys[i].second;
        if (i == 0 || i - group.back() == most_grouped ||
            keys[i].first >> group_shift != keys[i - 1].first >> group_shift)
            group.push_back(std::uint32_t(i));
    }
    group.push_back(std::uint32_t(keys.size()));
}

Tree::Tree(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
           std::span<const std::uint32_t> which)
    : positions(positions), triangles(triangles) {
    if (which.empty()) return;
    sort(which);
    level.emplace_back((order.size() + leaf_size - 1) / leaf_size);
    tbb::parallel_for(std::size_t(0), level[0].size(), [&](std::size_t i) {
        const std::size_t end = std::min(order.size(), (i + 1) * leaf_size);
        for (std::size_t k = i * leaf_size; k < end; ++k) level[0][i].add(bounds_of(order[k]));
    });
    while (level.back().size() > 1) {
        const auto& below = level.back();
        std::vector<Bounds> above((below.size() + 1) / 2);
        for (std::size_t i = 0; i < below.size(); ++i) above[i / 2].add(below[i]);
        level.push_back(std::move(above));
    }
}

void Tree::overlapping(const Bounds& wanted, std::vector<Boxed>& out) const {
    std::pair<std::uint32_t, std::uint32_t> stack[64]; // level and number
    int depth = 0;
    stack[depth++] = {std::uint32_t(level.size() - 1), 0};
    while (depth) {
        const auto [height, i] = stack[--depth];
        if (!level[height][i].overlaps(wanted)) continue;
        if (height == 0) {
            const std::size_t end = std::min(order.size(), (std::size_t(i) + 1) * leaf_size);
            for (std::size_t k = std::size_t(i) * leaf_size; k < end; ++k) {
                const Bounds bounds = bounds_of(order[k]);
                if (bounds.overlaps(wanted)) out.push_back({order[k], bounds});
            }
            continue;
        }
        if (2 * i + 1 < level[height - 1].size()) stack[depth++] = {height - 1, 2 * i + 1};
        stack[depth++] = {height - 1, 2 * i};
    }
}

/// found(probe, other) for each pair that meets; a pair of two probes comes once. goes_on(tests) is asked
/// behind each probe, with the pairs that it was tested in, whether to go on.
template <class Found, class GoesOn>
void for_pairs(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
               std::span<const std::uint32_t> probes, std::span<const std::uint32_t> others, Found found,
               GoesOn goes_on) {
    const Tree tree(positions, triangles, others);
    std::vector<bool> is_probe(triangles.size());
    for (std::uint32_t t : probes) is_probe[t] = true;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.groups(), 64), [&](const auto& range) {
        std::vector<Boxed> mine, near;
        for (std::size_t g = range.begin(); g < range.end(); ++g) {
            Bounds all;
            mine.clear();
            near.clear();
            tree.for_group(g, [&](std::uint32_t t) {
                if (!is_probe[t]) return;
                mine.push_back({t, tree.bounds_of(t)});
                all.add(mine.back().bounds);
            });
            if (mine.empty()) continue;
            tree.overlapping(all, near);
            for (const auto& [probe, bounds] : mine) {
                if (!goes_on(near.size())) return;
                for (const auto& [other, other_bounds] : near) {
                    if (!bounds.overlaps(other_bounds) || other == probe) continue;
                    if (other < probe && is_probe[other]) continue;
                    if (triangles_meet(positions, triangles[probe], triangles[other])) found(probe, other);
                }
            }
        }
    });
}

std::vector<std::uint32_t> usable(std::span<const glm::dvec3> positions,
                                  std::span<const Triangle> triangles) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(triangles.size());
    for (std::uint32_t k = 0; k < triangles.size(); ++k) {
        const Triangle& t = triangles[k];
        if (std::max({t[0], t[1], t[2]}) < positions.size() && t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            numbers.push_back(k);
    }
    return numbers;
}

} // namespace

std::vector<TrianglePair> find_intersections_of(std::span<const glm::dvec3> positions,
                                                std::span<const Triangle> triangles,
                                                std::span<const std::uint32_t> probes,
                                                std::span<const std::uint32_t> others) {
    tbb::enumerable_thread_specific<std::vector<TrianglePair>> found;
    for_pairs(
        positions, triangles, probes, others,
        [&](std::uint32_t a, std::uint32_t b) { found.local().emplace_back(std::min(a, b), std::max(a, b)); },
        [](std::size_t) { return true; });
    std::vector<TrianglePair> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::vector<TrianglePair> find_self_intersections(std::span<const glm::dvec3> positions,
                                                  std::span<const Triangle> triangles) {
    const std::vector<std::uint32_t> all = usable(positions, triangles);
    return find_intersections_of(positions, triangles, all, all);
}

PairCount count_pairs_that_meet(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles) {
    const std::vector<std::uint32_t> all = usable(positions, triangles);
    const std::size_t most_tests = 10'000'000 + 400 * triangles.size();
    std::atomic<std::size_t> pairs = 0, tests = 0;
    const auto within = [&] {
        return pairs.load(std::memory_order_relaxed) <= most_pairs_counted &&
               tests.load(std::memory_order_relaxed) <= most_tests;
    };
    for_pairs(
        positions, triangles, all, all, [&](std::uint32_t, std::uint32_t) { ++pairs; },
        [&](std::size_t more) {
            tests.fetch_add(more, std::memory_order_relaxed);
            return within();
        });
    if (within()) return {pairs, true};
    return {std::min<std::size_t>(pairs, most_pairs_counted), false}; // how many more hangs on the threads
}

std::size_t count_self_intersections(std::span<const glm::dvec3> positions,
                                     std::span<const Triangle> triangles) {
    return count_pairs_that_meet(positions, triangles).pairs;
}

} // namespace glcast
