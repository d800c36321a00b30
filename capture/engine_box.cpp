#include "capture/engine_box.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace glcast {

namespace {

constexpr double margin_samples = 2;
constexpr double growth = 4;
constexpr int max_growths = 10, max_empty_growths = 4, max_rounds = 24;

struct Bounds {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
    bool touches = false; ///< something may be cut by the side of the box that was looked into

    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    void include(int axis, double from, double to) {
        lo[axis] = std::min(lo[axis], from);
        hi[axis] = std::max(hi[axis], to);
    }
    void include(const Bounds& other) { lo = glm::min(lo, other.lo), hi = glm::max(hi, other.hi); }
    double extent() const { return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}); }
    Box cube(double size) const { return {0.5 * (lo + hi) - 0.5 * size, size}; }
};

struct Extent {
    int u0 = std::numeric_limits<int>::max(), u1 = -1, v0 = u0, v1 = -1; ///< covered pixels
    float near = 1, far = 0;                                             ///< depths of covered pixels
};

Extent extent_of(const std::vector<float>& depth, int m, Side side) {
    Extent e;
    const float background = ViewImage::background(side);
    for (int v = 0; v < m; ++v) {
        for (int u = 0; u < m; ++u) {
            const float d = depth[std::size_t(v) * m + u];
            if (d == background) continue;
            e.u0 = std::min(e.u0, u), e.u1 = std::max(e.u1, u);
            e.v0 = std::min(e.v0, v), e.v1 = std::max(e.v1, v);
            e.near = std::min(e.near, d), e.far = std::max(e.far, d);
        }
    }
    return e;
}

/// Depths are exact; across the image only what lies surely inside counts, from pixel edge to pixel edge.
void include(Bounds& bounds, const Extent& e, const Box& box, Axis axis, int m) {
    if (e.u1 < 0) return;
    const ImageAxes axes = image_axes(axis);
    const double pixel = box.size / m;
    bounds.include(axes.depth, box.lo[axes.depth] + e.near * box.size, box.lo[axes.depth] + e.far * box.size);
    const auto across = [&](int along, int first, int last) {
        if (first < last)
            bounds.include(along, box.lo[along] + (first + 1) * pixel, box.lo[along] + last * pixel);
    };
    across(axes.u, e.u0, e.u1);
    across(axes.v, e.v0, e.v1);
    const float edge = 1.0f / m;
    bounds.touches |=
        e.u0 == 0 || e.v0 == 0 || e.u1 == m - 1 || e.v1 == m - 1 || e.near < edge || e.far > 1 - edge;
}

/// What was left out lies inside of what is seen of the rest, from both sides: all of it reaches no farther.
/// The least depth is seen from the minus side, the greatest, of corners, from the plus side; nothing that is
/// filled is deeper.
bool encloses(const Outline& outline, const Extent& minus, const Extent& plus, const Box& box, Axis axis,
              int m) {
    if (!outline.has_left_out()) return true;
    if (minus.u1 < 0 || plus.u1 < 0 || minus.far > plus.far) return false;
    const ImageAxes axes = image_axes(axis);
    const double pixel = box.size / m;
    glm::dvec3 lo, hi;
    lo[axes.u] = box.lo[axes.u] + minus.u0 * pixel, hi[axes.u] = box.lo[axes.u] + (minus.u1 + 1) * pixel;
    lo[axes.v] = box.lo[axes.v] + minus.v0 * pixel, hi[axes.v] = box.lo[axes.v] + (minus.v1 + 1) * pixel;
    lo[axes.depth] = box.lo[axes.depth] + minus.near * box.size;
    hi[axes.depth] = box.lo[axes.depth] + plus.far * box.size;
    return outline.is_enclosed(lo, hi);
}

/// Polygons are drawn as points too: their corners show however small or thin they are, and their extreme
/// depths are the extremes of anything flat. Filled, they show where clip planes and holes end them.
/// `until_cut`: once something touches a side of the box, the rest is not worth drawing.
/// False where faces were left out that are to be drawn after all.
bool look_along(PassRunner& passes, const Target& target, const Box& box, Axis axis, bool until_cut,
                Outline* outline, Bounds& bounds) {
    std::vector<float> depth;
    Extent extents[2];
    Pass pass;
    pass.box = box;
    pass.offsets = false; // they change no extent
    pass.axis = axis;
    pass.outline = outline;
    for (Side side : {Side::minus, Side::plus}) {
        pass.side = side;
        pass.depth = DepthRule::first;
        pass.polygon_mode = GL_POINT;
        passes.run(pass, target);
        if (side == Side::minus) {
            pass.depth = DepthRule::add;
            pass.polygon_mode = GL_FILL;
            passes.run(pass, target);
        }
        target.read_depth(depth);
        Extent& extent = extents[static_cast<int>(side)];
        extent = extent_of(depth, target.size(), side);
        include(bounds, extent, box, axis, target.size());
        if (until_cut && bounds.touches) return true; // so it does with what was left out
    }
    return !outline || encloses(*outline, extents[0], extents[1], box, axis, target.size());
}

/// Looks again where what was seen does not enclose what was left out: parts may be invisible, so first
/// without those that lie inside of what was seen by then, then with all.
Bounds look_into(PassRunner& passes, const Target& target, const Box& box, bool until_cut, Bounds known) {
    Bounds bounds;
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        Bounds seen;
        for (int attempt = 0; attempt < 3; ++attempt) {
            Outline outline(box, axis, target.size(), known.lo, known.hi);
            seen = bounds;
            const bool is_last = attempt == 2;
            if (look_along(passes, target, box, axis, until_cut, is_last ? nullptr : &outline, seen)) break;
            known.include(seen);
        }
        bounds = seen;
        known.include(seen);
        if (until_cut && bounds.touches) return bounds;
    }
    return bounds;
}

Box grown(const Box& box) { return {box.lo + 0.5 * box.size * (1 - growth), box.size * growth}; }

double moved(const Bounds& a, const Bounds& b) {
    const glm::dvec3 d = glm::max(glm::abs(a.lo - b.lo), glm::abs(a.hi - b.hi));
    return std::max({d.x, d.y, d.z});
}

} // namespace

int box_target_size(int n) { return std::clamp(n, 64, 1024); }

std::optional<Box> search_box(PassRunner& passes, const Target& target, const Box& search, int n) {
    Box box = search;
    Bounds known;
    int growths = 0;
    bool anything = false;
    for (int round = 0; round < max_rounds; ++round) {
        const bool may_grow = growths < (anything ? max_growths : max_empty_growths);
        const Bounds seen = look_into(passes, target, box, may_grow, known);
        anything |= !seen.empty();
        if (seen.empty() && !known.empty()) break; // smaller than float depth can tell: keep what was seen
        if (may_grow && (seen.empty() || seen.touches)) {
            ++growths;
            box = grown(box);
            continue;
        }
        if (seen.empty()) break;
        const bool settled = !known.empty() && moved(seen, known) < 0.25 * seen.extent() / n;
        known = seen;
        if (settled) break;
        const double rounding = std::ldexp(box.size, -20), pixels = 6.0 / target.size();
        box = known.cube(known.extent() * (1 + pixels) + rounding);
    }
    if (known.empty()) return std::nullopt;
    const double extent = std::max(known.extent(), std::ldexp(search.size, -40));
    return known.cube(extent * n / (n - 2 * margin_samples));
}

} // namespace glcast
