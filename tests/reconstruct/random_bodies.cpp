#include "tests/reconstruct/random_bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace glcast::test {
namespace {

using glm::dvec3;

class Frustum : public Body {
  public:
    Frustum(dvec3 from, dvec3 to, double r0, double r1, glm::vec3 colour)
        : from(from), axis(glm::normalize(to - from)), height(glm::length(to - from)), r0(r0),
          slope((r1 - r0) / height), colour(colour) {}

    /// Convex: what the two planes leave of what the cone leaves.
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        const dvec3 o = p - from;
        const double h = glm::dot(o, axis), g = glm::dot(d, axis);
        Stretch s{-1e300, 1e300, {}, {}, colour, colour};
        if (std::abs(g) < 1e-12) {
            if (h < 0 || h > height) return {};
        } else {
            s.t0 = (g > 0 ? -h : height - h) / g, s.n0 = g > 0 ? -axis : axis;
            s.t1 = (g > 0 ? height - h : -h) / g, s.n1 = g > 0 ? axis : -axis;
        }
        // |flat|^2 <= (r0 + slope h)^2 along the ray: a t^2 + 2 b t + c <= 0
        const dvec3 flat = o - axis * h, along = d - axis * g;
        const double r = r0 + slope * h, dr = slope * g;
        const double a = glm::dot(along, along) - dr * dr, b = glm::dot(flat, along) - r * dr,
                     c = glm::dot(flat, flat) - r * r;
        const double q = b * b - a * c;
        if (std::abs(a) < 1e-12) return c <= 0 && std::abs(b) < 1e-9 ? checked(s) : std::vector<Stretch>{};
        if (a > 0) {
            if (q <= 0) return {};
            narrow(s, p, d, (-b - std::sqrt(q)) / a, (-b + std::sqrt(q)) / a);
        } else if (q > 0) { // outside between the roots; between the planes only one of the parts counts
            const double t0 = (-b + std::sqrt(q)) / a, t1 = (-b - std::sqrt(q)) / a;
            const bool first = r + dr * std::min(t0, s.t1) >= 0 && s.t0 < t0;
            narrow(s, p, d, first ? -1e300 : t1, first ? t0 : 1e300);
        }
        return checked(s);
    }
    /// Not used by tests of the fuzz; exact inside a cylinder only.
    double distance(const dvec3& p) const override {
        const dvec3 o = p - from;
        const double h = glm::dot(o, axis), out = glm::length(o - axis * h);
        return std::max({-h, h - height, (out - r0 - slope * h) / std::hypot(1, slope)});
    }

  private:
    dvec3 normal(const dvec3& at) const {
        const dvec3 o = at - from, flat = o - axis * glm::dot(o, axis);
        const double length = glm::length(flat);
        return length > 1e-12 ? glm::normalize(flat / length - axis * slope) : axis;
    }
    void narrow(Stretch& s, const dvec3& p, const dvec3& d, double t0, double t1) const {
        if (t0 > s.t0) s.t0 = t0, s.n0 = normal(p + d * t0);
        if (t1 < s.t1) s.t1 = t1, s.n1 = normal(p + d * t1);
    }
    static std::vector<Stretch> checked(const Stretch& s) {
        return s.t0 < s.t1 && s.t0 > -1e299 && s.t1 < 1e299 ? std::vector{s} : std::vector<Stretch>{};
    }
    dvec3 from, axis;
    double height, r0, slope;
    glm::vec3 colour;
};

glm::dmat3 any_turn(Dice& dice) {
    const double degrees = dice.up_to(4) == 0 ? 45.0 * dice.up_to(2) : dice.between(0, 90);
    return turned(dice.point(1) + dvec3(0, 0, 1.5), degrees);
}

BodyPtr random_part(Dice& dice) {
    const glm::vec3 colour(dice.point(1));
    const auto size = [&] { return dice.between(0.02, 0.5); };
    switch (dice.up_to(7)) {
    case 0:
    case 1:
        return sphere(dice.point(0.5), size(), colour);
    case 2:
        return torus(dice.point(0.4), dice.point(1), dice.between(0.1, 0.5), dice.between(0.02, 0.1), colour);
    case 3: // a sheet without thickness
        return box(dice.point(0.5), {size(), size(), 1e-9}, any_turn(dice), colour);
    case 4: // a thin wall
        return box(dice.point(0.5), {size(), size(), dice.between(0.002, 0.06)}, any_turn(dice), colour);
    case 5: { // a cylinder, sometimes a wire
        const double radius = dice.up_to(2) ? dice.between(0.05, 0.4) : dice.between(0.01, 0.05);
        return frustum(dice.point(0.6), dice.point(0.6), radius, radius, colour);
    }
    case 6:
        return frustum(dice.point(0.6), dice.point(0.6), dice.between(0, 0.1), dice.between(0.1, 0.5),
                       colour);
    default:
        return box(dice.point(0.5), {size(), size(), size()}, any_turn(dice), colour);
    }
}

/// A tube or a shell: two walls close to one another.
BodyPtr hollow(Dice& dice) {
    const dvec3 from = dice.point(0.5), to = dice.point(0.5);
    const double radius = dice.between(0.1, 0.4), wall = dice.between(0.005, 0.08);
    if (dice.up_to(1)) return subtract(sphere(from, radius), sphere(from + dice.point(0.05), radius - wall));
    return subtract(frustum(from, to, radius, radius),
                    frustum(from + (from - to) * 0.1, to + (to - from) * 0.1, radius - wall, radius - wall));
}

} // namespace

BodyPtr frustum(dvec3 from, dvec3 to, double radius_from, double radius_to, glm::vec3 colour) {
    return std::make_shared<Frustum>(from, to, radius_from, radius_to, colour);
}

BodyPtr random_body(Dice& dice) {
    std::vector<BodyPtr> parts;
    for (int k = dice.up_to(5) + 1; k > 0; --k)
        parts.push_back(dice.up_to(4) == 0 ? hollow(dice) : random_part(dice));
    BodyPtr body = unite(parts);
    for (int k = dice.up_to(2); k > 0; --k) body = subtract(body, random_part(dice));
    return body;
}

} // namespace glcast::test
