#include "tools/deviation/level_error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tools/deviation/area_samples.h"
#include "tools/deviation/shown.h"
#include "tools/deviation/surface_index.h"
#include "tools/mesh/morton.h"
#include "tools/mesh/point_triangle.h"

namespace glcast {
namespace {

constexpr std::size_t points_a_side = 100'000;
constexpr std::size_t glance_one_of = 10;
constexpr std::size_t piece = 2048; ///< points that follow one another: neighbours, mostly

struct Probe {
    AreaSample at;
    Shown shown;
};

/// In Morton's order: what one search has read of a large tree, the next finds in the caches.
std::vector<AreaSample> neighbours_together(const std::vector<AreaSample>& samples) {
    if (samples.empty()) return samples;
    glm::dvec3 low = samples[0].position, high = low;
    for (const AreaSample& s : samples) low = glm::min(low, s.position), high = glm::max(high, s.position);
    const glm::dvec3 size = high - low;
    const double cells = 1023 / std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    std::vector<std::uint64_t> order(samples.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const glm::uvec3 cell((samples[i].position - low) * cells);
        const std::uint32_t code = spread_bits(cell.x) | spread_bits(cell.y) << 1 | spread_bits(cell.z) << 2;
        order[i] = std::uint64_t(code) << 32 | i;
    }
    tbb::parallel_sort(order);
    std::vector<AreaSample> sorted(samples.size());
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = samples[std::uint32_t(order[i])];
    return sorted;
}

std::vector<AreaSample> points_of(const Level& level, std::size_t count) {
    return neighbours_together(area_samples(level.mesh, count));
}

std::vector<Probe> probes(const Level& level) {
    const std::vector<AreaSample> samples = points_of(level, points_a_side);
    std::vector<Probe> all(samples.size());
    tbb::parallel_for(std::size_t(0), all.size(), [&](std::size_t i) {
        all[i] = {samples[i], shown(level, samples[i].triangle, samples[i].weights)};
    });
    return all;
}

struct Differences {
    float distance = 0, degrees = 0, colour = 0;
};

float degrees_between(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi_v<float>;
}

/// What the level shows nearest to a point, in a triangle.
Shown shown_near(const Level& level, const glm::dvec3& point, std::uint32_t triangle) {
    const Triangle& t = level.mesh.triangles[triangle];
    const auto& p = level.mesh.positions;
    return shown(level, triangle, nearest_in_triangle(point, p[t[0]], p[t[1]], p[t[2]]).weights);
}

Differences differences(const Probe& probe, const Level& other, const SurfaceIndex& index,
                        std::uint32_t& near) {
    const AreaSample& at = probe.at;
    const SurfaceIndex::Nearest nearest = index.nearest(at.position, near);
    near = nearest.triangle;
    const std::uint32_t facing = index.nearest_facing(at.position, at.normal, nearest).triangle;
    const Shown there = shown_near(other, at.position, facing);
    Differences d{float(nearest.distance), degrees_between(probe.shown.normal, there.normal), 0};
    for (int k = 0; k < 3; ++k)
        d.colour = std::max(d.colour, std::abs(probe.shown.colour[k] - there.colour[k]));
    return d;
}

std::vector<Differences> differences(const std::vector<Probe>& from, const Level& to,
                                     const SurfaceIndex& index) {
    std::vector<Differences> all(from.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), piece), [&](const auto& range) {
        std::uint32_t near = index.nearest(from[range.begin()].at.position).triangle;
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            all[i] = differences(from[i], to, index, near);
    });
    return all;
}

/// A triangle, for the question whether a point right above or below it is near.
struct Prism {
    glm::dvec3 corner{0}, normal{0}, weight[2]{};
    double slack = std::numeric_limits<double>::infinity(); ///< of rounding; where there is no area, all

    Prism() = default;
    explicit Prism(const std::array<glm::dvec3, 3>& p) : corner(p[0]) {
        const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], across = cross(a, b);
        const double square = dot(across, across);
        if (!(square > 0)) return;
        normal = across / std::sqrt(square);
        weight[0] = cross(b, across) / square;
        weight[1] = cross(across, a) / square;
        slack = 1e-9 * std::sqrt(std::max(dot(a, a), dot(b, b)));
    }
    bool surely_within(const glm::dvec3& point, double distance) const {
        const glm::dvec3 from = point - corner;
        const double w1 = dot(weight[0], from), w2 = dot(weight[1], from);
        return std::abs(dot(normal, from)) + slack <= distance && w1 >= 0 && w2 >= 0 && w1 + w2 <= 1;
    }
};

/// The triangles that were nearest to the last few points.
class Recent {
  public:
    Recent(const SurfaceIndex& index, std::uint32_t first) {
        triangles.fill(first);
        prisms.fill(Prism(index.corners(first)));
    }
    void add(const SurfaceIndex& index, std::uint32_t triangle) {
        prisms[next % prisms.size()] = Prism(index.corners(triangle));
        triangles[next++ % triangles.size()] = triangle;
    }
    bool surely_within(const glm::dvec3& point, double distance) const {
        return std::any_of(prisms.begin(), prisms.end(),
                           [&](const Prism& prism) { return prism.surely_within(point, distance); });
    }
    SurfaceIndex::Nearest nearest(const SurfaceIndex& index, const glm::dvec3& point,
                                  double good_enough) const {
        SurfaceIndex::Nearest best{INFINITY, triangles[0]};
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            const std::uint32_t t = triangles[(next - 1 - k) % triangles.size()];
            if (const double d = index.distance(point, t); d < best.distance) best = {d, t};
            if (best.distance <= good_enough) break;
        }
        return best;
    }

  private:
    std::array<std::uint32_t, 4> triangles;
    std::array<Prism, 4> prisms;
    std::size_t next = triangles.size();
};

