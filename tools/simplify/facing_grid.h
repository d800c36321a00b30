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

    void add(const FloatBox& box, Facing faced) {
        each(box, [&](std::size_t cell) { cells[cell] &= faced; });
    }
    /// The directions that everything in the box, and what faces `faced`, faces; none where the box is large.
    Facing common(const FloatBox& box, Facing faced) const;

    std::size_t count() const { return cells.size(); }
    /// Calls visit(number) for the cells that the box touches. What is outside belongs to the outermost ones.
    template <typename F> void each(const FloatBox& box, const F& visit) const {
        const Range r = range_of(box);
        for (int z = r.low[2]; z <= r.high[2]; ++z)
            for (int y = r.low[1]; y <= r.high[1]; ++y)
                for (int x = r.low[0]; x <= r.high[0]; ++x)
                    visit(std::size_t(x) +
                          std::size_t(size[0]) * (std::size_t(y) + std::size_t(size[1]) * std::size_t(z)));
    }

  private:
    struct Range {
        int low[3], high[3]; ///< both are meant
        int count() const { return (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1); }
    };
    Range range_of(const FloatBox& box) const;

    glm::vec3 low{0};
    float per_unit = 0; ///< cells
    int size[3] = {0, 0, 0};
    std::vector<Facing> cells;
};

} // namespace glcast
