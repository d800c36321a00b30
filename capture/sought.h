// What a pass can still find, told to whoever draws: what cannot be found need not be drawn.
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>

#include "capture/pixel_rect.h"
#include "capture/view.h"

namespace glcast {

/// An image cut into square tiles. Each is closed, or open to what lies between two depths.
class OpenTiles {
  public:
    OpenTiles(const Box& box, Axis axis, int n);

    void close_all();
    /// Depths 0..1 through the box, of a pixel that is looked for. They add up.
    void open(std::size_t pixel, float near, float far) {
        const int x = static_cast<int>(pixel % static_cast<std::size_t>(n)),
                  y = static_cast<int>(pixel / static_cast<std::size_t>(n));
        Tile& tile = tiles[static_cast<std::size_t>(y / size) * across + x / size];
        if (near < tile.near) tile.near = near;
        if (far > tile.far) tile.far = far;
    }
    /// All depths of the tiles that are open.
    void open_depths() { all_depths = true; }

    /// May anything of a box in the capture frame be seen in an open tile? A pixel across and a sample of depth are
    /// granted.
    bool meet(const glm::dvec3& lo, const glm::dvec3& hi) const;

  private:
    struct Tile {
        float near, far;
    };
    const Box box;
    const ImageAxes axes;
    const int n, size;
    const std::size_t across;
    bool all_depths = false;
    std::vector<Tile> tiles;
};

struct Sought {
    glm::dmat4 eye_to_capture{1.0};
    /// Null: everything counts.
    const OpenTiles* open = nullptr;
    /// Polygons are drawn as points, and what lies in this box may be drawn as GL_POINTS at once. Null: as it is.
    const Box* corners = nullptr;
};

} // namespace glcast