/// The largest distance of a vertex from the surface, or `least` where that is larger. A vertex near a
/// triangle of one before it cannot be the farthest, and is not searched for: most are.
double farthest(const std::vector<glm::dvec3>& vertices, const SurfaceIndex& index, double least) {
    std::atomic<double> largest = least;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices.size(), piece), [&](const auto& range) {
        Recent recent(index, index.nearest(vertices[range.begin()]).triangle);
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            double known = largest.load(std::memory_order_relaxed);
            if (recent.surely_within(vertices[v], known)) continue;
            const SurfaceIndex::Nearest bound = recent.nearest(index, vertices[v], known);
            if (bound.distance <= known) continue;
            const SurfaceIndex::Nearest found = index.nearest(vertices[v], bound.triangle);
            recent.add(index, found.triangle);
            while (found.distance > known && !largest.compare_exchange_weak(known, found.distance)) {
            }
        }
    });
    return largest;
}

double nearly_all_within(std::vector<float>& distances) {
    if (distances.empty()) return 0;
    const auto rank = std::ptrdiff_t(std::ceil(0.999 * double(distances.size()))) - 1;
    std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
    return distances[std::size_t(rank)];
}

template <class PointOf>
Glance distances_of(std::size_t count, const PointOf& point, const SurfaceIndex& index) {
    std::vector<float> distances(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, piece), [&](const auto& range) {
        std::uint32_t near = index.nearest(point(range.begin())).triangle;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const SurfaceIndex::Nearest found = index.nearest(point(i), near);
            near = found.triangle;
            distances[i] = float(found.distance);
        }
    });
    double sum = 0;
    for (const float distance : distances) sum += distance;
    return {count ? sum / double(count) : 0, nearly_all_within(distances)};
}

double mean(const std::vector<Differences>& all, float Differences::*what) {
    double sum = 0;
    for (const Differences& d : all) sum += d.*what;
    return all.empty() ? 0 : sum / double(all.size());
}

double all_but_a_thousandth(const std::vector<Differences>& all, float Differences::*what) {
    if (all.empty()) return 0;
    std::vector<float> values;
    for (const Differences& d : all) values.push_back(d.*what);
    return nearly_all_within(values);
}

double largest(const std::vector<Differences>& all) {
    float most = 0;
    for (const Differences& d : all) most = std::max(most, d.distance);
    return most;
}

} // namespace

struct LevelMeter::Impl {
    explicit Impl(const Level& full)
        : full(full), index(full.mesh, SurfaceIndex::Tree::quick), on_full(probes(full)) {}

    LevelError measure(const Level& level) const {
        const SurfaceIndex level_index(level.mesh);
        const auto there = differences(on_full, level, level_index),
                   back = differences(probes(level), full, index);
        const auto larger = [&](double (*of)(const std::vector<Differences>&, float Differences::*),
                                float Differences::*what) {
            return std::max(of(there, what), of(back, what));
        };
        LevelError error;
        error.mean = larger(mean, &Differences::distance);
        error.p999 = larger(all_but_a_thousandth, &Differences::distance);
        error.max = farthest(full.mesh.positions, level_index, std::max(largest(there), largest(back)));
        error.max = farthest(level.mesh.positions, index, error.max);
        error.normal_mean_degrees = larger(mean, &Differences::degrees);
        if (has_colours(full) && has_colours(level)) {
            error.colour_mean = larger(mean, &Differences::colour);
            error.colour_p999 = larger(all_but_a_thousandth, &Differences::colour);
        }
        error.unsupported_area_share = full.error.unsupported_area_share;
        error.disagreeing_normals_share = full.error.disagreeing_normals_share;
        return error;
    }

    Glance glance(const Level& level) const {
        const SurfaceIndex level_index(level.mesh, SurfaceIndex::Tree::quick);
        const std::vector<AreaSample> on_level = points_of(level, points_a_side / glance_one_of);
        const Glance there = distances_of(
            on_full.size() / glance_one_of,
            [&](std::size_t i) { return on_full[i * glance_one_of].at.position; }, level_index);
        const Glance back = distances_of(
            on_level.size(), [&](std::size_t i) { return on_level[i].position; }, index);
        return {std::max(there.mean, back.mean), std::max(there.p999, back.p999)};
    }

    const Level& full;
    SurfaceIndex index;
    std::vector<Probe> on_full;
};

LevelMeter::LevelMeter(const Level& full) : impl(std::make_unique<Impl>(full)) {}
LevelMeter::~LevelMeter() = default;
LevelError LevelMeter::measure(const Level& level) const { return impl->measure(level); }
Glance LevelMeter::glance(const Level& level) const { return impl->glance(level); }

LevelError measure_level(const Level& full, const Level& level) { return LevelMeter(full).measure(level); }

} // namespace glcast
