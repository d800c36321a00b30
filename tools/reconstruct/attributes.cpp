#include "tools/reconstruct/attributes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tools/mesh/whole.h"
#include "tools/reconstruct/behind.h"

namespace glcast {
namespace {

constexpr float agreement = 0.3f;      // samples between a vertex and the plane that a pixel saw
constexpr double reach = 8;            // samples along a ray to a hit that may still agree
constexpr float same_place = 1e-3f;    // samples: hits of the two sides of a sheet
constexpr float same_facet = 0.9f;     // cosine between normals of pixels that may be mixed
constexpr double reach_of_closing = 2; // samples between a vertex and the closing that it belongs to
constexpr float disagreement = 0.5f;   // cosine, 60 degrees: no shading of coarse facets bends normals so far
constexpr float square_agreement = 1.5f; // samples between a square and its pixel's depth

struct Pixel {
    float weight, score;
    std::uint32_t hit;
    glm::vec3 plane, normal;
};

glm::vec3 unit_or_zero(const glm::vec3& v) {
    const float length = glm::length(v);
    return std::isfinite(length) && length > 1e-6f ? v / length : glm::vec3(0);
}

/// To a viewer on `side` (1: plus).
glm::vec3 drawn_normal(const AxisHits& hits, int side, std::uint32_t hit) {
    const std::uint32_t packed = hits.normal_to(side, hit);
    return packed ? unpack_normal(packed) : glm::vec3(0);
}

/// One view's opinion on a point: its up to four pixels that agree with the point's place.
template <int axis> class Opinion {
  public:
    Opinion(const Rays& rays, int side, const glm::dvec3& at)
        : hits(rays.axis[axis]), n(rays.n), side(side), at(at) {}

    Attribute mix() {
        const int u = whole_below(at[axes.u]), v = whole_below(at[axes.v]);
        for (int k = 0; k < 4; ++k) consider(u + (k & 1), v + (k >> 1));
        Attribute out;
        if (!count) return out;
        const Pixel* best = pixels;
        for (int k = 1; k < count; ++k)
            if (pixels[k].score > best->score) best = pixels + k;
        float weights = 0;
        for (int k = 0; k < count; ++k) {
            const Pixel& p = pixels[k];
            if (glm::dot(p.plane, best->plane) < same_facet) continue;
            if (best->normal != glm::vec3(0) && glm::dot(p.normal, best->normal) < same_facet) continue;
            out.colour += unpack_colour(hits.colour_to(side, p.hit)) * p.weight;
            out.normal += p.normal * p.weight;
            out.plane += p.plane * p.weight;
            weights += p.weight;
        }
        out.colour /= weights;
        out.normal = unit_or_zero(out.normal);
        out.plane = unit_or_zero(out.plane);
        if ((out.plane[axis] > 0) != (side == 1)) out.plane = -out.plane;
        out.found = true;
        return out;
    }

  private:
    /// The pixel's nearest hit that agrees; of two at one depth, as the two sides of a sheet are, the one on
    /// our side.
    void consider(int u, int v) {
        if (u < 0 || v < 0 || u >= n || v >= n) return;
        const std::size_t p = std::size_t(v) * n + u;
        const std::uint32_t end = hits.start[p + 1];
        glm::vec3 from_hit;
        const double away_u = at[axes.u] - u, away_v = at[axes.v] - v;
        from_hit[axes.u] = float(away_u);
        from_hit[axes.v] = float(away_v);
        float least = agreement;
        glm::vec3 plane_there{0};
        std::uint32_t best = end;
        for (std::uint32_t i = hits.start[p]; i < end; ++i) {
            const double deeper = at[axes.depth] - hits.depth[i];
            if (std::abs(deeper) > reach || !hits.plane[i]) continue;
            from_hit[axes.depth] = float(deeper);
            const glm::vec3 plane = unpack_normal(hits.plane[i]);
            const float distance = std::abs(glm::dot(plane, from_hit));
            const bool nearer = distance < least - same_place;
            if (!nearer && !(side == 1 && best != end && distance < least + same_place)) continue;
            least = distance;
            plane_there = plane;
            best = i;
        }
        if (best == end) return;
        Pixel& pixel = pixels[count++];
        pixel.weight = float((1 - std::abs(away_u)) * (1 - std::abs(away_v))) + 1e-6f;
        pixel.score = pixel.weight / (0.05f + least);
        pixel.hit = best;
        pixel.plane = plane_there;
        pixel.normal = drawn_normal(hits, side, best);
    }

    static constexpr ImageAxes axes = image_axes(Axis(axis));
    const AxisHits& hits;
    const int n, side;
    const glm::dvec3 at;
    Pixel pixels[4]; // the first `count` are filled
    int count = 0;
};

std::vector<glm::vec3> surface_normals(const Mesh& mesh) {
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0));
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3& p = mesh.positions[t[0]];
        const glm::vec3 area(glm::cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p));
        for (std::uint32_t v : t) normals[v] += area;
    }
    for (glm::vec3& normal : normals) {
        normal = unit_or_zero(normal);
        if (normal == glm::vec3(0)) normal = {0, 0, 1};
    }
    return normals;
}

