// Notation: F is the filled end of the edge, E the empty one; `axis` is the edge's, `across` that of an image
// whose rays cross it. s runs along the edge from F (0) to E (1); t is a depth, z the height of the edge
// along `across`.
#include "tools/reconstruct/crossings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "tools/reconstruct/planes.h"

namespace glcast {
namespace {

constexpr float tolerance = 0.06f;      // a hit this far beyond its edge still belongs to it, samples
constexpr float half_thickness = 0.05f; // of a sheet without thickness, samples

struct Edge {
    const Rays& rays;
    int axis;
    std::array<int, 3> filled, empty;
    int towards; ///< +1 when E is above F, else -1
    int side() const { return towards > 0 ? 1 : 0; }
};

struct Estimate {
    float s;
    glm::vec3 normal;
    float weight = 1;
};

bool plausible(float s) { return s >= -0.1f && s <= 1.1f; }

glm::vec3 plane_of(const Rays& rays, int axis, int side, std::size_t pixel) {
    const std::uint32_t packed = rays.axis[axis].plane[side][pixel];
    return packed ? unpack_normal(packed) : glm::vec3(0);
}

/// The edge passes a surface seen by the rays `across` on both of its sides: where their planes say.
std::optional<Estimate> between_planes(const Edge& e, int across, int side) {
    const AxisRays& rays = e.rays.axis[across];
    const std::size_t pixel[2] = {e.rays.pixel(across, e.filled), e.rays.pixel(across, e.empty)};
    const float z = float(e.filled[across]);
    Estimate sum{0, glm::vec3(0), 0};
    for (int end = 0; end < 2; ++end) {
        const float t = rays.depth[side][pixel[end]];
        const glm::vec3 normal = plane_of(e.rays, across, side, pixel[end]);
        const float lean = normal[e.axis] * float(e.towards);
        if (!std::isfinite(t) || !(lean > 1e-3f)) continue;
        const float s = float(end) - normal[across] * (z - t) / lean;
        if (!plausible(s)) continue;
        const float weight = 0.05f + std::abs((end ? s : 1 - s));
        sum.s += s * weight;
        sum.normal += normal * weight;
        sum.weight += weight;
    }
    if (sum.weight == 0) return std::nullopt;
    return Estimate{sum.s / sum.weight, glm::normalize(sum.normal)};
}

/// Beyond the outline of a round body as the rays `across` see it: the circle through both hits at F with the
/// normal that one of them has.
std::optional<Estimate> round_outline(const Edge& e, int across) {
    const AxisRays& rays = e.rays.axis[across];
    const std::size_t pixel = e.rays.pixel(across, e.filled);
    const float front = rays.depth[0][pixel], back = rays.depth[1][pixel];
    if (!(front < no_depth)) return std::nullopt;
    const float middle = 0.5f * (front + back), z = float(e.filled[across]);
    Estimate sum{0, glm::vec3(0), 0};
    for (int side = 0; side < 2; ++side) {
        glm::vec3 normal = plane_of(e.rays, across, side, pixel);
        const float lean = normal[e.axis] * float(e.towards), up = normal[across];
        const float length = std::hypot(lean, up);
        if (!(lean > 0.05f) || std::abs(up) < 1e-4f) continue;
        const float radius = (rays.depth[side][pixel] - middle) * length / up;
        const float height = z - middle, centre = -radius * lean / length;
        if (!(radius > std::abs(height))) continue;
        const float s = centre + std::sqrt(radius * radius - height * height);
        if (!plausible(s)) continue;
        normal *= std::abs(s - centre) / (radius * std::max(lean / length, 1e-3f));
        normal[e.axis] = float(e.towards) * (s - centre) / radius;
        normal[across] = height / radius;
        sum.s += s;
        sum.normal += glm::normalize(normal);
        sum.weight += 1;
    }
    if (sum.weight == 0) return std::nullopt;
    return Estimate{sum.s / sum.weight, glm::normalize(sum.normal)};
}

/// Behind the outline of a nearer part: on a round part the square of the slope grows like 1 / distance to
/// the outline.
std::optional<Estimate> steepening_outline(const Edge& e, int across, int side) {
    std::array<int, 3> inner = e.filled;
    inner[e.axis] -= e.towards;
    if (!e.rays.inside(inner)) return std::nullopt;
    float slope[2];
    const std::size_t pixel[2] = {e.rays.pixel(across, e.filled), e.rays.pixel(across, inner)};
    for (int k = 0; k < 2; ++k) {
        const glm::vec3 normal = plane_of(e.rays, across, side, pixel[k]);
        if (normal[across] == 0) return std::nullopt;
        slope[k] = normal[e.axis] * float(e.towards) / std::abs(normal[across]);
        if (!(slope[k] > 0.05f)) return std::nullopt;
    }
    const float ratio = slope[0] * slope[0] / (slope[1] * slope[1]);
    if (!(ratio > 1.3f)) return std::nullopt;
    const float s = 1 / (ratio - 1);
    if (!plausible(s)) return std::nullopt;
    glm::vec3 normal(0);
    normal[e.axis] = float(e.towards);
    return Estimate{s, normal, 0.5f};
}

/// E was carved away by the rays `across`: the surface is what they see beside it.
std::optional<Estimate> carved_across(const Edge& e, int across) {
    const AxisRays& rays = e.rays.axis[across];
    const std::size_t beyond = e.rays.pixel(across, e.empty);
    const float z = float(e.empty[across]);
    if (!rays.hit(beyond)) return round_outline(e, across);
    const int side = rays.depth[0][beyond] > z ? 0 : 1;
    if (const auto found = between_planes(e, across, side)) return found;
    return steepening_outline(e, across, side);
}

/// E was left by its own rays' closed depths: a closed gap. The planes of the pixels around it go on across
/// it.
std::optional<Estimate> bridged(const Edge& e, int reach) {
    const AxisRays& rays = e.rays.axis[e.axis];
    const ImageAxes image = image_axes(static_cast<Axis>(e.axis));
    const int side = e.side();
    Estimate sum{0, glm::vec3(0), 0};
    for (int dv = -reach; dv <= reach; ++dv)
        for (int du = -reach; du <= reach; ++du) {
            std::array<int, 3> at = e.filled;
            at[image.u] += du;
            at[image.v] += dv;
            if ((!du && !dv) || !e.rays.inside(at)) continue;
            const std::size_t pixel = e.rays.pixel(e.axis, at);
            const glm::vec3 normal = plane_of(e.rays, e.axis, side, pixel);
            const float up = normal[e.axis] * float(e.towards), t = rays.depth[side][pixel];
            if (!std::isfinite(t) || !(up > 0.2f)) continue;
            const float rise = (normal[image.u] * float(du) + normal[image.v] * float(dv)) / up;
            const float s = (t - float(e.filled[e.axis])) * float(e.towards) + rise;
            if (!plausible(s)) continue;
            const float weight = 1 / float(du * du + dv * dv);
            sum.s += s * weight;
            sum.normal += normal * weight;
            sum.weight += weight;
        }
    if (sum.weight == 0) return std::nullopt;
    return Estimate{sum.s / sum.weight, glm::normalize(sum.normal)};
}

std::optional<Estimate> bridged(const Edge& e) {
    for (int reach : {2, 4, 8})
        if (const auto found = bridged(e, reach)) return found;
    return std::nullopt;
}

Estimate estimate(const Edge& e) {
    const Estimate middle{0.5f, glm::vec3(0)};
    if (!e.rays.inside(e.empty)) return middle;
    Estimate sum{0, glm::vec3(0), 0};
    for (int across = 0; across < 3; ++across) {
        if (e.rays.left_by(across, e.empty)) continue;
        const auto found = across == e.axis ? bridged(e) : carved_across(e, across);
        if (!found) continue;
        sum.s += found->s * found->weight;
        sum.normal += found->normal * found->weight;
        sum.weight += found->weight;
    }
    if (sum.weight == 0) return middle;
    const float length = glm::length(sum.normal);
    return {std::clamp(sum.s / sum.weight, 0.02f, 0.98f), length > 0.5f ? sum.normal / length : glm::vec3(0)};
}

/// A sheet's two sides, a little apart around the depth that was seen.
float sheet_side(const AxisRays& rays, std::size_t pixel, int side) {
    const float front = rays.depth[0][pixel], back = rays.depth[1][pixel], middle = 0.5f * (front + back);
    return side ? std::max(back, middle + half_thickness) : std::min(front, middle - half_thickness);
}

/// The edge leaves a thin wall that the ray came upon from the other side.
std::optional<Crossing> back_of_wall(const Edge& e, std::size_t pixel) {
    const AxisRays& along = e.rays.axis[e.axis];
    const int other = 1 - e.side();
    const bool wall = other ? (along.keep[pixel] & keep_last) && along.last[pixel] == e.filled[e.axis]
                            : (along.keep[pixel] & keep_first) && along.first[pixel] == e.filled[e.axis];
    if (!wall) return std::nullopt;
    return Crossing{along.depth[other][pixel] + float(e.towards) * 2 * half_thickness,
                    -plane_of(e.rays, e.axis, other, pixel), true};
}

} // namespace

Crossing find_crossing(const Rays& rays, int axis, const std::array<int, 3>& low, bool low_filled) {
    std::array<int, 3> high = low;
    ++high[axis];
    const Edge e{rays, axis, low_filled ? low : high, low_filled ? high : low, low_filled ? 1 : -1};
    const std::size_t pixel = rays.pixel(axis, e.filled);
    const AxisRays& along = rays.axis[axis];
    const float t = along.depth[e.side()][pixel], floor = float(low[axis]);
    if ((along.keep[pixel] & keep_between) && std::abs(t - float(e.filled[axis])) <= 1)
        return {sheet_side(along, pixel, e.side()), plane_of(rays, axis, e.side(), pixel), true};
    if (const auto back = back_of_wall(e, pixel)) return *back;
    if (t >= floor - tolerance && t <= floor + 1 + tolerance)
        return {t, plane_of(rays, axis, e.side(), pixel), true};
    const Estimate guess = estimate(e);
    return {float(e.filled[axis]) + float(e.towards) * guess.s, guess.normal, false};
}

} // namespace glcast
