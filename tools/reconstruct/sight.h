// Which free space can be seen from far away: the second half of the exterior rule.
//
// On a coarse grid of at most 128 cells an axis, a cell sees out in a direction when a straight line of free
// cells leads from it out of the box. Cells that see out in few of 192 directions form chambers. A chamber is
// hidden when its openings, where it borders on cells that see more, are small against its walls: it opens or
// closes as a whole, so no single beam through a slit carves a crevice, and blind ends of bores stay open.
#pragma once
#include <optional>
#include <span>

#include "tools/reconstruct/volume.h"

namespace glcast {

struct Sight {
    enum Cell : std::uint8_t {
        not_free, ///< not all of its samples are free
        open,
        hidden,
    };
    int cells = 0; ///< an axis
    int scale = 1; ///< samples per cell
    std::vector<Cell> state;

    /// Of the cell that holds the sample.
    Cell at(const std::array<int, 3>& s) const { return state[cell_of(s)]; }
    std::size_t cell_of(const std::array<int, 3>& s) const {
        return (std::size_t(s[2] / scale) * cells + s[1] / scale) * cells + s[0] / scale;
    }
};

/// `free`: samples that are free and connected with the border of the box, off every wall. Nothing when all
/// of it is open. Chambers that hold one of the samples `seen` are open.
std::optional<Sight> find_sight(const Volume& free, std::span<const std::array<int, 3>> seen = {});

} // namespace glcast
