// A flat closing leaves a function whose sublevel sets are convex as it is, on the lattice too: a half-plane
// of pixels is closed under every disc. On concave outlines the digital disc is a little too coarse, so a
// change is taken only where it removes a slit: pixels on two opposite sides close by, and a step deeper
// than `slit_depth`.
#include "tools/reconstruct/closing.h"

#include <algorithm>
#include <cmath>

#include "tools/reconstruct/hits.h"

namespace glcast {
namespace {

constexpr float slit_depth = 3; // samples; a shallower groove is kept as captured

struct Image {
    const std::vector<float>& at;
    int n;
    bool inside(int u, int v) const { return u >= 0 && v >= 0 && u < n && v < n; }
};

template <class Pick>
std::vector<float> disc_filter(const Image& in, double radius, float outside, Pick pick) {
    const int n = in.n, r = int(radius);
    std::vector<float> out(in.at.size(), outside);
    for (int dv = -r; dv <= r; ++dv) {
        const int half = int(std::sqrt(radius * radius - dv * dv));
        for (int v = std::max(0, -dv); v < std::min(n, n - dv); ++v) {
            float* to = &out[std::size_t(v) * n];
            const float* from = &in.at[std::size_t(v + dv) * n];
            for (int du = -half; du <= half; ++du)
                for (int u = std::max(0, -du); u < std::min(n, n - du); ++u)
                    to[u] = pick(to[u], from[u + du]);
        }
    }
    return out;
}

/// Is there, on a line through the pixel, a pixel no deeper than `level` on both sides, 2 radius + 1 apart at
/// most?
bool between_walls(const Image& depth, int u, int v, float level, double radius) {
    constexpr int lines[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    const double reach = 2 * radius + 1 + 1e-6;
    for (const auto& line : lines) {
        const double step = std::hypot(line[0], line[1]);
        double apart = 0;
        for (int sign : {-1, 1}) {
            int k = 1;
            while (k * step <= reach) {
                const int qu = u + sign * k * line[0], qv = v + sign * k * line[1];
                if (depth.inside(qu, qv) && depth.at[std::size_t(qv) * depth.n + qu] <= level) break;
                ++k;
            }
            apart += k * step;
        }
        if (apart <= reach * std::max(1.0, step * 0.75)) return true;
    }
    return false;
}

/// `depth` grows away from the viewer, no_depth where nothing is.
std::vector<float> close(const std::vector<float>& depth, int n, double radius) {
    const Image image{depth, n};
    const auto nearer = disc_filter(image, radius, no_depth, [](float a, float b) { return std::min(a, b); });
    auto closed =
        disc_filter({nearer, n}, radius, -no_depth, [](float a, float b) { return std::max(a, b); });
    for (int v = 0; v < n; ++v)
        for (int u = 0; u < n; ++u) {
            const std::size_t p = std::size_t(v) * n + u;
            const bool border = std::min({u, v, n - 1 - u, n - 1 - v}) < radius;
            if (border || !(depth[p] - closed[p] > slit_depth) ||
                !between_walls(image, u, v, closed[p] + slit_depth, radius))
                closed[p] = depth[p];
        }
    return closed;
}

/// The nearest pixel along a line that is no sheet and lies nearer than `level`.
int steps_to_wall(const Image& depth, const std::vector<float>& far, int u, int v, int du, int dv,
                  float level, int most) {
    for (int k = 1; k <= most; ++k) {
        if (!depth.inside(u + k * du, v + k * dv)) break;
        const std::size_t q = std::size_t(v + k * dv) * depth.n + u + k * du;
        if (depth.at[q] < level && far[q] - depth.at[q] > 1) return k;
    }
    return 0;
}

/// Depth of the walls of a slit, `most` pixels wide and `steep` times as deep, through which the ray of the
/// pixel looks into a shell; or the pixel's own.
float level_over_hollow(const Image& depth, const std::vector<float>& far, int u, int v, int most) {
    constexpr int lines[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    constexpr float steep = 6;
    const std::size_t p = std::size_t(v) * depth.n + u;
    float best = depth.at[p];
    int narrowest = most + 1;
    for (const auto& line : lines) {
        const float level = depth.at[p] - slit_depth;
        const int ahead = steps_to_wall(depth, far, u, v, line[0], line[1], level, most);
        const int behind =
            ahead ? steps_to_wall(depth, far, u, v, -line[0], -line[1], level, most - ahead + 1) : 0;
        if (!ahead || !behind || ahead + behind > narrowest) continue;
        const auto at = [&](int k) {
            return depth.at[std::size_t(v + k * line[1]) * depth.n + u + k * line[0]];
        };
        const float wall = std::max(at(ahead), at(-behind));
        if (depth.at[p] - wall < steep * float(ahead + behind - 1)) continue;
        narrowest = ahead + behind;
        best = wall;
    }
    return best;
}

/// A ray that comes through a slit and ends on a surface of no thickness looks into a shell, as most GL
/// models are. What it sees in there is no outside, so the slit is closed up to some times the width of other
/// gaps.
void close_over_hollows(std::vector<float>& closed, const std::vector<float>& depth,
                        const std::vector<float>& far, int n, double radius) {
    const Image image{depth, n};
    const int most = int(2 * radius * std::max(4.0, n / 64.0)) + 1;
    for (int v = 0; v < n; ++v)
        for (int u = 0; u < n; ++u) {
            const std::size_t p = std::size_t(v) * n + u;
            if (depth[p] == no_depth || far[p] - depth[p] > 0.5f || closed[p] < depth[p]) continue;
            closed[p] = level_over_hollow(image, far, u, v, most);
        }
}

void negate(std::vector<float>& depth) {
    for (float& d : depth) d = -d;
}

} // namespace

EndDepths close_depths(const EndDepths& captured, int n, double radius) {
    EndDepths out = captured;
    if (radius <= 0) return out;
    const double disc = radius + 0.5; // of pixels, which reach half a sample further: slits up to 2r + 1 wide
    std::vector<float> away = captured.back, far = captured.front; // the back seen from behind
    negate(away);
    negate(far);
    out.front = close(captured.front, n, disc);
    out.back = close(away, n, disc);
    close_over_hollows(out.front, captured.front, captured.back, n, radius);
    close_over_hollows(out.back, away, far, n, radius);
    negate(out.back);
    for (std::size_t p = 0; p < out.front.size(); ++p)
        if (out.front[p] == no_depth || out.back[p] == -no_depth || out.front[p] > out.back[p]) {
            out.front[p] = captured.front[p];
            out.back[p] = captured.back[p];
        }
    return out;
}

} // namespace glcast
