#include "capture/sought.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glcast {

namespace {
constexpr int most_tiles_across = 64, smallest_tile = 2;
}

OpenTiles::OpenTiles(const Box& of, Axis axis, int n)
    : box(of), axes(image_axes(axis)), n(n), size(std::max(smallest_tile, (n + most_tiles_across - 1) / most_tiles_across)),
      across(static_cast<std::size_t>((n + size - 1) / size)), tiles(across * across) {
    close_all();
}

void OpenTiles::close_all() {
    std::fill(tiles.begin(), tiles.end(),
              Tile{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()});
    all_depths = false;
}

bool OpenTiles::meet(const glm::dvec3& lo, const glm::dvec3& hi) const {
    // What a driver rounds off where the box lies far from the origin comes on top.
    const double far_off = std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z)}) / box.size;
    const double margin = 1 + n * 0x1p-17 * (1 + far_off);
    const auto pixels = [&](double at, int axis) { return (at - box.lo[axis]) / box.size * n; };
    const auto tile_at = [&](double pixel) {
        return static_cast<int>(std::floor(std::clamp(pixel, -2.0, n + 2.0) / size));
    };
    const int last = static_cast<int>(across) - 1;
    const int u0 = std::max(tile_at(pixels(lo[axes.u], axes.u) - margin), 0),
              u1 = std::min(tile_at(pixels(hi[axes.u], axes.u) + margin), last),
              v0 = std::max(tile_at(pixels(lo[axes.v], axes.v) - margin), 0),
              v1 = std::min(tile_at(pixels(hi[axes.v], axes.v) + margin), last);
    const double near = (lo[axes.depth] - box.lo[axes.depth]) / box.size - margin / n,
                 far = (hi[axes.depth] - box.lo[axes.depth]) / box.size + margin / n;
    for (int v = v0; v <= v1; ++v)
        for (int u = u0; u <= u1; ++u) {
            const Tile& tile = tiles[static_cast<std::size_t>(v) * across + u];
            if (tile.near > tile.far) continue;
            if (all_depths || !(near > tile.far || far < tile.near)) return true;
        }
    return false;
}

} // namespace glcast
