#include "tools/simplify/level_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/simplify/area_points.h"

namespace glcast {
namespace {

constexpr int sweeps = 3;
// A vertex moves as if so many samples more lay where it is.
constexpr double inertia = 0.05;
// What a move may do to a triangle: cosine of its normals before and after, and quality (1 is equilateral).
constexpr double min_cosine = 0.5, min_quality = 0.02;
// What lies beside the surface, against what of the surface lies beside the level. Measured on teapots and
// spheres at n = 160: 1 leaves up to 3 % more of the latter, a quarter 4 % more of the former.
constexpr double back_importance = 0.5;
constexpr double vertex_importance = 1; // against a sample
// So many times farther from the surface than that is from the level around it, a vertex may go. Once is too
// little: an eighth more error.
constexpr double farther = 2;
constexpr int most_halvings = 4;
constexpr double folded = -0.985; // cosine of the normals at an edge: ten degrees from back to back

} // namespace

LevelFit::LevelFit(Mesh& level, bool closed, std::vector<Sample>&& of_surface, double apart,
                   const SurfaceWalk& along, double back)
    : mesh(level), walk(std::make_unique<SurfaceWalk>(level)), samples(std::move(of_surface)), spacing(apart),
      back(back), tree(samples, apart, along), places(samples.size()), guard(surface(), closed) {}

double LevelFit::lay() {
    faced.clear();
    faced.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) faced.emplace_back(Corners(mesh, t));
    tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t i) { lay(samples[i], places[i]); });
    laid = true;
    double sum = 0;
    for (const Place& place : places) sum += place.squared;
    return sum + lay_level();
}

/// The vertices that a walk looked around last: what lies there is no nearer the second time.
struct LevelFit::Seen {
    std::array<std::uint32_t, 8> vertices;
    std::size_t count = 0;

    bool add(std::uint32_t vertex) {
        const auto end = vertices.begin() + std::ptrdiff_t(std::min(count, vertices.size()));
        if (std::find(vertices.begin(), end, vertex) != end) return false;
        vertices[count++ % vertices.size()] = vertex;
        return true;
    }
};

void LevelFit::lay(const Sample& sample, Place& place) const {
    const std::uint32_t before_this = place.triangle;
    place = Place{};
    Seen seen;
    if (laid) // most stay near where they were
        look_at(sample, before_this, place);
    else
        look_around(sample, sample.start, place, seen);
    for (double before = INFINITY; place.squared < before;) {
        before = place.squared;
        for (const std::uint32_t v : Triangle(mesh.triangles[place.triangle]))
            look_around(sample, v, place, seen);
    }
}

void LevelFit::look_around(const Sample& sample, std::uint32_t vertex, Place& best, Seen& seen) const {
    if (!seen.add(vertex)) return;
    for (const std::uint32_t triangle : walk->around(vertex)) look_at(sample, triangle, best);
}

void LevelFit::look_at(const Sample& sample, std::uint32_t triangle, Place& best) const {
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

/// Points spread over the level, and its vertices, where a spike would end.
void LevelFit::spread_over_level() {
    const SurfaceArea area(mesh);
    const std::size_t count = samples.size() / 2; // as many as that make hardly a difference to all
    const double alike = area.total() / (spacing * spacing) / double(count);
    const std::vector<AreaPoint> by_area = area_points(area, count);
    points.resize(by_area.size() + mesh.positions.size());
    for (std::size_t i = 0; i < by_area.size(); ++i)
        points[i] = {
            {by_area[i].triangle, true, by_area[i].weights}, points[i].near, back_importance * alike};
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 weights(0);
            weights[k] = 1;
            OnLevel& on = points[by_area.size() + mesh.triangles[t][std::size_t(k)]];
            on = {{t, true, weights}, on.near, vertex_importance};
        }
}

double LevelFit::lay_level() {
    spread_over_level();
    const std::size_t vertices = mesh.positions.size();
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        OnLevel& on = points[i];
        const Faced& t = faced[on.place.triangle];
        const bool is_vertex = i + vertices >= points.size();
        on.place.off = tree.way_to_surface(t.at.at(on.place.weights),
                                           is_vertex ? glm::dvec3(0) : unit(t.normal), on.near);
        on.place.squared = glm::dot(on.place.off, on.place.off);
    });
    double sum = 0;
    for (const OnLevel& on : points) sum += on.importance * on.place.squared;
    return sum;
}

void LevelFit::move_vertices() {
    gather();
    std::vector<glm::dvec3> wanted = mesh.positions;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) move(v);
    wanted.swap(mesh.positions);
    hold_back(wanted);
    move_to(wanted);
}

