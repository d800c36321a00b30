#include "tools/texture/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tools/mesh/intersections.h"
#include "tools/texture/least_squares.h"
#include "tools/texture/neighbours.h"
#include "tools/texture/reach.h"
#include "tools/texture/views.h"

namespace glcast {
namespace {

// Measured on the teapot and bouncingcow's cow at 2,000 triangles, n = 512: see docs/design/textures.md.
constexpr double near_enough = 0.05; // samples: mean distance of the surface
constexpr std::size_t most_triangles = 30'000;
constexpr std::size_t most_asked = 4'000; // triangles, for how near the surface is

constexpr int rounds = 3;
constexpr double surface_importance = 2; // of all triangles, against outlines
constexpr double inertia = 0.02;         // of what a vertex's part of the surface weighs
constexpr double beside = 0.1;           // samples
constexpr double farthest_move = 1;      // samples, a round,
constexpr double farthest_of_mean =
    2; // and so many mean distances of the surface: the worst places stay as near
constexpr float least_cosine = 0.5f;       // of a triangle's normals before and after
constexpr double flattest_edge = 0.01;     // radians
constexpr double farther_than_surface = 3; // outlines are sought in so many times the reach
constexpr int most_halvings = 3;
constexpr int most_undone = 16; // rounds of undoing, then all is undone

// Gauss-Legendre on an edge; directions of sight against it: two points for the weight cos^2.
constexpr double places_on_edge[] = {0.2113248654, 0.7886751346};
constexpr double slants[] = {-0.5679, 0.5679};
// Six points of a triangle, exact to the fourth degree (Strang and Fix 1973), by the odd one's weight.
struct PlaceInTriangle {
    double own, others, share;
};
constexpr PlaceInTriangle places_in_triangle[] = {{0.108103018, 0.445948491, 0.223381590},
                                                  {0.816847573, 0.091576214, 0.109951744}};

/// What the captured surface asks of the points of a level; samples.
class Residuals {
  public:
    Residuals(const Mesh& mesh, const CapturedSurface& captured, const Neighbours& neighbours,
              const std::vector<glm::vec3>& normals)
        : mesh(mesh), captured(captured), neighbours(neighbours), normals(normals),
          reach(needed_reach(mesh, captured, normals)) {}

    std::vector<Residual> all() const {
        return of_triangles(1, [&](std::uint32_t t, double importance, std::vector<Residual>& out) {
            add_surface(t, importance, out);
            for (int k = 0; k < 3; ++k) add_outline(t, k, out);
        });
    }

    /// Of the surface alone, at some of the triangles.
    std::vector<Residual> some_of_surface() const {
        return of_triangles(1 + mesh.triangles.size() / most_asked,
                            [&](std::uint32_t t, double importance, std::vector<Residual>& out) {
                                add_surface(t, importance, out);
                            });
    }

  private:
    template <class Add> std::vector<Residual> of_triangles(std::size_t step, const Add& add) const {
        std::vector<std::vector<Residual>> own((mesh.triangles.size() + step - 1) / step);
        const double importance = surface_importance / typical_edge();
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, own.size(), 64), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                add(std::uint32_t(i * step), importance, own[i]);
        });
        std::vector<Residual> out;
        for (const auto& part : own) out.insert(out.end(), part.begin(), part.end());
        return out;
    }

    glm::dvec3 position(std::uint32_t v) const { return mesh.positions[v] / captured.sample(); }
    double area(std::uint32_t t) const {
        const Triangle& v = mesh.triangles[t];
        return 0.5 *
               glm::length(glm::cross(position(v[1]) - position(v[0]), position(v[2]) - position(v[0])));
    }
    /// Of equilateral triangles with that area: makes areas comparable with lengths times angles.
    double typical_edge() const {
        double sum = 0;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += area(t);
        return std::sqrt(sum / double(mesh.triangles.size()) * 4 / std::sqrt(3.0));
    }

    void add_surface(std::uint32_t t, double importance, std::vector<Residual>& out) const {
        if (normals[t] == glm::vec3(0)) return;
        const Triangle& v = mesh.triangles[t];
        const glm::dvec3 up(normals[t]);
        const double size = area(t);
        for (const PlaceInTriangle& place : places_in_triangle)
            for (int k = 0; k < 3; ++k) {
                glm::dvec3 w(place.others);
                w[k] = place.own;
                const glm::dvec3 at = w.x * position(v[0]) + w.y * position(v[1]) + w.z * position(v[2]);
                if (const auto height = height_over(at, up, reach))
                    out.push_back({v, w, up, *height, importance * size * place.share});
            }
    }

    /// The edge from corner k is an outline for those directions of sight that lie between its two triangles.
    void add_outline(std::uint32_t t, int k, std::vector<Residual>& out) const {
        const std::uint32_t other = neighbours.across[t][k];
        if (other == no_triangle || other < t) return;
        const glm::dvec3 first(normals[t]), second(normals[other]);
        const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        const glm::dvec3 along = position(b) - position(a);
        const double length = glm::length(along);
        if (!(length > 0)) return;
        const glm::dvec3 edge = along / length;
        const double bend = std::atan2(glm::dot(glm::cross(first, second), edge), glm::dot(first, second));
        if (!(bend > flattest_edge)) return; // concave: something else hides it
        const glm::dvec3 up =
            glm::normalize(std::cos(bend / 2) * first + std::sin(bend / 2) * glm::cross(edge, first));
        const double span = (area(t) + area(other)) / length; // across both triangles, half of it
        for (const double place : places_on_edge)
            for (const double slant : slants) {
                const glm::dvec3 sight = std::sin(slant) * edge + std::cos(slant) * glm::cross(edge, up);
                if (const auto height = outline_over(position(a) + place * along, up, sight, span))
                    out.push_back({{a, b, a}, {1 - place, place, 0}, up, *height, length * bend / 4});
            }
    }

    /// Height of the captured surface over a point; unknown where what is found lies beside, as at the rim of
    /// what a view covers.
    std::optional<double> height_over(const glm::dvec3& at, const glm::dvec3& up, double most) const {
        const auto found = captured.find_position(at * captured.sample(), glm::vec3(up), glm::vec3(up), most);
        if (!found) return std::nullopt;
        const glm::dvec3 off = *found / captured.sample() - at;
        const double height = glm::dot(off, up);
        if (glm::length(off - height * up) > beside) return std::nullopt;
        return height;
    }

    /// Height of its outline over the line of sight through a point: the highest of what lies over the line
    /// there and up to half a span to both sides. No curve is laid through: there may be a crease.
    std::optional<double> outline_over(const glm::dvec3& at, const glm::dvec3& up, const glm::dvec3& sight,
                                       double span) const {
        std::optional<double> top = height_over(at, up, reach);
        if (!top) return std::nullopt;
        for (const double far : {-0.5, -0.25, 0.25, 0.5})
            if (const auto height = height_over(at + far * span * sight, up, farther_than_surface * reach))
                top = std::max(*top, *height);
        return *top > reach ? std::nullopt : top;
    }

    const Mesh& mesh;
    const CapturedSurface& captured;
    const Neighbours& neighbours;
    const std::vector<glm::vec3>& normals;
    const double reach;
};

