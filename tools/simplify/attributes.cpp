#include "tools/simplify/attributes.h"

#include <tbb/parallel_for.h>

#include <limits>

#include "tools/mesh/point_triangle.h"
#include "tools/simplify/corners.h"

namespace glcast {
namespace {

double squared(const glm::dvec3& v) { return dot(v, v); }

int heaviest(const glm::dvec3& w) { return w.x >= w.y ? (w.x >= w.z ? 0 : 2) : (w.y >= w.z ? 1 : 2); }

} // namespace

SurfaceWalk::SurfaceWalk(const Mesh& surface) : mesh(surface), first(surface.positions.size() + 1, 0) {
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) ++first[v + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    incident.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t v : mesh.triangles[t]) incident[next[v]++] = t;
}

SurfaceWalk::Place SurfaceWalk::nearest(const glm::dvec3& point, std::uint32_t start) const {
    std::uint32_t at = start;
    double best = squared(mesh.positions[at] - point);
    for (bool nearer = true; nearer;) {
        nearer = false;
        const std::uint32_t here = at;
        for (std::uint32_t i = first[here]; i < first[here + 1]; ++i)
            for (const std::uint32_t v : mesh.triangles[incident[i]])
                if (const double d = squared(mesh.positions[v] - point); d < best) {
                    best = d;
                    at = v;
                    nearer = true;
                }
    }
    Place place;
    best = improve(point, at, std::numeric_limits<double>::infinity(), place);
    for (bool nearer = true; nearer;) { // the nearest triangle need not be at the nearest vertex
        const double before = best;
        for (const std::uint32_t v : Triangle(mesh.triangles[place.triangle]))
            best = improve(point, v, best, place);
        nearer = best < before;
    }
    return place;
}

glm::dvec3 SurfaceWalk::nearest_point(const glm::dvec3& point, std::uint32_t start) const {
    const Place place = nearest(point, start);
    return Corners(mesh, mesh.triangles[place.triangle]).at(place.weights);
}

/// The triangles at a vertex: is one of them nearer than `best` (squared)?
double SurfaceWalk::improve(const glm::dvec3& point, std::uint32_t vertex, double best, Place& place) const {
    for (const std::uint32_t triangle : around(vertex)) {
        const Triangle& t = mesh.triangles[triangle];
        const TrianglePoint found =
            nearest_in_triangle(point, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        if (const double d = squared(found.point - point); d < best) {
            best = d;
            place = {triangle, found.weights};
        }
    }
    return best;
}

void SurfaceWalk::take_attributes(Mesh& into, const std::vector<std::uint32_t>& starts,
                                  const std::vector<glm::vec3>& normals) const {
    if (!mesh.colours.empty()) into.colours.resize(into.positions.size());
    if (!normals.empty()) into.normals.resize(into.positions.size());
    tbb::parallel_for(std::size_t(0), into.positions.size(), [&](std::size_t i) {
        if (into.positions[i] == mesh.positions[starts[i]]) { // it did not move: as it was, to the bit
            if (!mesh.colours.empty()) into.colours[i] = mesh.colours[starts[i]];
            if (!normals.empty()) into.normals[i] = normals[starts[i]];
            return;
        }
        const Place place = nearest(into.positions[i], starts[i]);
        const Triangle& t = mesh.triangles[place.triangle];
        const std::uint32_t main = t[std::size_t(heaviest(place.weights))];
        if (!mesh.colours.empty()) into.colours[i] = mesh.colours[main];
        if (normals.empty()) return;
        glm::dvec3 normal(0);
        for (int k = 0; k < 3; ++k) normal += place.weights[k] * glm::dvec3(normals[t[std::size_t(k)]]);
        const double length = glm::length(normal);
        into.normals[i] = length > 0.1 ? glm::vec3(normal / length) : normals[main];
    });
}

} // namespace glcast
