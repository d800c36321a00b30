// Slopes of the depth image are taken from the side where the surface is smoothest (Harten et al. 1987,
// essentially non-oscillatory differences), so that they are exact beside an edge of a flat-sided body. A
// captured normal may be flipped, smooth over facets or plain wrong: it is believed only when its slopes lie
// between those of both sides.
#include "tools/reconstruct/planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

constexpr float flat = 0.01f;      // second difference, samples: below it the slope itself is exact enough
constexpr float agreement = 0.04f; // sine of the slope: how far a captured normal may be off

float sine(float slope) { return slope / std::sqrt(1 + slope * slope); }

/// What five depths in a line say of the slope at the middle one.
struct Slope {
    bool known = false;
    float value = 0, bend = no_depth; ///< bend: second difference where `value` was taken
    float low = -1, high = 1;         ///< sines of the slopes that the depths allow
    bool allows(float slope) const {
        return sine(slope) >= low - agreement && sine(slope) <= high + agreement;
    }
};

void consider(Slope& slope, float value, float bend) {
    if (!(std::abs(bend) < slope.bend)) return;
    slope.known = true;
    slope.value = value;
    slope.bend = std::abs(bend);
}

/// Allowed slopes: between the one-sided ones; on flat ground only these themselves. Towards the outline of
/// the body (one side missing) a curved surface may get steeper without bound.
void set_allowed(Slope& slope, float forward, float backward, float bend_forward, float bend_backward) {
    const bool has_forward = std::isfinite(forward), has_backward = std::isfinite(backward);
    if (has_forward && has_backward) {
        slope.low = std::min(sine(forward), sine(backward));
        slope.high = std::max(sine(forward), sine(backward));
    } else if (has_forward || has_backward) {
        const float inner = sine(has_forward ? forward : backward);
        const float steeper = has_forward ? -bend_forward : bend_backward;
        slope.low = steeper > 0 ? inner : -1;
        slope.high = steeper < 0 ? inner : 1;
    }
    if (slope.bend < flat) slope.low = slope.high = sine(slope.value);
}

Slope slope_of(float b2, float b1, float mid, float f1, float f2) {
    Slope slope;
    const float forward = f1 - mid, backward = mid - b1;
    const float bend_forward = f2 - 2 * f1 + mid, bend_backward = mid - 2 * b1 + b2;
    const bool has_forward = std::isfinite(forward), has_backward = std::isfinite(backward);
    if (has_forward && has_backward) consider(slope, 0.5f * (forward + backward), forward - backward);
    if (has_forward && std::isfinite(bend_forward))
        consider(slope, forward - 0.5f * bend_forward, bend_forward);
    if (has_backward && std::isfinite(bend_backward))
        consider(slope, backward + 0.5f * bend_backward, bend_backward);
    if (!slope.known && (has_forward || has_backward)) {
        slope.known = true;
        slope.value = has_forward ? forward : backward;
    }
    set_allowed(slope, forward, backward, bend_forward, bend_backward);
    return slope;
}

/// The depths around a hit that continue its surface.
struct Fit {
    const AxisHits& hits;
    int n;
    std::uint32_t rank = 0, count = 0; ///< of the hit in its ray

    /// In a ray with as many hits the one of the same rank, else the one nearest to where it should be.
    float next(int u, int v, float expected) const {
        if (u < 0 || v < 0 || u >= n || v >= n || !std::isfinite(expected)) return no_depth;
        const std::size_t p = std::size_t(v) * n + u;
        const std::uint32_t from = hits.start[p], to = hits.start[p + 1];
        if (to - from == count) return hits.depth[from + rank];
        float best = no_depth;
        for (std::uint32_t i = from; i < to; ++i)
            if (!(std::abs(hits.depth[i] - expected) >= std::abs(best - expected))) best = hits.depth[i];
        return best;
    }
    /// `slope`: what the drawn normal says, else 0.
    Slope along(int u, int v, int du, int dv, float depth, float slope) const {
        float beside[2], after[2];
        for (int k = 0; k < 2; ++k) {
            const int sign = k ? 1 : -1;
            beside[k] = next(u + sign * du, v + sign * dv, depth + float(sign) * slope);
            after[k] = next(u + 2 * sign * du, v + 2 * sign * dv, 2 * beside[k] - depth);
        }
        return slope_of(after[0], beside[0], depth, beside[1], after[1]);
    }
};

std::uint32_t plane_at(const Fit& fit, std::uint32_t hit, const ImageAxes& axes, int u, int v) {
    const std::uint32_t packed = fit.hits.normal[hit];
    const glm::vec3 drawn = packed ? unpack_normal(packed) : glm::vec3(0);
    float cu = -drawn[axes.u] / drawn[axes.depth], cv = -drawn[axes.v] / drawn[axes.depth];
    const bool usable = std::isfinite(cu) && std::isfinite(cv);
    if (!usable) cu = cv = 0;
    const float depth = fit.hits.depth[hit];
    const Slope along_u = fit.along(u, v, 1, 0, depth, cu), along_v = fit.along(u, v, 0, 1, depth, cv);
    float su = along_u.value, sv = along_v.value;
    bool known = along_u.known && along_v.known;
    const bool exact = known && along_u.bend < flat && along_v.bend < flat;
    if (!exact && usable && along_u.allows(cu) && along_v.allows(cv)) {
        su = cu;
        sv = cv;
        known = true;
    }
    if (!known) return 0;
    glm::vec3 normal;
    normal[axes.u] = -su;
    normal[axes.v] = -sv;
    normal[axes.depth] = 1;
    return pack_normal(glm::normalize(normal));
}

} // namespace

void find_planes(AxisHits& hits, Axis axis, int n) {
    hits.plane.resize(hits.depth.size());
    const ImageAxes axes = image_axes(axis);
    tbb::parallel_for(0, n, [&](int v) {
        for (int u = 0; u < n; ++u) {
            const std::size_t p = std::size_t(v) * n + u;
            const std::uint32_t from = hits.start[p], count = hits.start[p + 1] - from;
            for (std::uint32_t i = 0; i < count; ++i)
                hits.plane[from + i] = plane_at({hits, n, i, count}, from + i, axes, u, v);
        }
    });
}

} // namespace glcast
