#include "tools/simplify/refit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>

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

/// Evenly by area; within a triangle by Roberts's R2 sequence, folded.
std::vector<Sample> spread(const Mesh& surface, const std::vector<std::uint32_t>& became, std::size_t count) {
    std::vector<double> areas(surface.triangles.size()); // twice; the sums stay in one order
    tbb::parallel_for(std::size_t(0), areas.size(), [&](std::size_t t) {
        areas[t] = glm::length(corners(surface, surface.triangles[t]).normal());
    });
    double total = 0, passed = 0;
    for (const double area : areas) total += area;
    std::vector<Sample> samples;
    if (!(total > 0)) return samples;
    samples.reserve(count);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        passed += areas[i];
        while (samples.size() < count && (double(samples.size()) + 0.5) * total < passed * double(count)) {
            const double k = double(samples.size() + 1);
            double u = std::fmod(0.5 + k * 0.7548776662466927, 1),
                   v = std::fmod(0.5 + k * 0.5698402909980532, 1);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const Corners at = corners(surface, surface.triangles[i]);
            samples.push_back(
                {at.a + u * (at.b - at.a) + v * (at.c - at.a), at.normal(), became[surface.triangles[i][0]]});
        }
    }
    return samples;
}

/// Where a sample is laid on the mesh.
struct Place {
    std::uint32_t triangle = 0;
    bool faces = false; ///< the triangle faces as the sample does; otherwise the sample does not pull
    glm::dvec3 weights{1, 0, 0};
    double squared = infinity; ///< distance
};

class Fit {
  public:
    Fit(Mesh& level, bool closed, std::vector<Sample>&& points)
        : mesh(level), walk(std::make_unique<SurfaceWalk>(level)), samples(std::move(points)),
          places(samples.size()), guard(surface(), closed) {}

    /// Lay every sample on the mesh; the sum of their squared distances.
    double lay() {
        tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t i) { lay(samples[i], places[i]); });
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
        const Edges edges = directed_edges();
        const std::vector<std::vector<std::uint32_t>> laid = samples_by_triangle();
        std::vector<bool> touched(mesh.positions.size());
        bool any = false;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto diamond = diamond_at(edges, t, k);
                if (!diamond) continue;
                const auto& [left, right, a, b, c, d] = *diamond;
                if (touched[a] || touched[b] || touched[c] || touched[d]) continue;
                if (!better_swapped(*diamond, laid[left], laid[right])) continue;
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
        std::uint32_t sample;
        int corner;
    };
    /// Directed edge, to the triangle on its left.
    using Edges = std::unordered_map<std::uint64_t, std::uint32_t>;
    /// Two triangles, a b c and b a d, that may become a d c and d b c.
    struct Diamond {
        std::uint32_t left, right, a, b, c, d;
    };

    void lay(Sample& sample, Place& place) const {
        place = Place{};
        Seen seen;
        look_around(sample, sample.start, place, seen);
        for (double before = infinity; place.squared < before;) {
            before = place.squared;
            for (const std::uint32_t v : Triangle(mesh.triangles[place.triangle]))
                look_around(sample, v, place, seen);
        }
        sample.start = mesh.triangles[place.triangle][0];
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
        for (const std::uint32_t triangle : walk->around(vertex)) {
            const Corners at = corners(mesh, mesh.triangles[triangle]);
            const bool faces = glm::dot(at.normal(), sample.normal) > 0;
            if (best.faces && !faces) continue;
            const TrianglePoint found = nearest_in_triangle(sample.at, at.a, at.b, at.c);
            const glm::dvec3 off = found.point - sample.at;
            const double squared = glm::dot(off, off);
            if ((faces && !best.faces) || squared < best.squared)
                best = {triangle, faces, found.weights, squared};
        }
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
                pulls[next[mesh.triangles[places[i].triangle][std::size_t(k)]]++] = {i, k};
    }

    /// To the least squares of its own samples while its neighbours stand still (Gauss-Seidel).
    void move(std::uint32_t v) {
        glm::dvec3 sum(0);
        double weight = inertia;
        for (std::uint32_t p = first[v]; p < first[v + 1]; ++p) {
            const Place& place = places[pulls[p].sample];
            const Corners at = corners(mesh, mesh.triangles[place.triangle]);
            const glm::dvec3 now =
                place.weights[0] * at.a + place.weights[1] * at.b + place.weights[2] * at.c;
            const double w = place.weights[pulls[p].corner];
            sum += w * (samples[pulls[p].sample].at - now);
            weight += w * w;
        }
        glm::dvec3 step = sum / weight;
        for (int attempt = 0; attempt < 3; ++attempt, step *= 0.5)
            if (keeps_shape(v, mesh.positions[v] + step)) {
                mesh.positions[v] += step;
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

    static std::uint64_t key(std::uint32_t from, std::uint32_t to) { return std::uint64_t(from) << 32 | to; }

    Edges directed_edges() const {
        Edges edges;
        edges.reserve(mesh.triangles.size() * 3);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                edges[key(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])] = t;
        return edges;
    }

    std::vector<std::vector<std::uint32_t>> samples_by_triangle() const {
        std::vector<std::vector<std::uint32_t>> laid(mesh.triangles.size());
        for (std::uint32_t i = 0; i < places.size(); ++i)
            if (places[i].faces) laid[places[i].triangle].push_back(i);
        return laid;
    }

    /// Around edge k of a triangle, unless it is a boundary or its swap would not leave a manifold. `edges`
    /// is from before the swaps of this pass, none of which shares a vertex with a diamond that is taken.
    std::optional<Diamond> diamond_at(const Edges& edges, std::uint32_t t, std::size_t k) const {
        const Triangle& one = mesh.triangles[t];
        Diamond at{t, 0, one[k], one[(k + 1) % 3], one[(k + 2) % 3], 0};
        const auto back = edges.find(key(at.b, at.a));
        if (at.a > at.b || back == edges.end()) return {};
        at.right = back->second;
        for (const std::uint32_t v : mesh.triangles[at.right])
            if (v != at.a && v != at.b) at.d = v;
        if (at.c == at.d || edges.contains(key(at.c, at.d)) || edges.contains(key(at.d, at.c))) return {};
        if (walk->around(at.a).size() < 4 || walk->around(at.b).size() < 4) return {};
        return at;
    }

    bool better_swapped(const Diamond& at, const std::vector<std::uint32_t>& laid_left,
                        const std::vector<std::uint32_t>& laid_right) const {
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
        double before = 0, after = 0;
        for (const auto* laid : {&laid_left, &laid_right})
            for (const std::uint32_t i : *laid) {
                const glm::dvec3& p = samples[i].at;
                before += std::min(was[0].squared_distance(p), was[1].squared_distance(p));
                after += std::min(now[0].squared_distance(p), now[1].squared_distance(p));
            }
        return after < (1 - min_swap_gain) * before;
    }

    Mesh& mesh;
    std::unique_ptr<SurfaceWalk> walk;
    std::vector<Sample> samples;
    std::vector<Place> places;
    std::vector<std::uint32_t> first; ///< per vertex, where its pulls begin; one more at the end
    std::vector<Pull> pulls;
    CrossingGuard guard;
};

} // namespace

void refit(Collapser::Remainder& remainder, const Mesh& surface) {
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
