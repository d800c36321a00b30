// Notation: F is the filled end of the edge, E the empty one; `axis` is the edge's, `across` that of an image
// whose rays cross it. s runs along the edge from F (0) to E (1); t is a depth, z the height of the edge
// along `across`.
#include "tools/reconstruct/crossings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

constexpr float tolerance = 0.06f; // a hit this far beyond its edge still belongs to it, samples

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

/// Of a ray, the first hit at or above a height or the last one at or below it.
std::uint32_t hit_above(const AxisHits& hits, std::size_t pixel, float z) {
    for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i)
        if (hits.depth[i] >= z) return i;
    return no_hit;
}
std::uint32_t hit_below(const AxisHits& hits, std::size_t pixel, float z) {
    for (std::uint32_t i = hits.start[pixel + 1]; i > hits.start[pixel]; --i)
        if (hits.depth[i - 1] <= z) return i - 1;
    return no_hit;
}

/// The hit that bounds the body at height z of the edge on its side: seen from F the surface lies further
/// out, seen from E it lies behind.
std::uint32_t bounding_hit(const Edge& e, int across, int side, bool at_empty) {
    const AxisHits& hits = e.rays.axis[across];
    const std::size_t pixel = e.rays.pixel(across, at_empty ? e.empty : e.filled);
    const float z = float(e.filled[across]);
    return (side == 1) != at_empty ? hit_above(hits, pixel, z) : hit_below(hits, pixel, z);
}

/// The plane of a hit, its normal towards `side` of the rays' axis; 0 where unknown.
glm::vec3 plane_of(const Rays& rays, int axis, int side, std::uint32_t hit) {
    const std::uint32_t packed = hit == no_hit ? 0 : rays.axis[axis].plane[hit];
    if (!packed) return glm::vec3(0);
    const glm::vec3 normal = unpack_normal(packed);
    return (normal[axis] > 0) == (side == 1) ? normal : -normal;
}

