#include "tools/simplify/surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace glcast {
namespace {

// Of a boundary's planes against those of the triangles beside it.
constexpr double boundary_weight = 1;
// An attribute holds its triangle no harder than so many times as hard as the triangle's own plane does:
// where two colours meet, a triangle's gradient would else grow with the resolution.
constexpr double steepest = 1;

/// Half-edges without another one the other way, as triangles to the ghost; `beside`: the third corners of
/// their triangles.
std::vector<Triangle> ghost_triangles(const Mesh& mesh, std::vector<std::uint32_t>& beside) {
    const std::uint32_t ghost = std::uint32_t(mesh.positions.size());
    std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) ++first[v + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::uint32_t> heads(first.back()), end(first.begin(), first.end() - 1);
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) heads[end[t[k]]++] = t[(k + 1) % 3];
    std::vector<Triangle> ghosts;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            const auto begin = heads.begin() + first[to], stop = heads.begin() + first[to + 1];
            if (std::find(begin, stop, from) != stop) continue;
            ghosts.push_back({to, from, ghost});
            beside.push_back(t[(k + 2) % 3]);
        }
    return ghosts;
}

/// Triangles with the vertices that theirs became, but for those that have gone.
std::vector<Triangle> led(const Shape& from, const std::vector<std::uint32_t>& became, std::uint32_t ghost) {
    constexpr std::size_t per_block = 1 << 16;
    std::vector<std::vector<Triangle>> blocks((from.triangles.size() + per_block - 1) / per_block);
    tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * per_block, from.triangles.size());
        for (std::size_t t = block * per_block; t < end; ++t) {
            Triangle now = from.triangles[t];
            for (std::uint32_t& v : now) v = v == from.ghost() ? ghost : became[v];
            if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0]) blocks[block].push_back(now);
        }
    });
    std::size_t count = 0;
    for (const auto& block : blocks) count += block.size();
    std::vector<Triangle> all;
    all.reserve(count);
    for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
    return all;
}

} // namespace

UnitCube::UnitCube(const Mesh& mesh) {
    glm::dvec3 low(mesh.positions.at(0)), high(low);
    for (const glm::dvec3& p : mesh.positions) low = min(low, p), high = max(high, p);
    centre = (low + high) * 0.5;
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    scale = extent > 0 ? 1 / extent : 1;
}

Shape shape_of(const Mesh& mesh, const UnitCube& cube, bool has_boundaries) {
    Shape surface;
    const std::size_t vertices = mesh.positions.size();
    surface.position.resize(vertices);
    surface.id.resize(vertices);
    tbb::parallel_for(std::size_t(0), vertices, [&](std::size_t v) {
        surface.position[v] = cube.inside(mesh.positions[v]);
        surface.id[v] = std::uint32_t(v);
    });
    surface.source = surface.id;
    surface.moved.assign(vertices, 0);
    surface.triangles = mesh.triangles;
    if (!has_boundaries) return surface;
    const std::vector<Triangle> ghosts = ghost_triangles(mesh, surface.beside);
    surface.triangles.insert(surface.triangles.end(), ghosts.begin(), ghosts.end());
    return surface;
}

template <int N> Quadric<N> TriangleQuadrics<N>::of(const Triangle& t) const {
    Quadric<N> q;
    const glm::dvec3 &a = surface.position[t[0]], &b = surface.position[t[1]], &c = surface.position[t[2]];
    const glm::dvec3 doubled_area = cross(b - a, c - a);
    const double length = glm::length(doubled_area);
    if (length <= 0) return q;
    q.weight = length / 2;
    q.plane.add_triangle(a, b, c, 1);
    if (N > 0) add_attributes(q, t, doubled_area);
    return q;
}

