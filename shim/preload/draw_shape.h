// What a draw looks like in the capture frame. Knows no GL.
#pragma once
#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "shim/preload/scene.h"

namespace glcast::preload {

struct Bounds {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
    void add(const Bounds& other) { lo = glm::min(lo, other.lo), hi = glm::max(hi, other.hi); }
    bool is_empty() const { return !(lo.x <= hi.x); }
    double width() const { return is_empty() ? 0 : std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}); }
    glm::dvec3 middle() const { return (lo + hi) / 2.0; }
};

using ShapePolygon = std::vector<glm::dvec3>;

/// One draw. Capture frame.
struct DrawShape {
    std::vector<ShapePolygon> polygons;
    bool textured = false, lit = false, pinned = false;
    Draw::Shown shown = Draw::Shown::both;
};

Bounds bounds_of(const DrawShape& shape);

/// Draws that follow one another and share two corners, to 1/512 of the width of all; `may_join(a, b)`: two
/// draws in one piece. Those without polygons, and those that are not `wanted`, are in none.
std::vector<std::vector<std::size_t>>
connected_draws(const std::vector<DrawShape>& shapes, const std::function<bool(const DrawShape&)>& wanted,
                const std::function<bool(const DrawShape&, const DrawShape&)>& may_join);

} // namespace glcast::preload
