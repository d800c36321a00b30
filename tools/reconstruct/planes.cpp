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

struct Fit {
    const std::vector<float>& depth;
    int n;
    float at(int u, int v) const {
        return u < 0 || v < 0 || u >= n || v >= n ? no_depth : depth[std::size_t(v) * n + u];
    }
    Slope along(int u, int v, int du, int dv) const {
        return slope_of(at(u - 2 * du, v - 2 * dv), at(u - du, v - dv), at(u, v), at(u + du, v + dv),
                        at(u + 2 * du, v + 2 * dv));
    }
};

std::uint32_t plane_at(const Fit& fit, const ViewImage& image, const ImageAxes& axes, int u, int v) {
    const std::size_t p = std::size_t(v) * fit.n + u;
    if (!std::isfinite(fit.depth[p])) return 0;
    const Slope along_u = fit.along(u, v, 1, 0), along_v = fit.along(u, v, 0, 1);
    float su = along_u.value, sv = along_v.value;
    bool known = along_u.known && along_v.known;
    const bool exact = known && along_u.bend < flat && along_v.bend < flat;
    const glm::vec4& drawn = image.normal[p];
    if (!exact && drawn.w > 0 && drawn[axes.depth] != 0) {
        const float cu = -drawn[axes.u] / drawn[axes.depth], cv = -drawn[axes.v] / drawn[axes.depth];
        if (std::isfinite(cu) && std::isfinite(cv) && along_u.allows(cu) && along_v.allows(cv)) {
            su = cu;
            sv = cv;
            known = true;
        }
    }
    if (!known) return 0;
    const float outward = image.view.side == Side::minus ? -1.0f : 1.0f;
    glm::vec3 normal;
    normal[axes.u] = -su * outward;
    normal[axes.v] = -sv * outward;
    normal[axes.depth] = outward;
    return pack_normal(glm::normalize(normal));
}

float fold(float a, float b) { return (1 - std::abs(b)) * (a >= 0 ? 1.0f : -1.0f); }

} // namespace

std::uint32_t pack_normal(const glm::vec3& unit) {
    const float sum = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
    float a = unit.x / sum, b = unit.y / sum;
    if (unit.z < 0) {
        const float folded = fold(a, b);
        b = fold(b, a);
        a = folded;
    }
    const auto quantise = [](float x) { return std::uint32_t(std::lround(x * 32767) + 32768); };
    return quantise(a) << 16 | quantise(b);
}

glm::vec3 unpack_normal(std::uint32_t packed) {
    const float a = (int(packed >> 16) - 32768) / 32767.0f, b = (int(packed & 0xffff) - 32768) / 32767.0f;
    const float z = 1 - std::abs(a) - std::abs(b);
    const glm::vec3 out = z < 0 ? glm::vec3(fold(a, b), fold(b, a), z) : glm::vec3(a, b, z);
    return out / std::sqrt(glm::dot(out, out));
}

void find_planes(Rays& rays) {
    const int n = rays.n;
    for (int a = 0; a < 3; ++a)
        for (int side = 0; side < 2; ++side) {
            AxisRays& axis = rays.axis[a];
            axis.plane[side].resize(std::size_t(n) * n);
            const Fit fit{axis.depth[side], n};
            tbb::parallel_for(0, n, [&](int v) {
                for (int u = 0; u < n; ++u)
                    axis.plane[side][std::size_t(v) * n + u] =
                        plane_at(fit, *axis.image[side], image_axes(Axis(a)), u, v);
            });
        }
}

} // namespace glcast