double share_of_area(const Mesh& mesh, const std::vector<std::uint8_t>& marked) {
    double area = 0, marked_area = 0;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3& p = mesh.positions[t[0]];
        const double size = glm::length(glm::cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p));
        area += 3 * size;
        marked_area += (marked[t[0]] + marked[t[1]] + marked[t[2]]) * size;
    }
    return area > 0 ? marked_area / area : 0;
}

/// Colours spread along the surface from where they are known, a ring of vertices at a time.
void spread_colours(Mesh& mesh, std::vector<std::uint8_t>& known) {
    std::vector<std::array<std::uint32_t, 2>> links; // unknown vertex, one of its neighbours
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            if (!known[t[k]]) links.push_back({t[k], t[(k + 1) % 3]});
    std::sort(links.begin(), links.end());
    std::vector<std::uint32_t> reached;
    do {
        reached.clear();
        for (std::size_t i = 0; i < links.size();) {
            const std::uint32_t v = links[i][0];
            glm::vec3 sum(0);
            int count = 0;
            for (; i < links.size() && links[i][0] == v; ++i)
                if (known[links[i][1]]) {
                    sum += mesh.colours[links[i][1]];
                    ++count;
                }
            if (!count) continue;
            mesh.colours[v] = sum / float(count);
            reached.push_back(v);
        }
        for (std::uint32_t v : reached) known[v] = 1;
        std::erase_if(links, [&](auto& link) { return known[link[0]]; });
    } while (!reached.empty());
}

/// What one sees who looks in where a vertex closes an opening.
Attribute behind_closing(const Rays& rays, const glm::dvec3& at, const glm::vec3& surface_normal) {
    const HitBehind there =
        hit_behind_closing(rays, at, surface_normal, main_axis(surface_normal), reach_of_closing);
    if (!there) return {};
    const AxisHits& hits = rays.axis[there.axis];
    const int side = surface_normal[there.axis] > 0;
    return {unpack_colour(hits.colour_to(side, there.hit)), drawn_normal(hits, side, there.hit),
            surface_normal, true};
}

std::array<std::uint32_t, 4> square_corners(const Triangle& s, const Triangle& t) {
    const auto fourth =
        std::find_if(t.begin(), t.end(), [&](auto v) { return std::find(s.begin(), s.end(), v) == s.end(); });
    return {s[0], s[1], s[2], *fourth};
}

struct Square {
    int axis, side;
    std::array<int, 3> sample;
};

/// Which face of which sub-cube square q is, from its corners.
Square square_at(const Mesh& mesh, std::size_t q) {
    const Triangle& t = mesh.triangles[2 * q];
    const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const auto corners = square_corners(t, mesh.triangles[2 * q + 1]);
    glm::dvec3 middle(0);
    for (std::uint32_t v : corners) middle += 0.25 * mesh.positions[v];
    const glm::dvec3 out = glm::cross(b - a, c - a);
    Square square{};
    for (int k = 0; k < 3; ++k)
        if (std::abs(out[k]) > 0.5) square.axis = k;
    square.side = out[square.axis] > 0;
    for (int k = 0; k < 3; ++k)
        square.sample[k] = int(std::lround(middle[k] - (k == square.axis ? (square.side ? 0.5 : -0.5) : 0)));
    return square;
}

