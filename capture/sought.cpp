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
constexpr double narrow = 8;

double rounding_of(const Box& box) {
    return 0x1p-20 * (1 + std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z)}) / box.size);
}

/// How far depth may be carried on beyond faces, in boxes; without end where a driver's slopes are noise.
double carried_depth(const Place& place, int axis, const Box& box, int n, double rounding) {
    const double slope = place.slope[axis];
    const bool is_known = std::isfinite(slope) && place.narrowest[axis] > narrow * rounding * box.size;
    return is_known ? 2 * (snap / n + rounding) * slope + rounding : std::numeric_limits<double>::infinity();
}

} // namespace

OpenTiles::OpenTiles(const Box& of, Axis axis, int n)
    : box(of), axes(image_axes(axis)), n(n), size((n + most_tiles_across - 1) / most_tiles_across),
      across(static_cast<std::size_t>((n + size - 1) / size)), tiles(across * across) {
    rounding = rounding_of(box);
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
    const double carried = carried_depth(place, axes.depth, box, n, rounding);
    const double near = (place.lo[axes.depth] - box.lo[axes.depth]) / box.size - carried,
                 far = (place.hi[axes.depth] - box.lo[axes.depth]) / box.size + carried;
    for (int y = v.first; y <= v.last; ++y)
        for (int x = u.first; x <= u.last; ++x) {
            const Tile& tile = tiles[static_cast<std::size_t>(y) * across + x];
            if (tile.near > tile.far) continue;
            if (!(near > tile.far || far < tile.near)) return true;
        }
    return false;
}

Outline::Outline(const Box& of, Axis axis, int m)
    : box(of), axes(image_axes(axis)), m(m), rounding(rounding_of(of)),
      left_lo(std::numeric_limits<double>::infinity()), left_hi(-std::numeric_limits<double>::infinity()) {}

bool Outline::leave_out(const Place& place, const glm::dvec3& lo, const glm::dvec3& hi) {
    constexpr double rim = 0.004; // of what there is
    const double pixel = box.size / m;
    const double carried = carried_depth(place, axes.depth, box, m, rounding) * box.size;
    glm::dvec3 place_lo = place.lo, place_hi = place.hi;
    place_lo[axes.depth] -= carried, place_hi[axes.depth] += carried;
    for (int i = 0; i < 3; ++i) {
        if (lo[i] < box.lo[i] + pixel || hi[i] > box.lo[i] + box.size - pixel)
            return false; // it may be cut there
        const double margin = std::max(2.5 * snap * pixel, rim * (hi[i] - lo[i]));
        if (!(place_lo[i] > lo[i] + margin && place_hi[i] < hi[i] - margin)) return false;
    }
    for (int i = 0; i < 3; ++i)
        left_lo[i] = std::min(left_lo[i], place_lo[i]), left_hi[i] = std::max(left_hi[i], place_hi[i]);
    return true;
}

bool Outline::is_enclosed(const glm::dvec3& lo, const glm::dvec3& hi) const {
    const double pixel = box.size / m;
    for (int i = 0; i < 3; ++i) {
        const double margin =
            i == axes.depth ? 4 * rounding * box.size : 2 * snap * pixel; // within the same pixels
        if (!(left_lo[i] > lo[i] + margin && left_hi[i] < hi[i] - margin)) return false;
    }
    return true;
}

} // namespace glcast
