#include "tools/deviation/area_samples.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace glcast {
namespace {

/// Of what is not negative: std::fmod(x, 1), which takes far longer.
double fraction(double x) { return x - std::floor(x); }

/// As long as twice the triangle's area.
glm::dvec3 area_normal(const Mesh& mesh, const Triangle& t) {
    const glm::dvec3& a = mesh.positions[t[0]];
    return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
}

} // namespace

std::vector<AreaSample> area_samples(const Mesh& mesh, std::size_t samples) {
    std::vector<double> sizes(mesh.triangles.size()); // the sums stay in one order
    tbb::parallel_for(std::size_t(0), sizes.size(),
                      [&](std::size_t i) { sizes[i] = glm::length(area_normal(mesh, mesh.triangles[i])); });
    double total = 0;
    for (const double size : sizes) total += size;
    std::vector<AreaSample> points;
    if (!(total > 0)) return points;
    points.reserve(samples);
    double passed = 0; // area of the triangles before this one
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const double size = sizes[i];
        passed += size;
        // Sample k stands at (k+½)/samples of the area; within the triangle by Roberts's R2 sequence, folded.
        while (points.size() < samples && (double(points.size()) + 0.5) * total < passed * double(samples)) {
            const double k = double(points.size() + 1);
            double u = fraction(0.5 + k * 0.7548776662466927), v = fraction(0.5 + k * 0.5698402909980532);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const Triangle& t = mesh.triangles[i];
            const glm::dvec3 normal = area_normal(mesh, t);
            const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
            points.push_back({a + u * (b - a) + v * (c - a),
                              size > 0 ? normal / size : glm::dvec3(0),
                              i,
                              {1 - u - v, u, v}});
        }
    }
    return points;
}

} // namespace glcast
