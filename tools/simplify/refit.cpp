#include "tools/simplify/refit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include "tools/mesh/point_triangle.h"
#include "tools/simplify/attributes.h"
#include "tools/simplify/crossing_guard.h"

namespace glcast {
namespace {

// Measured on teapots and spheres: four times the samples gain 2 %, twice the rounds 3 %.
constexpr std::size_t samples_per_vertex = 48, least_samples = 1'500, most_samples = 200'000;
constexpr std::size_t too_few_per_vertex = 12;
constexpr std::size_t most_walks = 1'200'000; // about a second
constexpr std::size_t most_rounds = 24, most_idle_rounds = 4;
constexpr double worth_a_round = 0.002; // of the squared distances
constexpr int sweeps = 3;
// A vertex moves as if so many samples more lay where it is.
constexpr double inertia = 0.05;
// What a move may do to a triangle: cosine of its normals before and after, and quality (1 is equilateral).
constexpr double min_cosine = 0.5, min_quality = 0.02;
// What a swap may do: cosine of each new normal with the mean of the old ones, and the share of the squared
// distances that must go.
constexpr double min_swap_cosine = 0.2, min_swap_gain = 0.01;

constexpr std::uint32_t none = UINT32_MAX;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Sample {
    glm::dvec3 at{0}, normal{0};
    std::uint32_t start = 0; ///< vertex of the remainder where its walk begins
};

struct Corners {
    glm::dvec3 a, b, c;
    glm::dvec3 normal() const { return glm::cross(b - a, c - a); } ///< as long as twice the area
    double quality() const {
        const double squares = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
        return squares > 0 ? 2 * std::sqrt(3.0) * glm::length(normal()) / squares : 0;
    }
    double squared_distance(const glm::dvec3& point) const {
        const glm::dvec3 off = nearest_in_triangle(point, a, b, c).point - point;
        return glm::dot(off, off);
    }
};

double cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0 ? glm::dot(a, b) / lengths : 0;
}

Corners corners(const Mesh& mesh, const Triangle& t) {
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

} // namespace

SurfaceArea::SurfaceArea(const Mesh& mesh) : surface(mesh), up_to(mesh.triangles.size()) {
    tbb::parallel_for(std::size_t(0), up_to.size(), [&](std::size_t t) {
        up_to[t] = glm::length(corners(surface, surface.triangles[t]).normal());
    });
    std::partial_sum(up_to.begin(), up_to.end(), up_to.begin()); // in one order
}

namespace {

/// Evenly by area; within a triangle by Roberts's R2 sequence, folded.
std::vector<Sample> spread(const SurfaceArea& over, const std::vector<std::uint32_t>& became,
                           std::size_t count) {
    const double total = over.up_to.empty() ? 0 : over.up_to.back();
    std::vector<Sample> samples;
    if (!(total > 0)) return samples;
    samples.resize(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
        const double before = (double(i) + 0.5) * total / double(count);
        const auto found = std::upper_bound(over.up_to.begin(), over.up_to.end(), before);
        const Triangle& triangle =
            over.surface.triangles[std::min(std::size_t(found - over.up_to.begin()), over.up_to.size() - 1)];
        const double k = double(i + 1);
        double u = std::fmod(0.5 + k * 0.7548776662466927, 1), v = std::fmod(0.5 + k * 0.5698402909980532, 1);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Corners at = corners(over.surface, triangle);
        samples[i] = {at.a + u * (at.b - at.a) + v * (at.c - at.a), at.normal(), became[triangle[0]]};
    });
    return samples;
}

/// A triangle of the level, and its sides: how far a point is beyond one it is no nearer to the triangle.
struct Faced {
    Corners at;
    glm::dvec3 normal;      ///< as long as twice the area
    glm::dvec3 outwards[3]; ///< of each side, of length 1 in the triangle's plane; 0 where there is none

    explicit Faced(const Corners& corners) : at(corners), normal(corners.normal()) {
        const glm::dvec3 sides[3] = {at.b - at.a, at.c - at.b, at.a - at.c};
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 out = glm::cross(sides[k], normal);
            const double length = glm::length(out);
            outwards[k] = length > 0 ? out / length : glm::dvec3(0);
        }
    }
    bool is_further(const glm::dvec3& point, double squared) const {
        const glm::dvec3* const corner[3] = {&at.a, &at.b, &at.c};
        for (int k = 0; k < 3; ++k)
            if (const double beyond = glm::dot(outwards[k], point - *corner[k]);
                beyond > 0 && beyond * beyond > squared)
                return true;
        return false;
    }
};

