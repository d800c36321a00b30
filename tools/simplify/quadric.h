// Sums of squared distances from planes, and from linear functions that say what colour or normal belongs
// where. Internal. Garland and Heckbert 1997, "Surface simplification using quadric error metrics"; with
// attributes: Hoppe 1999, "New quadric metric for simplifying meshes with appearance attributes", in the form
// that drops the attributes of the new vertex: for a place given, the best ones are a weighted mean, so they
// need not be kept. His section 5 has the memoryless quadrics that patch.h makes of the planes, after
// Lindstrom and Turk 1998, "Fast and memory efficient polygonal simplification".
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace glcast {

/// p' A p + 2 b' p + c.
struct PlaneQuadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0, c = 0;

    double trace() const { return xx + yy + zz; }
    double at(const glm::dvec3& p) const {
        return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) + p.y * (yy * p.y + 2 * (yz * p.z + y)) +
               p.z * (zz * p.z + 2 * z) + c;
    }
    /// Minus half the gradient.
    glm::dvec3 pull(const glm::dvec3& p) const {
        return {-(xx * p.x + xy * p.y + xz * p.z + x), -(xy * p.x + yy * p.y + yz * p.z + y),
                -(xz * p.x + yz * p.y + zz * p.z + z)};
    }
    /// `weight` times the square of g'p + d.
    void add(const glm::dvec3& g, double d, double weight) {
        const glm::dvec3 w = g * weight;
        xx += w.x * g.x, xy += w.x * g.y, xz += w.x * g.z, yy += w.y * g.y, yz += w.y * g.z, zz += w.z * g.z;
        x += w.x * d, y += w.y * d, z += w.z * d, c += weight * d * d;
    }
    /// `share` times the area of the triangle times the squared distance from its plane; none without area.
    void add_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double share) {
        const glm::dvec3 doubled_area = cross(b - a, c - a);
        const double squared = dot(doubled_area, doubled_area);
        if (squared > 0) add(doubled_area, -dot(doubled_area, a), share / 2 / std::sqrt(squared));
    }
    void operator+=(const PlaneQuadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        x += q.x, y += q.y, z += q.z, c += q.c;
    }
};

/// With N attributes (0, 3 or 6), each of them scaled to a length already.
template <int N> struct Quadric {
    struct Sum {
        glm::dvec3 g{0}; ///< of the weighted gradients
        double d = 0;    ///< of the weighted values at the origin
    };
    PlaneQuadric plane; ///< the squares of the attributes' linear functions are in it too
    std::array<Sum, std::size_t(N)> sums{};
    double weight = 0;

    void add_attribute(int i, const glm::dvec3& g, double d, double w) {
        plane.add(g, d, w);
        sums[std::size_t(i)].g += g * w;
        sums[std::size_t(i)].d += d * w;
    }
    void operator+=(const Quadric& q) {
        plane += q.plane;
        for (std::size_t i = 0; i < std::size_t(N); ++i) {
            sums[i].g += q.sums[i].g;
            sums[i].d += q.sums[i].d;
        }
        weight += q.weight;
    }
    /// What is left when every attribute takes its best value: a quadric of the place alone.
    PlaneQuadric reduced() const {
        PlaneQuadric q = plane;
        if (N == 0 || !(weight > 0)) return q;
        for (const Sum& s : sums) q.add(s.g, s.d, -1 / weight);
        return q;
    }
};

template <> struct Quadric<0> {
    PlaneQuadric plane;
    double weight = 0;
    void add_attribute(int, const glm::dvec3&, double, double) {}
    void operator+=(const Quadric& q) { plane += q.plane; }
    PlaneQuadric reduced() const { return plane; }
};

struct Placement {
    glm::dvec3 point;
    double cost;
};

// Where a quadric does not care (along a plane or a crease), the new vertex stays at the middle of the edge.
// Relative to the quadric's trace: far above the rounding of doubles, far below any bend worth keeping.
constexpr double stay_near_middle = 1e-6;
// In flat places all collapses cost nothing; short edges first makes the better triangles. Relative as above;
// at a lattice of 256 it outweighs noise of 1e-4 samples and is outweighed by any curvature.
constexpr double prefer_short_edges = 1e-7;

/// Where the quadric, held near the middle, is least. The second step is held near the first one's end: it
/// takes away what the hold did to the directions in which the quadric does care, so that corners stay exact.
inline glm::dvec3 least(const PlaneQuadric& q, const glm::dvec3& middle) {
    const double hold = stay_near_middle * q.trace();
    const double xx = q.xx + hold, yy = q.yy + hold, zz = q.zz + hold;
    const double c00 = yy * zz - q.yz * q.yz, c01 = q.xz * q.yz - q.xy * zz, c02 = q.xy * q.yz - q.xz * yy,
                 c11 = xx * zz - q.xz * q.xz, c12 = q.xy * q.xz - xx * q.yz, c22 = xx * yy - q.xy * q.xy;
    const double determinant = xx * c00 + q.xy * c01 + q.xz * c02;
    if (!(determinant > 0)) return middle;
    const double share = 1 / determinant;
    glm::dvec3 p = middle;
    for (int step = 0; step < 2; ++step) {
        const glm::dvec3 b = q.pull(p);
        p += glm::dvec3(c00 * b.x + c01 * b.y + c02 * b.z, c01 * b.x + c11 * b.y + c12 * b.z,
                        c02 * b.x + c12 * b.y + c22 * b.z) *
             share;
    }
    return p;
}

/// The best place for a vertex that replaces those at p0 and p1.
inline Placement place(const PlaneQuadric& q, const glm::dvec3& p0, const glm::dvec3& p1) {
    const glm::dvec3 middle = (p0 + p1) * 0.5, along = p1 - p0;
    const double squared_length = dot(along, along);
    const glm::dvec3 point = least(q, middle);
    Placement best{point, q.at(point)};
    if (dot(point - middle, point - middle) > 4 * squared_length) { // far off: two planes almost parallel
        best = {middle, q.at(middle)};
        for (const glm::dvec3& p : {p0, p1})
            if (const double at = q.at(p); at < best.cost) best = {p, at};
    }
    best.cost = std::max(best.cost, 0.0) + prefer_short_edges * q.trace() * squared_length;
    return best;
}

} // namespace glcast
