// The three corners of a triangle, in space. Internal.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/mesh/mesh.h"
#include "tools/mesh/point_triangle.h"

namespace glcast {

inline double cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0 ? glm::dot(a, b) / lengths : 0;
}

inline glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

struct Corners {
    glm::dvec3 a, b, c;

    Corners(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) : a(a), b(b), c(c) {}
    Corners(const Mesh& mesh, const Triangle& t)
        : Corners(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]) {}
    glm::dvec3 at(const glm::dvec3& weights) const { return weights.x * a + weights.y * b + weights.z * c; }
    glm::dvec3 normal() const { return glm::cross(b - a, c - a); } ///< as long as twice the area
    /// 1 is equilateral, 0 degenerate.
    double quality() const {
        const double squares = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
        return squares > 0 ? 2 * std::sqrt(3.0) * glm::length(normal()) / squares : 0;
    }
    double squared_distance(const glm::dvec3& point) const {
        const glm::dvec3 off = nearest_in_triangle(point, a, b, c).point - point;
        return glm::dot(off, off);
    }
};

/// A triangle and its sides: how far a point is beyond one it is no nearer to the triangle.
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

} // namespace glcast