/// Takes moves back where triangles turned or cross others now.
class Undoing {
  public:
    Undoing(Mesh& mesh, const std::vector<glm::vec3>& normals)
        : mesh(mesh), before(mesh.positions), normals(normals), halved(before.size()) {}

    void run() {
        for (int round = 0; round < most_undone; ++round) {
            while (undo_turned()) {
            }
            if (!undo_crossings()) return;
        }
        mesh.positions = before;
    }

  private:
    /// Half of its corners' moves; at last, none. False where they have not moved.
    bool undo(std::uint32_t triangle) {
        bool any = false;
        for (const std::uint32_t v : mesh.triangles[triangle]) {
            if (mesh.positions[v] == before[v]) continue;
            mesh.positions[v] =
                halved[v]++ < most_halvings ? 0.5 * (before[v] + mesh.positions[v]) : before[v];
            any = true;
        }
        return any;
    }
    bool undo_turned() {
        bool any = false;
        const std::vector<glm::vec3> now = triangle_normals(mesh);
        for (std::uint32_t t = 0; t < now.size(); ++t)
            if (glm::dot(now[t], normals[t]) < least_cosine) any = undo(t) || any;
        return any;
    }
    bool undo_crossings() {
        const auto now = find_self_intersections(mesh.positions, mesh.triangles);
        if (now.empty()) return false; // as nearly always, whatever crossed before
        if (!crossed) crossed = find_self_intersections(before, mesh.triangles);
        std::vector<TrianglePair> made;
        std::set_difference(now.begin(), now.end(), crossed->begin(), crossed->end(),
                            std::back_inserter(made));
        bool any = false;
        for (const auto& [s, t] : made) {
            any = undo(s) || any;
            any = undo(t) || any;
        }
        return any;
    }

    Mesh& mesh;
    const std::vector<glm::dvec3> before;
    const std::vector<glm::vec3>& normals;
    std::optional<std::vector<TrianglePair>> crossed; ///< before; where it was asked
    std::vector<int> halved;                          ///< by vertex: how often
};

void move(Mesh& mesh, const std::vector<glm::dvec3>& by, double farthest, double sample) {
    for (std::size_t v = 0; v < by.size(); ++v) {
        const double far = glm::length(by[v]);
        mesh.positions[v] += by[v] * (sample * (far > farthest ? farthest / far : 1));
    }
}

double mean_surface_importance(std::span<const Residual> residuals, std::size_t vertices) {
    double sum = 0;
    for (const Residual& r : residuals) sum += r.weights.z != 0 ? r.importance : 0;
    return sum / double(vertices);
}

/// How far the surface is from what was captured, in samples; where it is near, there is nothing to mend, and
/// moves would follow the noise of rims.
double mean_height(std::span<const Residual> residuals) {
    double sum = 0, all = 0;
    for (const Residual& r : residuals)
        if (r.weights.z != 0) sum += r.importance * std::abs(r.distance), all += r.importance;
    return all > 0 ? sum / all : 0;
}

} // namespace

bool fit_outlines(Mesh& mesh, const CapturedSurface& captured) {
    if (captured.empty() || mesh.triangles.size() > most_triangles) return false;
    const Neighbours neighbours = find_neighbours(mesh);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<glm::vec3> normals = triangle_normals(mesh);
        const Residuals asked(mesh, captured, neighbours, normals);
        if (round == 0 && mean_height(asked.some_of_surface()) < near_enough) return false;
        const std::vector<Residual> residuals = asked.all();
        const double mean = mean_height(residuals);
        const std::size_t vertices = mesh.positions.size();
        Undoing undoing(mesh, normals);
        move(mesh,
             least_squares_moves(residuals, vertices, inertia * mean_surface_importance(residuals, vertices)),
             std::min(farthest_move, farthest_of_mean * mean), captured.sample());
        undoing.run();
    }
    return true;
}

} // namespace glcast
