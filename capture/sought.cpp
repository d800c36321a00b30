#include "capture/sought.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
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
    : box(of), axis(axis), axes(image_axes(axis)), n(n),
      size((n + most_tiles_across - 1) / most_tiles_across),
      across(static_cast<std::size_t>((n + size - 1) / size)), tiles(across * across) {
    rounding = rounding_of(box);
    close_all();
}

void OpenTiles::close_all() {
    std::fill(tiles.begin(), tiles.end(),
              Tile{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()});
}

void OpenTiles::open_all() {
    std::fill(tiles.begin(), tiles.end(),
              Tile{-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()});
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

bool OpenTiles::has_centre(const glm::dvec3& lo, const glm::dvec3& hi) const {
    for (const int i : {axes.u, axes.v}) {
        const Span span = tiles_between(lo[i], hi[i], i);
        if (span.first > span.last) return false;
    }
    return true;
}

std::optional<OpenTiles::Cover> OpenTiles::cover_of(const Place& place) const {
    const Span u = tiles_between(place.lo[axes.u], place.hi[axes.u], axes.u),
               v = tiles_between(place.lo[axes.v], place.hi[axes.v], axes.v);
    if (u.first > u.last || v.first > v.last) return std::nullopt;
    const double carried = carried_depth(place, axes.depth, box, n, rounding);
    const double near = (place.lo[axes.depth] - box.lo[axes.depth]) / box.size - carried,
                 far = (place.hi[axes.depth] - box.lo[axes.depth]) / box.size + carried;
    constexpr float end = std::numeric_limits<float>::infinity();
    const auto tile = [](int at) { return static_cast<std::int16_t>(at); };
    return Cover{tile(u.first),
                 tile(u.last),
                 tile(v.first),
                 tile(v.last),
                 std::nextafter(static_cast<float>(near), -end),
                 std::nextafter(static_cast<float>(far), end)};
}

bool OpenTiles::meet(const Cover& cover) const {
    for (int y = cover.v0; y <= cover.v1; ++y)
        for (int x = cover.u0; x <= cover.u1; ++x) {
            const Tile& tile = tiles[static_cast<std::size_t>(y) * across + static_cast<std::size_t>(x)];
            if (tile.near > tile.far) continue;
            if (!(cover.near > tile.far || cover.far < tile.near)) return true;
        }
    return false;
}

Outline::Outline(const Box& of, Axis axis, int m, const glm::dvec3& seen_lo, const glm::dvec3& seen_hi)
    : box(of), axes(image_axes(axis)), m(m), rounding(rounding_of(of)), seen_lo(seen_lo), seen_hi(seen_hi),
      left_lo(std::numeric_limits<double>::infinity()), left_hi(-std::numeric_limits<double>::infinity()) {}

/// Across the image, what lies in the same outermost pixels as the rest widens nothing; in depth, what lies
/// behind it by more than rounding.
Outline::Limits Outline::limits_of(const glm::dvec3& lo, const glm::dvec3& hi) const {
    constexpr double rim = 1e-4; // of what there is
    constexpr double end = std::numeric_limits<double>::infinity();
    const double pixel = box.size / m;
    const auto margin = [&](int i, double inward) { // `inward`: from the outer edge of the pixel, in pixels
        const double least = rim * (hi[i] - lo[i]);
        if (i == axes.depth) return std::max(least, 16 * rounding * box.size);
        inward -= std::floor(inward);
        if (inward > 1 - 2 * snap) inward -= 1; // it may be seen in the next one
        return std::max(least, (2.5 * snap - inward) * pixel);
    };
    Limits limits{lo, hi, lo, hi};
    for (int i = 0; i < 3; ++i) {
        limits.lo[i] += margin(i, (lo[i] - box.lo[i]) / pixel);
        limits.hi[i] -= margin(i, (box.lo[i] + box.size - hi[i]) / pixel);
        const bool may_be_cut = lo[i] < box.lo[i] + pixel || hi[i] > box.lo[i] + box.size - pixel;
        if (may_be_cut) limits.lo[i] = end;
    }
    return limits;
}

bool Outline::leave_out(const Place& place, const glm::dvec3& lo, const glm::dvec3& hi) {
    if (!limits || limits->of_lo != lo || limits->of_hi != hi) {
        const bool has_seen = seen_lo.x <= seen_hi.x;
        limits = has_seen ? limits_of(glm::max(lo, seen_lo), glm::min(hi, seen_hi)) : limits_of(lo, hi);
        limits->of_lo = lo, limits->of_hi = hi;
    }
    for (const int i : {axes.u, axes.v, axes.depth})
        if (!(place.lo[i] > limits->lo[i] && place.hi[i] < limits->hi[i])) return false;
    const double carried = carried_depth(place, axes.depth, box, m, rounding) * box.size;
    glm::dvec3 place_lo = place.lo, place_hi = place.hi;
    place_lo[axes.depth] -= carried, place_hi[axes.depth] += carried;
    if (!(place_lo[axes.depth] > limits->lo[axes.depth] && place_hi[axes.depth] < limits->hi[axes.depth]))
        return false;
    left_lo = glm::min(left_lo, place_lo), left_hi = glm::max(left_hi, place_hi);
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
