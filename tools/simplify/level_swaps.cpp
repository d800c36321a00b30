// Swaps of a level's edges: part of LevelFit.
#include <algorithm>
#include <numeric>

#include "tools/simplify/level_fit.h"

namespace glcast {
namespace {

constexpr std::uint32_t no_triangle = UINT32_MAX;
// What a swap may do: cosine of each new normal with the mean of the old ones, and the share of the squared
// distances that must go.
constexpr double min_swap_cosine = 0.2, min_swap_gain = 0.01, min_quality = 0.02;

/// The middles of the four triangles that its sides' middles cut it into.
constexpr glm::dvec3 places_in_triangle[] = {
    {1. / 3, 1. / 3, 1. / 3}, {2. / 3, 1. / 6, 1. / 6}, {1. / 6, 2. / 3, 1. / 6}, {1. / 6, 1. / 6, 2. / 3}};

/// Squared distance from the nearer one: likely the first.
double nearest_of(const glm::dvec3& point, const Faced& likely, const Faced& other) {
    const double squared = likely.at.squared_distance(point);
    return other.is_further(point, squared) ? squared : std::min(squared, other.at.squared_distance(point));
}

} // namespace

void LevelFit::swap_edges() {
    const auto laid_on = samples_by_triangle();
    std::vector<bool> touched(mesh.positions.size());
    bool any = false;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            if (touched[mesh.triangles[t][0]] || touched[mesh.triangles[t][1]] ||
                touched[mesh.triangles[t][2]])
                break;
            const auto diamond = diamond_at(t, k);
            if (!diamond) continue;
            const auto& [left, right, a, b, c, d] = *diamond;
            if (touched[d]) continue;
            if (!better_swapped(*diamond, laid_on(left), laid_on(right))) continue;
            const SurfaceChange change{{left, right}, {{a, d, c}, {d, b, c}}};
            if (folds(change) || guard.crosses(surface(), change)) continue;
            mesh.triangles[left] = change.made[0];
            mesh.triangles[right] = change.made[1];
            guard.made_it(surface(), change);
            touched[a] = touched[b] = touched[c] = touched[d] = any = true;
            break;
        }
    if (any) walk = std::make_unique<SurfaceWalk>(mesh);
}

LevelFit::Laid LevelFit::samples_by_triangle() const {
    Laid laid;
    laid.first.assign(mesh.triangles.size() + 1, 0);
    for (const Place& place : places) laid.first[place.triangle + 1] += place.faces;
    std::partial_sum(laid.first.begin(), laid.first.end(), laid.first.begin());
    laid.samples.resize(laid.first.back());
    std::vector<std::uint32_t> next(laid.first.begin(), laid.first.end() - 1);
    for (std::uint32_t i = 0; i < places.size(); ++i)
        if (places[i].faces) laid.samples[next[places[i].triangle]++] = i;
    return laid;
}

bool LevelFit::are_joined(std::uint32_t v, std::uint32_t w) const {
    return std::ranges::any_of(walk->around(v), [&](std::uint32_t t) {
        const Triangle& corners = mesh.triangles[t];
        return std::find(corners.begin(), corners.end(), w) != corners.end();
    });
}

/// Around edge k of a triangle, unless it is a boundary or its swap would not leave a manifold. `walk` is
/// from before the swaps of this pass, none of which shares a vertex with the triangle.
std::optional<LevelFit::Diamond> LevelFit::diamond_at(std::uint32_t t, std::size_t k) const {
    const Triangle& one = mesh.triangles[t];
    Diamond at{t, no_triangle, one[k], one[(k + 1) % 3], one[(k + 2) % 3], 0};
    if (at.a > at.b) return {};
    for (const std::uint32_t other : walk->around(at.a))
        for (std::size_t j = 0; j < 3; ++j)
            if (const Triangle& two = mesh.triangles[other]; two[j] == at.b && two[(j + 1) % 3] == at.a) {
                at.right = other;
                at.d = two[(j + 2) % 3];
            }
    if (at.right == no_triangle || at.c == at.d || are_joined(at.c, at.d)) return {};
    if (walk->around(at.a).size() < 4 || walk->around(at.b).size() < 4) return {};
    return at;
}

bool LevelFit::better_swapped(const Diamond& at, std::span<const std::uint32_t> laid_left,
                              std::span<const std::uint32_t> laid_right) const {
    const Corners was[2] = {Corners(mesh, {at.a, at.b, at.c}), Corners(mesh, {at.b, at.a, at.d})},
                  now[2] = {Corners(mesh, {at.a, at.d, at.c}), Corners(mesh, {at.d, at.b, at.c})};
    const glm::dvec3 mean = was[0].normal() + was[1].normal();
    if (cosine(now[0].normal(), mean) < min_swap_cosine || cosine(now[1].normal(), mean) < min_swap_cosine)
        return false;
    if (cosine(now[0].normal(), now[1].normal()) < std::min(0.0, cosine(was[0].normal(), was[1].normal())))
        return false;
    if (std::min(now[0].quality(), now[1].quality()) <
        std::min({min_quality, was[0].quality(), was[1].quality()}))
        return false;
    const Faced old_ones[2] = {Faced(was[0]), Faced(was[1])}, new_ones[2] = {Faced(now[0]), Faced(now[1])};
    double before = 0, after = 0;
    for (const std::uint32_t i : laid_left) before += nearest_of(samples[i].at, old_ones[0], old_ones[1]);
    for (const std::uint32_t i : laid_right) before += nearest_of(samples[i].at, old_ones[1], old_ones[0]);
    before *= 1 - min_swap_gain;
    for (const auto* laid : {&laid_left, &laid_right})
        for (const std::uint32_t i : *laid) {
            const glm::dvec3& p = samples[i].at;
            const bool second = glm::dot(new_ones[0].outwards[1], p - new_ones[0].at.b) > 0;
            after += nearest_of(p, new_ones[second], new_ones[!second]);
            if (after >= before) return false;
        }
    if (!(after < before)) return false;
    const std::uint32_t near = laid_left.empty() ? laid_right.front() : laid_left.front();
    return after + squares_of(now[0], near) + squares_of(now[1], near) <
           before + squares_of(was[0], near) + squares_of(was[1], near);
}

/// Of points of a triangle of the level from the surface, as if there were as many as samples of that area.
double LevelFit::squares_of(const Corners& triangle, std::uint32_t near) const {
    const glm::dvec3 normal = triangle.normal();
    double sum = 0;
    for (const glm::dvec3& weights : places_in_triangle) {
        const glm::dvec3 way = tree.way_to_surface(triangle.at(weights), unit(normal), near);
        sum += glm::dot(way, way);
    }
    return sum / double(std::size(places_in_triangle)) * glm::length(normal) / 2 / (spacing * spacing);
}

} // namespace glcast