/// Where a sample is laid on the mesh.
struct Place {
    std::uint32_t triangle = 0;
    bool faces = false; ///< the triangle faces as the sample does; otherwise the sample does not pull
    glm::dvec3 weights{1, 0, 0};
    glm::dvec3 off{0};         ///< from there to the sample
    double squared = infinity; ///< distance
};

class Fit {
  public:
    Fit(Mesh& level, bool closed, std::vector<Sample>&& points)
        : mesh(level), walk(std::make_unique<SurfaceWalk>(level)), samples(std::move(points)),
          places(samples.size()), guard(surface(), closed) {}

    /// Lay every sample on the mesh; the sum of their squared distances.
    double lay() {
        faced.clear();
        faced.reserve(mesh.triangles.size());
        for (const Triangle& t : mesh.triangles) faced.emplace_back(corners(mesh, t));
        tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t i) { lay(samples[i], places[i]); });
        laid = true;
        double sum = 0;
        for (const Place& place : places) sum += place.squared;
        return sum;
    }

    void move_vertices() {
        gather();
        std::vector<glm::dvec3> wanted = mesh.positions;
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) move(v);
        wanted.swap(mesh.positions);
        move_to(wanted);
    }

    /// Each vertex takes part in one swap at most, so that none undoes what another looked at.
    void swap_edges() {
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
                if (guard.crosses(surface(), change)) continue;
                mesh.triangles[left] = change.made[0];
                mesh.triangles[right] = change.made[1];
                guard.made_it(surface(), change);
                touched[a] = touched[b] = touched[c] = touched[d] = any = true;
                break;
            }
        if (any) walk = std::make_unique<SurfaceWalk>(mesh);
    }

  private:
    struct Pull {
        double weight; ///< of the vertex
        std::uint32_t sample;
    };
    /// Two triangles, a b c and b a d, that may become a d c and d b c.
    struct Diamond {
        std::uint32_t left, right, a, b, c, d;
    };

    void lay(const Sample& sample, Place& place) const {
        const std::uint32_t before_this = place.triangle;
        place = Place{};
        Seen seen;
        if (laid) // most stay near where they were
            look_at(sample, before_this, place);
        else
            look_around(sample, sample.start, place, seen);
        for (double before = infinity; place.squared < before;) {
            before = place.squared;
            for (const std::uint32_t v : Triangle(mesh.triangles[place.triangle]))
                look_around(sample, v, place, seen);
        }
    }

    /// The vertices that a walk looked around last: what lies there is no nearer the second time.
    struct Seen {
        std::array<std::uint32_t, 8> vertices;
        std::size_t count = 0;

        bool add(std::uint32_t vertex) {
            const auto end = vertices.begin() + std::ptrdiff_t(std::min(count, vertices.size()));
            if (std::find(vertices.begin(), end, vertex) != end) return false;
            vertices[count++ % vertices.size()] = vertex;
            return true;
        }
    };

    void look_around(const Sample& sample, std::uint32_t vertex, Place& best, Seen& seen) const {
        if (!seen.add(vertex)) return;
        for (const std::uint32_t triangle : walk->around(vertex)) look_at(sample, triangle, best);
    }

    void look_at(const Sample& sample, std::uint32_t triangle, Place& best) const {
        const Faced& t = faced[triangle];
        if (best.faces && t.is_further(sample.at, best.squared)) return; // most end here
        const bool faces = glm::dot(t.normal, sample.normal) > 0;
        if (best.faces && !faces) return;
        const bool must_be_nearer = best.faces || !faces;
        if (!faces && t.is_further(sample.at, best.squared)) return;
        const TrianglePoint found = nearest_in_triangle(sample.at, t.at.a, t.at.b, t.at.c);
        const glm::dvec3 off = sample.at - found.point;
        const double squared = glm::dot(off, off);
        if (!must_be_nearer || squared < best.squared) best = {triangle, faces, found.weights, off, squared};
    }

    /// Which samples pull at which vertex, by vertex.
    void gather() {
        first.assign(mesh.positions.size() + 1, 0);
        for (const Place& place : places)
            if (place.faces)
                for (const std::uint32_t v : mesh.triangles[place.triangle]) ++first[v + 1];
        for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
        pulls.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t i = 0; i < places.size(); ++i)
            for (int k = 0; places[i].faces && k < 3; ++k)
                pulls[next[mesh.triangles[places[i].triangle][std::size_t(k)]]++] = {places[i].weights[k], i};
    }

    /// To the least squares of its own samples while its neighbours stand still (Gauss-Seidel).
    void move(std::uint32_t v) {
        const auto own = std::span(pulls).subspan(first[v], first[v + 1] - first[v]);
        glm::dvec3 sum(0);
        double weight = inertia;
        for (const Pull& pull : own) {
            sum += pull.weight * places[pull.sample].off;
            weight += pull.weight * pull.weight;
        }
        glm::dvec3 step = sum / weight;
        for (int attempt = 0; attempt < 3; ++attempt, step *= 0.5)
            if (keeps_shape(v, mesh.positions[v] + step)) {
                mesh.positions[v] += step;
                for (const Pull& pull : own) places[pull.sample].off -= pull.weight * step;
                return;
            }
    }

    /// One vertex after the other, so that the surface never passes through itself; who is in another's way
    /// waits until that one has moved, and at last goes half the way, or none.
    void move_to(const std::vector<glm::dvec3>& wanted) {
        guard.build(surface());
        std::vector<std::uint32_t> waiting, still;
        for (std::uint32_t v = 0; v < wanted.size(); ++v)
            if (wanted[v] != mesh.positions[v]) waiting.push_back(v);
        for (const double share : {1.0, 1.0, 0.5, 0.5, 0.25}) {
            still.clear();
            for (const std::uint32_t v : waiting)
                if (!move_guarded(v, mesh.positions[v] + share * (wanted[v] - mesh.positions[v])))
                    still.push_back(v);
            waiting.swap(still);
        }
    }

    bool move_guarded(std::uint32_t v, const glm::dvec3& to) {
        const auto around = walk->around(v);
        SurfaceChange change{{around.begin(), around.end()}, {}, v, to};
        for (const std::uint32_t t : change.replaced) change.made.push_back(mesh.triangles[t]);
        if (guard.crosses(surface(), change)) return false;
        mesh.positions[v] = to;
        guard.made_it(surface(), change);
        return true;
    }

    CrossingGuard::Surface surface() const {
        return {mesh.positions,
                {mesh.triangles.empty() ? nullptr : mesh.triangles[0].data(), 3 * mesh.triangles.size()}};
    }

    bool keeps_shape(std::uint32_t v, const glm::dvec3& to) const {
        for (const std::uint32_t triangle : walk->around(v)) {
            const Triangle& t = mesh.triangles[triangle];
            const Corners before = corners(mesh, t);
            const Corners after{t[0] == v ? to : before.a, t[1] == v ? to : before.b,
                                t[2] == v ? to : before.c};
            if (cosine(before.normal(), after.normal()) < min_cosine) return false;
            const double good = after.quality();
            if (good < min_quality && good < before.quality()) return false;
        }
        return true;
    }

    /// Lists of samples, by triangle.
    struct Laid {
        std::vector<std::uint32_t> first, samples;
        std::span<const std::uint32_t> operator()(std::uint32_t t) const {
            return std::span(samples).subspan(first[t], first[t + 1] - first[t]);
        }
    };

    Laid samples_by_triangle() const {
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

    bool are_joined(std::uint32_t v, std::uint32_t w) const {
        return std::ranges::any_of(walk->around(v), [&](std::uint32_t t) {
            const Triangle& corners = mesh.triangles[t];
            return std::find(corners.begin(), corners.end(), w) != corners.end();
        });
    }

    /// Around edge k of a triangle, unless it is a boundary or its swap would not leave a manifold. `walk` is
    /// from before the swaps of this pass, none of which shares a vertex with the triangle.
    std::optional<Diamond> diamond_at(std::uint32_t t, std::size_t k) const {
        const Triangle& one = mesh.triangles[t];
        Diamond at{t, none, one[k], one[(k + 1) % 3], one[(k + 2) % 3], 0};
        if (at.a > at.b) return {};
        for (const std::uint32_t other : walk->around(at.a))
            for (std::size_t j = 0; j < 3; ++j)
                if (const Triangle& two = mesh.triangles[other]; two[j] == at.b && two[(j + 1) % 3] == at.a) {
                    at.right = other;
                    at.d = two[(j + 2) % 3];
                }
        if (at.right == none || at.c == at.d || are_joined(at.c, at.d)) return {};
        if (walk->around(at.a).size() < 4 || walk->around(at.b).size() < 4) return {};
        return at;
    }

    bool better_swapped(const Diamond& at, std::span<const std::uint32_t> laid_left,
                        std::span<const std::uint32_t> laid_right) const {
        const Corners was[2] = {corners(mesh, {at.a, at.b, at.c}), corners(mesh, {at.b, at.a, at.d})},
                      now[2] = {corners(mesh, {at.a, at.d, at.c}), corners(mesh, {at.d, at.b, at.c})};
        const glm::dvec3 mean = was[0].normal() + was[1].normal();
        if (cosine(now[0].normal(), mean) < min_swap_cosine ||
            cosine(now[1].normal(), mean) < min_swap_cosine)
            return false;
        if (cosine(now[0].normal(), now[1].normal()) <
            std::min(0.0, cosine(was[0].normal(), was[1].normal())))
            return false;
        if (std::min(now[0].quality(), now[1].quality()) <
            std::min({min_quality, was[0].quality(), was[1].quality()}))
            return false;
        const Faced old_ones[2] = {Faced(was[0]), Faced(was[1])},
                    new_ones[2] = {Faced(now[0]), Faced(now[1])};
        double before = 0, after = 0;
        for (const std::uint32_t i : laid_left) before += nearest_of(samples[i].at, old_ones[0], old_ones[1]);
        for (const std::uint32_t i : laid_right)
            before += nearest_of(samples[i].at, old_ones[1], old_ones[0]);
        before *= 1 - min_swap_gain;
        for (const auto* laid : {&laid_left, &laid_right})
            for (const std::uint32_t i : *laid) {
                const glm::dvec3& p = samples[i].at;
                const bool second = glm::dot(new_ones[0].outwards[1], p - new_ones[0].at.b) > 0;
                after += nearest_of(p, new_ones[second], new_ones[!second]);
                if (after >= before) return false;
            }
        return after < before;
    }

    /// Squared distance from the nearer one: likely the first.
    static double nearest_of(const glm::dvec3& point, const Faced& likely, const Faced& other) {
        const double squared = likely.at.squared_distance(point);
        return other.is_further(point, squared) ? squared
                                                : std::min(squared, other.at.squared_distance(point));
    }

    Mesh& mesh;
    std::unique_ptr<SurfaceWalk> walk;
    std::vector<Sample> samples;
    std::vector<Place> places;
    bool laid = false;                ///< `places` are those of the last round
    std::vector<Faced> faced;         ///< by triangle, as they were when samples were laid last
    std::vector<std::uint32_t> first; ///< per vertex, where its pulls begin; one more at the end
    std::vector<Pull> pulls;
    CrossingGuard guard;
};

} // namespace

void refit(Collapser::Remainder& remainder, const SurfaceArea& surface) {
    const std::size_t vertices = remainder.positions.size();
    const std::size_t count = std::clamp(samples_per_vertex * vertices, least_samples, most_samples);
    if (count < too_few_per_vertex * vertices) return;
    Mesh level;
    level.positions = remainder.positions;
    level.triangles = remainder.triangles;
    std::vector<Sample> samples = spread(surface, remainder.became, count);
    if (samples.empty()) return;
    Fit fit(level, remainder.closed, std::move(samples));
    const std::size_t rounds = std::min(most_rounds, most_walks / count);
    double least = infinity; // what a round makes of it may be worse: the best is kept
    for (std::size_t round = 0, idle = 0;; ++round) {
        const double squares = fit.lay();
        idle = squares < (1 - worth_a_round) * least ? 0 : idle + 1;
        if (squares < least) {
            least = squares;
            remainder.positions = level.positions;
            remainder.triangles = level.triangles;
        }
        if (round == rounds || idle == most_idle_rounds) return;
        fit.move_vertices();
        fit.swap_edges();
    }
}

} // namespace glcast
