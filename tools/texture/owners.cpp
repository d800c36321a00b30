#include "tools/texture/owners.h"

#include <atomic>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tools/mesh/point_triangle.h"
#include "tools/texture/plane_cells.h"

namespace glcast {
namespace {

constexpr double rounding = 1e-7;    // texels
constexpr double key_step = 1 << 20; // of squared distance

using Key = std::uint64_t; // distance first, then triangle: the least wins, whoever comes first
constexpr Key no_key = ~Key(0);

void offer(Key& slot, Key key) {
    std::atomic_ref<Key> at(slot);
    Key seen = at.load(std::memory_order_relaxed);
    while (key < seen && !at.compare_exchange_weak(seen, key, std::memory_order_relaxed)) {
    }
}

/// Vertices that touch another chart or a boundary.
std::vector<std::uint8_t> border_vertices(const Mesh& mesh, const Neighbours& neighbours,
                                          const Charts& charts) {
    std::vector<std::uint8_t> border(mesh.positions.size());
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, std::uint32_t(border.size()), 4096), [&](const auto& range) {
            for (std::uint32_t v = range.begin(); v < range.end(); ++v)
                for (std::uint32_t corner : neighbours.around(v))
                    border[v] |= charts.of[corner / 3] != charts.of[neighbours.around(v)[0] / 3] ||
                                 neighbours.across[corner / 3][corner % 3] == no_triangle;
        });
    return border;
}

glm::dvec3 flat(const glm::dvec2& p) { return {p.x, p.y, 0}; }

/// All texels about the triangle, by their distance to it, but no farther into the gutter than half of it.
void offer_around(const std::array<glm::dvec2, 3>& c, const Atlas::Place& place, int gutter, std::uint32_t t,
                  int size, std::vector<Key>& keys) {
    const double half = gutter / 2, margin = std::max(1.5, half); // a bilinear filter looks 1.42 away
    const auto clamp_x = [&](double x) {
        return int(std::clamp(x, place.x - half, place.x + place.width + half - 1));
    };
    const auto clamp_y = [&](double y) {
        return int(std::clamp(y, place.y - half, place.y + place.height + half - 1));
    };
    const int x0 = clamp_x(std::floor(std::min({c[0].x, c[1].x, c[2].x}) - margin)),
              x1 = clamp_x(std::floor(std::max({c[0].x, c[1].x, c[2].x}) + margin)),
              y0 = clamp_y(std::floor(std::min({c[0].y, c[1].y, c[2].y}) - margin)),
              y1 = clamp_y(std::floor(std::max({c[0].y, c[1].y, c[2].y}) + margin));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const glm::dvec3 p(x + 0.5, y + 0.5, 0),
                off = nearest_in_triangle(p, flat(c[0]), flat(c[1]), flat(c[2])).point - p;
            const double away = off.x * off.x + off.y * off.y;
            if (!(away <= margin * margin)) continue;
            const Key distance = away <= rounding * rounding ? 0 : Key(away * key_step) + 1;
            offer(keys[std::size_t(y) * size + x], distance << 32 | t);
        }
}

} // namespace

std::array<glm::dvec2, 3> in_atlas(const Mesh& mesh, const Charts& charts, const Atlas& atlas,
                                   std::uint32_t t) {
    std::array<glm::dvec2, 3> out;
    const std::uint32_t chart = charts.of[t];
    for (int k = 0; k < 3; ++k)
        out[k] = in_picture(mesh.positions[mesh.triangles[t][k]], charts.charts[chart].view) * atlas.density +
                 atlas.places[chart].shift;
    return out;
}

std::vector<std::uint32_t> find_owners(const Mesh& mesh, const Neighbours& neighbours, const Charts& charts,
                                       const Atlas& atlas, std::vector<std::array<glm::vec2, 3>>& coordinates) {
    coordinates.resize(charts.of.size());
    const auto border = border_vertices(mesh, neighbours, charts);
    std::vector<Key> keys(std::size_t(atlas.size) * atlas.size, no_key);
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, std::uint32_t(charts.of.size()), 1024), [&](const auto& range) {
            for (std::uint32_t t = range.begin(); t < range.end(); ++t) {
                auto corners = in_atlas(mesh, charts, atlas, t);
                for (int k = 0; k < 3; ++k) coordinates[t][k] = glm::vec2(corners[k] / double(atlas.size));
                const Triangle& v = mesh.triangles[t];
                if (border[v[0]] || border[v[1]] || border[v[2]]) {
                    offer_around(corners, atlas.places[charts.of[t]], atlas.gutter, t, atlas.size, keys);
                    continue;
                }
                for (glm::dvec2& p : corners) p -= 0.5;
                for_cells(corners, -rounding, [&](int x, int y) {
                    offer(keys[std::size_t(y) * atlas.size + x], t);
                    return true;
                });
            }
        });
    std::vector<std::uint32_t> owners(keys.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 65536), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            owners[i] = keys[i] == no_key ? no_triangle : std::uint32_t(keys[i]);
    });
    return owners;
}

} // namespace glcast
