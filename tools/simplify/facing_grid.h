// Which ways a surface faces, region by region: a quick answer to "does all of it, in this box, face one
// way?". Internal.
#pragma once
#include <cstdint>
#include <vector>

#include "tools/simplify/box_tree.h"

namespace glcast {

/// Bit k is direction k of 32, spread evenly: the 12 corners and 20 faces of an icosahedron.
using Facing = std::uint32_t;

/// The directions that a triangle with this normal (of length 1, or 0) clearly faces.
Facing facing(const glm::vec3& normal);

/// Cells that hold, each, the directions that everything that ever touched it faces.
class FacingGrid {
  public:
    FacingGrid() = default;
    explicit FacingGrid(const std::vector<BoxTree::Item>& items);

    void add(const FloatBox& box, Facing faced);
    /// The directions that everything in the box, and what faces `faced`, faces; none where the box is large.
    Facing common(const FloatBox& box, Facing faced) const;

  private:
    struct Range {
        int low[3], high[3]; ///< both are meant
        int count() const { return (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1); }
    };
    Range range_of(const FloatBox& box) const;
    /// Calls visit(cell).
    template <typename Cells, typename F>
    static void each(Cells& cells, const int* size, const Range& range, const F& visit);

    glm::vec3 low{0};
    float per_unit = 0; ///< cells
    int size[3] = {0, 0, 0};
    std::vector<Facing> cells;
};

} // namespace glcast
