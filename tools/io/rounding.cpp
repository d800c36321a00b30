#include "tools/io/rounding.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <unordered_set>

namespace glcast::format {
namespace {

constexpr double steps = 65535;
constexpr int farthest = 8; ///< steps that a vertex may give way

std::uint64_t key(const GridPoint& p) { return std::uint64_t(p[0]) << 32 | std::uint64_t(p[1]) << 16 | p[2]; }

GridPoint nearest(const glm::dvec3& position, const PositionGrid& grid) {
    GridPoint point;
    for (int k = 0; k < 3; ++k)
        point[k] = std::uint16_t(std::clamp(std::round((position[k] - grid.lo[k]) / grid.step), 0.0, steps));
    return point;
}

/// All vertices but the first of those at one point, ascending.
std::vector<std::uint32_t> doubled(const std::vector<GridPoint>& points) {
    std::vector<std::uint32_t> order(points.size()), found;
    for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t ka = key(points[a]), kb = key(points[b]);
        return ka != kb ? ka < kb : a < b;
    });
    for (std::size_t k = 1; k < order.size(); ++k)
        if (points[order[k]] == points[order[k - 1]]) found.push_back(order[k]);
    std::sort(found.begin(), found.end());
    return found;
}

/// Steps to the points round one, nearest first.
const std::vector<std::array<int, 3>>& ways_out() {
    static const std::vector<std::array<int, 3>> ways = [] {
        std::vector<std::array<int, 3>> all;
        for (int x = -farthest; x <= farthest; ++x)
            for (int y = -farthest; y <= farthest; ++y)
                for (int z = -farthest; z <= farthest; ++z) all.push_back({x, y, z});
        const auto square = [](const auto& w) { return w[0] * w[0] + w[1] * w[1] + w[2] * w[2]; };
        std::stable_sort(all.begin(), all.end(),
                         [&](const auto& a, const auto& b) { return square(a) < square(b); });
        return all;
    }();
    return ways;
}

GridPoint free_point(const GridPoint& at, const std::unordered_set<std::uint64_t>& taken) {
    for (const auto& way : ways_out()) {
        GridPoint p;
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const int moved = int(at[k]) + way[k];
            inside = inside && moved >= 0 && moved <= int(steps);
            p[k] = std::uint16_t(moved);
        }
        if (inside && !taken.contains(key(p))) return p;
    }
    throw std::runtime_error("the mesh is too fine to be quantised; write it without --compress");
}

glm::vec3 direction(const glm::vec3& bytes, const glm::vec3& otherwise) {
    return bytes == glm::vec3(0) ? otherwise : glm::normalize(bytes);
}

} // namespace

PositionGrid grid_for(std::span<const Level> levels) {
    glm::dvec3 lo(0), hi(0);
    bool first = true;
    for (const Level& level : levels)
        for (const glm::dvec3& p : level.mesh.positions) {
            lo = first ? p : glm::min(lo, p), hi = first ? p : glm::max(hi, p);
            first = false;
        }
    const glm::dvec3 size = hi - lo;
    const double largest = std::max({size.x, size.y, size.z});
    return {lo, largest > 0 ? largest / steps : 1};
}

std::vector<GridPoint> on_grid(const Mesh& mesh, const PositionGrid& grid) {
    std::vector<GridPoint> points;
    points.reserve(mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) points.push_back(nearest(p, grid));
    const std::vector<std::uint32_t> moving = doubled(points);
    if (moving.empty()) return points;
    std::unordered_set<std::uint64_t> taken;
    taken.reserve(points.size() * 2);
    for (const GridPoint& p : points) taken.insert(key(p));
    for (const std::uint32_t v : moving) {
        points[v] = free_point(points[v], taken);
        taken.insert(key(points[v]));
    }
    return points;
}

glm::dvec3 position(const GridPoint& p, const PositionGrid& grid) {
    return grid.lo + glm::dvec3(p[0], p[1], p[2]) * grid.step;
}

std::int8_t signed_byte(float value) {
    return std::int8_t(std::lround(std::clamp(value, -1.0f, 1.0f) * 127));
}
std::uint16_t unsigned_short(float value) {
    return std::uint16_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535));
}
float display_byte(float value) { return float(std::lround(std::clamp(value, 0.0f, 1.0f) * 255)) / 255.0f; }

std::array<std::int8_t, 4> tangent_bytes(const glm::vec4& t) {
    return {signed_byte(t.x), signed_byte(t.y), signed_byte(t.z), std::int8_t(t.w < 0 ? -127 : 127)};
}

void round_level(Level& level, const PositionGrid& grid) {
    const std::vector<GridPoint> points = on_grid(level.mesh, grid);
    for (std::size_t v = 0; v < points.size(); ++v) level.mesh.positions[v] = position(points[v], grid);
    for (auto* normals : {&level.mesh.normals, &level.wedges.normals})
        for (glm::vec3& n : *normals) n = direction({signed_byte(n.x), signed_byte(n.y), signed_byte(n.z)}, n);
    for (auto* colours : {&level.mesh.colours, &level.wedges.colours})
        for (glm::vec3& c : *colours)
            for (int k = 0; k < 3; ++k) c[k] = display_byte(c[k]);
    for (auto& corners : level.texture.coordinates)
        for (glm::vec2& at : corners) at = glm::vec2(unsigned_short(at.x), unsigned_short(at.y)) / 65535.0f;
    for (auto& corners : level.texture.tangents)
        for (glm::vec4& tangent : corners) {
            const auto bytes = tangent_bytes(tangent);
            tangent = glm::vec4(direction({bytes[0], bytes[1], bytes[2]}, glm::vec3(tangent)),
                                bytes[3] < 0 ? -1 : 1);
        }
}

} // namespace glcast::format