/// A plane through the edge of a boundary, square to its triangle (Garland and Heckbert 1997, section 6).
template <int N> Quadric<N> TriangleQuadrics<N>::of_boundary(std::size_t t) const {
    Quadric<N> q;
    const Triangle& ghost = surface.triangles[t];
    const glm::dvec3 a = surface.position[ghost[0]], along = surface.position[ghost[1]] - a;
    const glm::dvec3 third = surface.position[surface.beside[t - own]];
    const glm::dvec3 outwards = cross(along, cross(along, third - a));
    const double length = glm::length(outwards);
    if (length <= 0) return q;
    const glm::dvec3 normal = outwards / length;
    q.plane.add(normal, -dot(normal, a), boundary_weight * dot(along, along));
    return q;
}

/// Each attribute as a linear function over the triangle, constant across it.
template <int N>
void TriangleQuadrics<N>::add_attributes(Quadric<N>& q, const Triangle& t,
                                         const glm::dvec3& doubled_area) const {
    const glm::dvec3 &a = surface.position[t[0]], &b = surface.position[t[1]], &c = surface.position[t[2]];
    const double squares = dot(doubled_area, doubled_area);
    const glm::dvec3 by_b = cross(c - a, doubled_area) / squares, by_c = cross(doubled_area, b - a) / squares;
    const glm::dvec3 middle = (a + b + c) / 3.0;
    const std::vector<std::uint32_t>& source = surface.source;
    const auto add = [&](int first, const glm::dvec3& of_a, const glm::dvec3& of_b, const glm::dvec3& of_c) {
        for (int k = 0; k < 3; ++k) {
            const double at_a = of_a[k], at_b = of_b[k], at_c = of_c[k];
            glm::dvec3 g = by_b * (at_b - at_a) + by_c * (at_c - at_a);
            if (const double slope = glm::length(g); slope > steepest) g *= steepest / slope;
            q.add_attribute(first + k, g, (at_a + at_b + at_c) / 3 - dot(g, middle), q.weight);
        }
    };
    const auto colour = [&](int corner) {
        return weights.colour * glm::dvec3(mesh.colours[source[t[corner]]]);
    };
    const auto outward = [&](int corner) { // where a closing shows a wall that faces inward, its shape counts
        const glm::dvec3 normal = weights.normal * glm::dvec3(mesh.normals[source[t[corner]]]);
        return dot(normal, doubled_area) < 0 ? -normal : normal;
    };
    int first = 0;
    if (weights.colour > 0) add(first, colour(0), colour(1), colour(2)), first += 3;
    if (weights.normal > 0) add(first, outward(0), outward(1), outward(2));
}

Shape after_steps(const Shape& from, std::span<const Step> steps, std::vector<std::uint32_t>& became) {
    const std::uint32_t vertices = from.ghost();
    std::vector<std::uint32_t> into(vertices), last(vertices, none); // the last step that moved each vertex
    for (std::uint32_t v = 0; v < vertices; ++v) into[v] = v;
    for (std::uint32_t k = std::uint32_t(steps.size()); k-- > 0;) { // what `kept` became is known then
        into[steps[k].removed] = into[steps[k].kept];
        if (last[steps[k].kept] == none) last[steps[k].kept] = k;
    }
    Shape surface;
    const std::size_t left = vertices - steps.size();
    surface.position.reserve(left), surface.id.reserve(left), surface.source.reserve(left),
        surface.moved.reserve(left);
    became.assign(vertices, none);
    for (std::uint32_t v = 0; v < vertices; ++v) {
        if (into[v] != v) continue;
        became[v] = surface.ghost();
        surface.id.push_back(from.id[v]);
        const bool moved = last[v] != none;
        surface.position.push_back(moved ? steps[last[v]].point : from.position[v]);
        surface.source.push_back(moved ? steps[last[v]].source : from.source[v]);
        surface.moved.push_back(char(moved || from.moved[v]));
    }
    tbb::parallel_for(std::uint32_t(0), vertices, [&](std::uint32_t v) {
        if (into[v] != v) became[v] = became[into[v]];
    });
    surface.triangles = led(from, became, surface.ghost());
    return surface;
}

template class TriangleQuadrics<0>;
template class TriangleQuadrics<3>;
template class TriangleQuadrics<6>;

} // namespace glcast
