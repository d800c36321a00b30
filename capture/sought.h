// What a pass can still find, told to whoever draws: what cannot be found need not be drawn.
#pragma once
#include <glm/mat4x4.hpp>
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
    OpenTiles(const Box& box, Axis axis, int n);

    void close_all();
    /// Depths 0..1 through the box in which something of a pixel is looked for. They add up.
    void open(std::size_t pixel, float near, float far) {
        const int x = static_cast<int>(pixel % static_cast<std::size_t>(n)),
                  y = static_cast<int>(pixel / static_cast<std::size_t>(n));
        Tile& tile = tiles[static_cast<std::size_t>(y / size) * across + x / size];
        if (near < tile.near) tile.near = near;
        if (far > tile.far) tile.far = far;
    }

    /// May a fragment of these faces lie in an open tile, at a depth that is looked for there?
    bool meet(const Place& place) const;

  private:
    struct Tile {
        float near, far;
    };
    struct Span {
        int first, last;
    };
    Span tiles_between(double lo, double hi, int axis) const;

    const Box box;
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
    /// An image of m x m pixels of the box.
    Outline(const Box& box, Axis axis, int m);

    /// `lo`, `hi`: of everything.
    bool leave_out(const Place& place, const glm::dvec3& lo, const glm::dvec3& hi);
    bool has_left_out() const { return left_lo.x <= left_hi.x; }
    /// Do these bounds, in the capture frame, enclose what was left out?
    bool is_enclosed(const glm::dvec3& lo, const glm::dvec3& hi) const;

  private:
    const Box box;
    const ImageAxes axes;
    const int m;
    double rounding; ///< of a driver, in boxes
    glm::dvec3 left_lo, left_hi;
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
};

} // namespace glcast
