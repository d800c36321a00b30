// A surface cut into tiles of about as many triangles each. Internal.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

struct Tiles {
    static constexpr std::uint32_t shared = UINT32_MAX;

    std::vector<std::uint32_t> order; ///< triangles, tile by tile
    std::vector<std::uint32_t> first; ///< in `order`, by tile; one more at the end
    std::vector<std::uint32_t> owner; ///< by vertex: the tile that has all its triangles, or shared

    std::size_t count() const { return first.size() - 1; }
    std::span<const std::uint32_t> triangles(std::size_t tile) const {
        return {order.data() + first[tile], first[tile + 1] - first[tile]};
    }
};

/// `positions` lie in a unit cube about 0; a triangle may name one vertex more, which is always shared. The
/// rims of the tiles lie elsewhere for another `turn`. The same tiles on any number of threads.
Tiles cut_into_tiles(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                     std::size_t triangles_per_tile, unsigned turn);

} // namespace glcast
