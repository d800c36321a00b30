// What a pass can still find, told to whoever draws: what cannot be found need not be drawn.
#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "capture/view.h"

namespace glcast {

/// Where filled faces lie in the capture frame.
struct Place {
    glm::dvec3 lo, hi; ///< a box that holds them, what a driver rounds off included
    /// Along each axis: how much a face rises in depth over a distance across, at most, and how narrow one is
    /// seen, at least. A driver moves corners by parts of a pixel, and carries depth on beyond the face by as
    /// much.
    glm::dvec3 slope, narrowest;
};

/// An image cut into square tiles. Each is closed, or open to what lies between two depths.
class OpenTiles {
  public:
    /// What tells whether and where faces cover the centre of a pixel.
    struct Grid {
        glm::dvec3 lo{0};
        double size = 0;
        Axis axis = Axis::x;
        int n = 0;
        bool operator==(const Grid&) const = default;
    };
    /// The tiles and the depths in which faces may have fragments.
    struct Cover {
        std::int16_t u0, u1, v0, v1;
        float near, far;
    };

    OpenTiles(const Box& box, Axis axis, int n);

    void close_all();
    /// To all depths.
    void open_all();
    /// Depths 0..1 through the box in which something of a pixel is looked for. They add up.
    void open(std::size_t pixel, float near, float far) {
        const int x = static_cast<int>(pixel % static_cast<std::size_t>(n)),
                  y = static_cast<int>(pixel / static_cast<std::size_t>(n));
        Tile& tile = tiles[static_cast<std::size_t>(y / size) * across + x / size];
        if (near < tile.near) tile.near = near;
        if (far > tile.far) tile.far = far;
    }

    /// May a fragment of these faces lie in an open tile, at a depth that is looked for there?
    bool meet(const Cover& cover) const;

    Grid grid() const { return {box.lo, box.size, axis, n}; }
    /// Do faces between these corners cover the centre of a pixel?
    bool has_centre(const glm::dvec3& lo, const glm::dvec3& hi) const;
    std::optional<Cover> cover_of(const Place& place) const;

  private:
    struct Tile {
        float near, far;
    };
    struct Span {
        int first, last;
    };
    Span tiles_between(double lo, double hi, int axis) const;

    const Box box;
    const Axis axis;
    const ImageAxes axes;
    const int n, size;
    const std::size_t across;
    double rounding; ///< of a driver, in boxes
    std::vector<Tile> tiles;
};

/// Of a pass that only looks how far things reach: faces well inside of the rest are left out, and noted.
/// What is then seen must enclose them, else they are to be drawn after all.
class Outline {
  public:
    /// An image of m x m pixels of the box. `seen_lo`, `seen_hi`: what is known to reach at least so far.
    Outline(const Box& box, Axis axis, int m, const glm::dvec3& seen_lo, const glm::dvec3& seen_hi);

    /// `lo`, `hi`: of everything, seen or not.
    bool leave_out(const Place& place, const glm::dvec3& lo, const glm::dvec3& hi);
    bool has_left_out() const { return left_lo.x <= left_hi.x; }
    /// Do these bounds, in the capture frame, enclose what was left out?
    bool is_enclosed(const glm::dvec3& lo, const glm::dvec3& hi) const;

  private:
    /// What lies between is left out.
    struct Limits {
        glm::dvec3 of_lo{0}, of_hi{0}; ///< of everything
        glm::dvec3 lo{0}, hi{0};
    };
    Limits limits_of(const glm::dvec3& lo, const glm::dvec3& hi) const;

    const Box box;
    const ImageAxes axes;
    const int m;
    const double rounding; ///< of a driver, in boxes
    const glm::dvec3 seen_lo, seen_hi;
    glm::dvec3 left_lo, left_hi;
    std::optional<Limits> limits;
};

struct Sought {
    glm::dmat4 eye_to_capture{1.0};
    /// Null: everything counts.
    const OpenTiles* open = nullptr;
    /// Polygons are drawn as points, and what lies in this box may be drawn as GL_POINTS at once. Null: as it
    /// is.
    const Box* corners = nullptr;
    /// Null: all is to be drawn.
    Outline* outline = nullptr;
    bool notes_places = false; ///< where draws lie will be wanted in the passes that follow
    bool only_places = false;  ///< they are noted, and nothing is drawn
    bool shows_all = false;    ///< of a draw that is left out, one without elements is to be made
};

} // namespace glcast
