// The centres of a square grid that a triangle of the plane covers.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>

#include "tools/mesh/whole.h"

namespace glcast {

/// Calls visit(x, y) for the whole-numbered points inside the triangle, whichever way it turns: strictly
/// inside, farther from its sides than `inset` (negative: outside too); while it returns true.
template <class Visit> void for_cells(const std::array<glm::dvec2, 3>& corners, double inset, Visit visit) {
    const glm::dvec2 &a = corners[0], &b = corners[1], &c = corners[2];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    const double turn = area > 0 ? 1 : -1;
    struct Side {
        double x, y, rest; // x * px + y * py + rest > 0 inside
    } sides[3];
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 &p = corners[k], &q = corners[(k + 1) % 3];
        sides[k].x = -turn * (q.y - p.y);
        sides[k].y = turn * (q.x - p.x);
        sides[k].rest =
            -(sides[k].x * p.x + sides[k].y * p.y) -
            inset * (std::abs(sides[k].x) + std::abs(sides[k].y)); // its length, or up to 1.41 times
    }
    const int x0 = whole_above(std::min({a.x, b.x, c.x}) - 1e-6),
              x1 = whole_below(std::max({a.x, b.x, c.x}) + 1e-6);
    const int y0 = whole_above(std::min({a.y, b.y, c.y}) - 1e-6),
              y1 = whole_below(std::max({a.y, b.y, c.y}) + 1e-6);
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            bool inside = true;
            for (const Side& s : sides) inside &= s.x * x + s.y * y + s.rest > 0;
            if (inside && !visit(x, y)) return;
        }
}

} // namespace glcast
