#include "capture/sought.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glcast {

namespace {
constexpr int most_tiles_across = 128;
/// By how much a driver may move a corner, in pixels: four bits below the pixel are the least that GL asks
/// for.
constexpr double snap = 1.0 / 16;
/// Of what is seen narrower than this, in roundings, a driver's slopes are noise.
constexpr double narrow = 64;
} // namespace

OpenTiles::OpenTiles(const Box& of, Axis axis, int n)
    : box(of), axes(image_axes(axis)), n(n), size((n + most_tiles_across - 1) / most_tiles_across),
      across(static_cast<std::size_t>((n + size - 1) / size)), tiles(across * across) {
    const double far_off = std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z)}) / box.size;
    rounding = 0x1p-20 * (1 + far_off);
    close_all();
}

void OpenTiles::close_all() {
    std::fill(tiles.begin(), tiles.end(),
              Tile{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()});
}

/// A face has a fragment where it covers a pixel's centre.
OpenTiles::Span OpenTiles::tiles_between(double lo, double hi, int axis) const {
    const double margin = snap + rounding * n;
    const auto pixel = [&](double at) {
        return std::clamp((at - box.lo[axis]) / box.size * n - 0.5, -2.0, n + 2.0);
    };
    const int first = std::max(static_cast<int>(std::ceil(pixel(lo) - margin)), 0),
              last = std::min(static_cast<int>(std::floor(pixel(hi) + margin)), n - 1);
    return first <= last ? Span{first / size, last / size} : Span{0, -1};
}

bool OpenTiles::meet(const Place& place) const {
    const Span u = tiles_between(place.lo[axes.u], place.hi[axes.u], axes.u),
               v = tiles_between(place.lo[axes.v], place.hi[axes.v], axes.v);
    const double slope = place.slope[axes.depth];
    const bool has_depth = std::isfinite(slope) && place.narrowest[axes.depth] > narrow * rounding * box.size;
    const double carried = 2 * (snap / n + rounding) * slope + rounding;
    const double near = (place.lo[axes.depth] - box.lo[axes.depth]) / box.size - carried,
                 far = (place.hi[axes.depth] - box.lo[axes.depth]) / box.size + carried;
    for (int y = v.first; y <= v.last; ++y)
        for (int x = u.first; x <= u.last; ++x) {
            const Tile& tile = tiles[static_cast<std::size_t>(y) * across + x];
            if (tile.near > tile.far) continue;
            if (!has_depth || !(near > tile.far || far < tile.near)) return true;
        }
    return false;
}

} // namespace glcast