/// The edge passes a surface seen by the rays `across` on both of its sides: where their planes say.
std::optional<Estimate> between_planes(const Edge& e, int across, int side) {
    const float z = float(e.filled[across]);
    Estimate sum{0, glm::vec3(0), 0};
    for (int end = 0; end < 2; ++end) {
        const std::uint32_t hit = bounding_hit(e, across, side, end == 1);
        const glm::vec3 normal = plane_of(e.rays, across, side, hit);
        const float lean = normal[e.axis] * float(e.towards);
        if (!(lean > 1e-3f)) continue;
        const float t = e.rays.axis[across].depth[hit];
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
    const AxisHits& hits = e.rays.axis[across];
    const std::uint32_t end[2] = {bounding_hit(e, across, 0, false), bounding_hit(e, across, 1, false)};
    if (end[0] == no_hit || end[1] == no_hit) return std::nullopt;
    const float middle = 0.5f * (hits.depth[end[0]] + hits.depth[end[1]]), z = float(e.filled[across]);
    Estimate sum{0, glm::vec3(0), 0};
    for (int side = 0; side < 2; ++side) {
        glm::vec3 normal = plane_of(e.rays, across, side, end[side]);
        const float lean = normal[e.axis] * float(e.towards), up = normal[across];
        const float length = std::hypot(lean, up);
        if (!(lean > 0.05f) || std::abs(up) < 1e-4f) continue;
        const float radius = (hits.depth[end[side]] - middle) * length / up;
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
    Edge inner = e;
    inner.filled[e.axis] -= e.towards;
    if (!e.rays.inside(inner.filled)) return std::nullopt;
    float slope[2];
    for (int k = 0; k < 2; ++k) {
        const glm::vec3 normal =
            plane_of(e.rays, across, side, bounding_hit(k ? inner : e, across, side, false));
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

/// What the rays `across` see beside E.
std::optional<Estimate> seen_across(const Edge& e, int across) {
    if (!e.rays.axis[across].hit(e.rays.pixel(across, e.empty))) return round_outline(e, across);
    const bool below = bounding_hit(e, across, 1, true) != no_hit,
               above = bounding_hit(e, across, 0, true) != no_hit;
    for (int side : {0, 1}) {
        if (!(side ? below : above)) continue;
        if (const auto found = between_planes(e, across, side)) return found;
    }
    for (int side : {0, 1}) {
        if (!(side ? below : above)) continue;
        if (const auto found = steepening_outline(e, across, side)) return found;
    }
    return std::nullopt;
}

std::uint32_t nearest_hit(const AxisHits& hits, std::size_t pixel, float level) {
    std::uint32_t best = no_hit;
    for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i)
        if (best == no_hit || std::abs(hits.depth[i] - level) < std::abs(hits.depth[best] - level)) best = i;
    return best;
}

/// A closed gap or the end of what is hidden: the planes of the pixels around the edge's own go on across it.
std::optional<Estimate> bridged(const Edge& e, int reach) {
    const AxisHits& hits = e.rays.axis[e.axis];
    const ImageAxes image = image_axes(static_cast<Axis>(e.axis));
    const int side = e.side();
    const float level = float(e.filled[e.axis]) + 0.5f * float(e.towards);
    Estimate sum{0, glm::vec3(0), 0};
    for (int dv = -reach; dv <= reach; ++dv)
        for (int du = -reach; du <= reach; ++du) {
            std::array<int, 3> at = e.filled;
            at[image.u] += du;
            at[image.v] += dv;
            if ((!du && !dv) || !e.rays.inside(at)) continue;
            const std::uint32_t hit = nearest_hit(hits, e.rays.pixel(e.axis, at), level);
            const glm::vec3 normal = plane_of(e.rays, e.axis, side, hit);
            const float up = normal[e.axis] * float(e.towards);
            if (!(up > 0.2f)) continue;
            const float t = hits.depth[hit];
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
    const auto add = [&](const std::optional<Estimate>& found) {
        if (!found) return;
        sum.s += found->s * found->weight;
        sum.normal += found->normal * found->weight;
        sum.weight += found->weight;
    };
    for (int across = 0; across < 3; ++across)
        if (across != e.axis) add(seen_across(e, across));
    if (sum.weight == 0) add(bridged(e));
    if (sum.weight == 0) return middle;
    const float length = glm::length(sum.normal);
    return {std::clamp(sum.s / sum.weight, 0.02f, 0.98f), length > 0.5f ? sum.normal / length : glm::vec3(0)};
}

/// F stands for a sheet or thin wall: the ray's hits about it, a little apart.
std::optional<Crossing> side_of_sheet(const Edge& e, std::size_t pixel) {
    const AxisHits& hits = e.rays.axis[e.axis];
    const float at = float(e.filled[e.axis]);
    std::uint32_t low = no_hit, high = no_hit;
    for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i) {
        if (std::abs(hits.depth[i] - at) > 1) continue;
        if (low == no_hit) low = i;
        high = i;
    }
    if (low == no_hit) return std::nullopt;
    const float middle = 0.5f * (hits.depth[low] + hits.depth[high]), half = e.rays.half_thickness;
    return Crossing{e.towards > 0 ? std::max(hits.depth[high], middle + half)
                                  : std::min(hits.depth[low], middle - half),
                    plane_of(e.rays, e.axis, e.side(), e.towards > 0 ? high : low), true};
}

/// The hit of the edge itself that lies furthest out.
std::uint32_t own_hit(const Edge& e, std::size_t pixel) {
    const AxisHits& hits = e.rays.axis[e.axis];
    const float low = float(std::min(e.filled[e.axis], e.empty[e.axis]));
    std::uint32_t best = no_hit;
    float best_beyond = no_depth;
    for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i) {
        const float t = hits.depth[i], beyond = std::max({low - t, t - low - 1, 0.0f});
        if (beyond > tolerance || beyond > best_beyond) continue;
        if (beyond < best_beyond || best == no_hit || e.towards > 0) best = i;
        best_beyond = beyond;
    }
    return best;
}

} // namespace

Crossing find_crossing(const Rays& rays, int axis, const std::array<int, 3>& low, bool low_filled) {
    std::array<int, 3> high = low;
    ++high[axis];
    const Edge e{rays, axis, low_filled ? low : high, low_filled ? high : low, low_filled ? 1 : -1};
    const std::size_t pixel = rays.pixel(axis, e.filled);
    std::array<int, 3> behind = e.filled;
    behind[axis] -= e.towards;
    if (!rays.filled(behind))
        if (const auto found = side_of_sheet(e, pixel)) return *found;
    if (const std::uint32_t hit = own_hit(e, pixel); hit != no_hit)
        return {rays.axis[axis].depth[hit], plane_of(rays, axis, e.side(), hit), true};
    const Estimate guess = estimate(e);
    return {float(e.filled[axis]) + float(e.towards) * guess.s, guess.normal, false};
}

EdgeCrossings::EdgeCrossings(const Rays& rays, const CellGrid& grid)
    : at(grid.quad_start.back()), normal(at.size()), supported(at.size()) {
    const auto put = [&](const Cell& cell, int axis, const std::array<int, 3>& low) {
        const Crossing found = find_crossing(rays, axis, low, cell.config & 1);
        const std::uint32_t quad = quad_of(cell, axis);
        at[quad] = found.at;
        normal[quad] = found.has_plane() ? pack_normal(found.normal) : 0;
        supported[quad] = found.supported;
    };
    tbb::parallel_for(0, grid.n + 1, [&](int z) {
        for (int y = 0; y <= grid.n; ++y)
            for (std::size_t c = grid.row_start[grid.row(y, z)]; c < grid.row_start[grid.row(y, z) + 1]; ++c)
                for (int axis = 0; axis < 3; ++axis)
                    if (owns_quad(grid.cells[c], axis))
                        put(grid.cells[c], axis, {grid.cells[c].x - 1, y - 1, z - 1});
    });
}

} // namespace glcast