std::uint32_t hit_near(const AxisHits& hits, std::size_t pixel, float depth, int side) {
    std::uint32_t best = no_hit;
    float nearest = square_agreement;
    for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i) {
        const float away = std::abs(hits.depth[i] - depth);
        if (away < nearest || (side == 1 && away == nearest)) {
            best = i;
            nearest = away;
        }
    }
    return best;
}

} // namespace

Attribute sample_point(const Rays& rays, const glm::dvec3& at, const glm::vec3& surface_normal) {
    int order[3] = {0, 1, 2};
    std::sort(order, order + 3, [&](int a, int b) {
        const float fa = std::abs(surface_normal[a]), fb = std::abs(surface_normal[b]);
        return fa != fb ? fa > fb : a < b;
    });
    for (int axis : order) {
        const int side = surface_normal[axis] > 0 ? 1 : 0;
        const Attribute found = axis == 0   ? Opinion<0>(rays, side, at).mix()
                                : axis == 1 ? Opinion<1>(rays, side, at).mix()
                                            : Opinion<2>(rays, side, at).mix();
        if (found.found) return found;
    }
    return {};
}

Sampled sample_vertices(const Rays& rays, Mesh& mesh, bool geometric_normals) {
    mesh.normals = surface_normals(mesh);
    mesh.colours.assign(mesh.positions.size(), glm::vec3(0.5f));
    std::vector<std::uint8_t> known(mesh.positions.size()), disagree(mesh.positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, known.size(), 2048), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            Attribute found = sample_point(rays, mesh.positions[v], mesh.normals[v]);
            const bool seen = found.found;
            if (!seen) found = behind_closing(rays, mesh.positions[v], mesh.normals[v]);
            if (!found.found) continue;
            known[v] = seen ? 1 : 2;
            disagree[v] =
                seen && found.normal != glm::vec3(0) && glm::dot(found.normal, found.plane) < disagreement;
            mesh.colours[v] = found.colour;
            if (!geometric_normals && found.normal != glm::vec3(0)) mesh.normals[v] = found.normal;
        }
    });
    const std::size_t missing = known.size() - std::size_t(std::count(known.begin(), known.end(), 1));
    if (missing) spread_colours(mesh, known);
    return {missing, share_of_area(mesh, disagree)};
}

Sampled sample_squares(const Rays& rays, Mesh& mesh, bool geometric_normals) {
    const std::size_t vertices = mesh.positions.size();
    std::vector<glm::vec3> drawn(vertices, glm::vec3(0));
    std::vector<std::uint8_t> squares(vertices);
    mesh.colours.assign(vertices, glm::vec3(0));
    for (std::size_t q = 0; 2 * q < mesh.triangles.size(); ++q) {
        const Square square = square_at(mesh, q);
        const AxisHits& hits = rays.axis[square.axis];
        const float face = float(square.sample[square.axis]) + (square.side ? 0.5f : -0.5f);
        const std::uint32_t hit = hit_near(hits, rays.pixel(square.axis, square.sample), face, square.side);
        if (hit == no_hit) continue;
        const Triangle &s = mesh.triangles[2 * q], &t = mesh.triangles[2 * q + 1];
        for (std::uint32_t v : square_corners(s, t)) {
            mesh.colours[v] += unpack_colour(hits.colour_to(square.side, hit));
            drawn[v] += drawn_normal(hits, square.side, hit);
            ++squares[v];
        }
    }
    mesh.normals = surface_normals(mesh);
    std::vector<std::uint8_t> known(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        known[v] = squares[v] > 0;
        mesh.colours[v] = squares[v] ? mesh.colours[v] / float(squares[v]) : glm::vec3(0.5f);
        const glm::vec3 normal = unit_or_zero(drawn[v]);
        if (!geometric_normals && normal != glm::vec3(0)) mesh.normals[v] = normal;
    }
    const std::size_t missing = std::count(known.begin(), known.end(), 0);
    if (missing) spread_colours(mesh, known);
    return {missing, 0}; // squares lie along the axes whatever was drawn
}

} // namespace glcast
