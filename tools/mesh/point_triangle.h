// The nearest point of a triangle (Ericson 2005, Real-Time Collision Detection, 5.1.5).
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace glcast {

struct TrianglePoint {
    glm::dvec3 weights; ///< barycentric, sum 1, none negative
    glm::dvec3 point;
};

inline TrianglePoint nearest_in_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                         const glm::dvec3& c) {
    const auto on_edge = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return {{1, 0, 0}, a};
    if (d3 >= 0 && d4 <= d3) return {{0, 1, 0}, b};
    if (d6 >= 0 && d5 <= d6) return {{0, 0, 1}, c};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double t = on_edge(d1, d1 - d3);
        return {{1 - t, t, 0}, a + t * ab};
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double t = on_edge(d2, d2 - d6);
        return {{1 - t, 0, t}, a + t * ac};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const double t = on_edge(d4 - d3, (d4 - d3) + (d5 - d6));
        return {{0, 1 - t, t}, b + t * (c - b)};
    }
    const double sum = va + vb + vc;
    return {{va / sum, vb / sum, vc / sum}, a + (vb / sum) * ab + (vc / sum) * ac};
}

} // namespace glcast