/// What pulls at which vertex, by vertex.
void LevelFit::gather() {
    first.assign(mesh.positions.size() + 1, 0);
    const auto each = [&](const auto& f) {
        for (Place& place : places)
            if (place.faces) f(place, 1.0);
        for (OnLevel& on : points) f(on.place, back * on.importance);
    };
    each([&](Place& place, double) {
        for (const std::uint32_t v : mesh.triangles[place.triangle]) ++first[v + 1];
    });
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    pulls.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    each([&](Place& place, double importance) {
        for (int k = 0; k < 3; ++k)
            pulls[next[mesh.triangles[place.triangle][std::size_t(k)]]++] = {place.weights[k], importance,
                                                                             &place.off};
    });
}

/// To the least squares of its own samples while its neighbours stand still (Gauss-Seidel).
void LevelFit::move(std::uint32_t v) {
    const auto own = std::span(pulls).subspan(first[v], first[v + 1] - first[v]);
    glm::dvec3 sum(0);
    double weight = inertia;
    for (const Pull& pull : own) {
        sum += pull.importance * pull.weight * *pull.off;
        weight += pull.importance * pull.weight * pull.weight;
    }
    glm::dvec3 step = sum / weight;
    for (int attempt = 0; attempt < 3; ++attempt, step *= 0.5)
        if (keeps_shape(v, mesh.positions[v] + step)) {
            mesh.positions[v] += step;
            for (const Pull& pull : own) *pull.off -= pull.weight * step;
            return;
        }
}

/// No vertex farther from the surface than it is, or than a sample laid around it is from the level.
void LevelFit::hold_back(std::vector<glm::dvec3>& wanted) const {
    std::vector<double> most(mesh.positions.size(), 0);
    for (const Place& place : places)
        for (const std::uint32_t v : mesh.triangles[place.triangle])
            most[v] = std::max(most[v], place.squared);
    const std::size_t by_area = points.size() - most.size();
    tbb::parallel_for(std::size_t(0), most.size(), [&](std::size_t v) {
        const OnLevel& now = points[by_area + v];
        const double farthest = farther * farther * std::max(most[v], now.place.squared);
        for (int attempt = 0; attempt < most_halvings; ++attempt) {
            std::uint32_t near = now.near;
            const glm::dvec3 way = tree.way_to_surface(wanted[v], glm::dvec3(0), near);
            if (glm::dot(way, way) <= farthest) return;
            wanted[v] = 0.5 * (wanted[v] + mesh.positions[v]);
        }
        wanted[v] = mesh.positions[v];
    });
}

/// One vertex after the other, so that the surface never passes through itself; who is in another's way
/// waits until that one has moved, and at last goes half the way, or none.
void LevelFit::move_to(const std::vector<glm::dvec3>& wanted) {
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

bool LevelFit::move_guarded(std::uint32_t v, const glm::dvec3& to) {
    const auto around = walk->around(v);
    SurfaceChange change{{around.begin(), around.end()}, {}, v, to};
    for (const std::uint32_t t : change.replaced) change.made.push_back(mesh.triangles[t]);
    if (folds(change) || guard.crosses(surface(), change)) return false;
    mesh.positions[v] = to;
    guard.made_it(surface(), change);
    return true;
}

bool LevelFit::keeps_shape(std::uint32_t v, const glm::dvec3& to) const {
    for (const std::uint32_t triangle : walk->around(v)) {
        const Triangle& t = mesh.triangles[triangle];
        const Corners before(mesh, t);
        const Corners after{t[0] == v ? to : before.a, t[1] == v ? to : before.b, t[2] == v ? to : before.c};
        if (cosine(before.normal(), after.normal()) < min_cosine) return false;
        const double good = after.quality();
        if (good < min_quality && good < before.quality()) return false;
    }
    return true;
}

/// The least cosine of normals at an edge of `triangles`, corners and all, to one another and to what they
/// are joined to, `replaced` left out.
double LevelFit::sharpest(std::span<const Triangle> triangles, const SurfaceChange& change, bool made) const {
    const auto normal = [&](const Triangle& t) {
        glm::dvec3 at[3];
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = made && t[k] == change.moved ? change.to : mesh.positions[t[k]];
        return glm::cross(at[1] - at[0], at[2] - at[0]);
    };
    double least = 1;
    for (const Triangle& t : triangles) {
        const glm::dvec3 own = normal(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[(k + 1) % 3], to = t[k]; // as the neighbour runs
            const auto look = [&](const Triangle& other) {
                for (std::size_t j = 0; j < 3; ++j)
                    if (other[j] == from && other[(j + 1) % 3] == to)
                        least = std::min(least, cosine(own, normal(other)));
            };
            for (const Triangle& other : triangles) look(other);
            for (const std::uint32_t other : walk->around(from))
                if (std::ranges::find(change.replaced, other) == change.replaced.end())
                    look(mesh.triangles[other]);
        }
    }
    return least;
}

/// Would two triangles come to lie back to back, where none did?
bool LevelFit::folds(const SurfaceChange& change) const {
    if (sharpest(change.made, change, true) >= folded) return false;
    std::vector<Triangle> before;
    for (const std::uint32_t t : change.replaced) before.push_back(mesh.triangles[t]);
    return sharpest(before, change, false) >= folded;
}

} // namespace glcast
