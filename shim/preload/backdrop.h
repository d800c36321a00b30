// Which draws of a group are a backdrop: a picture of what is far away, drawn round the scene or behind it
// (sky boxes and domes, cloud planes, a quad with a photograph). Cast as they stand they would take the whole
// lattice. Knows no GL.
//
// The rule. Draws that follow one another and share corners are one piece. A piece may be a backdrop when it
// is a sheet, or bulges away from the eye everywhere, so that neither the eye nor all else is behind any of
// its faces. Then it is one
//
//   vast      when it is at least 16 times as wide as all else together;
//   apart     when it is at least 5 times as wide and away from all else: a sheet by the width of all else,
//   what stands
//             round the eye by a fourth of it;
//   a picture when it is textured, not lit, stands round the eye with the eye in its middle, is at least 1.5
//   times as wide
//             as all else, and is round or touches nothing;
//   pinned    when the depth range puts it at the far plane.
//
// So a floor stays under a model up to 16 times as wide, and a room stays with what stands in it, as long as
// that is a sixteenth as wide as the room. Widths are the longest sides of boxes in the capture frame.
#pragma once
#include <functional>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace glcast::preload {

struct Bounds {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
    void add(const Bounds& other) { lo = glm::min(lo, other.lo), hi = glm::max(hi, other.hi); }
    bool is_empty() const { return !(lo.x <= hi.x); }
    double width() const { return is_empty() ? 0 : std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}); }
};

/// One draw. Capture frame.
struct DrawShape {
    std::vector<std::vector<glm::dvec3>> polygons;
    bool textured = false, lit = false, pinned = false;
};

struct Backdrops {
    std::vector<bool> is_backdrop; ///< by draw
    double times_as_wide = 0;      ///< as all else: the widest of those that are measured
    bool any() const { return std::find(is_backdrop.begin(), is_backdrop.end(), true) != is_backdrop.end(); }
};

/// `shapes`: draws in the order of the frame. `others`: asked at most once for the bounds of what is drawn
/// beside them. Never takes all that there is.
Backdrops find_backdrops(const std::vector<DrawShape>& shapes, const glm::dvec3& eye,
                         const std::function<Bounds()>& others);

} // namespace glcast::preload
