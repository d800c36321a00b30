// One round of collapses over all tiles of a surface. Internal.
#pragma once
#include "tools/simplify/surface.h"
#include "tools/simplify/tiles.h"

namespace glcast {

/// A patch, and what its vertices are called in the surface.
template <int N> struct NamedPatch {
    Patch<N> patch;
    std::vector<std::uint32_t> names;
};

/// Everything, nothing locked but the ghost. `mesh` is what the surface came from.
template <int N>
NamedPatch<N> whole_patch(const Surface<N>& surface, const Mesh& mesh, const UnitCube& cube,
                          const TriangleQuadrics<N>& of_triangles);

template <int N> struct Round {
    std::vector<Step> steps; ///< in names of the surface, tile by tile
    Surface<N> left;
    std::vector<std::uint32_t> became; ///< for every vertex of the surface, which one of `left`
};

/// All steps of a round by cost, each tile's in their order.
std::vector<Step> by_cost(const std::vector<Step>& steps);

struct RoundOptions {
    std::size_t triangles_per_tile = 0;
    unsigned turn = 0;
    float price = 0; ///< 0: find one
    /// Where triangles are samples: nearly by cost, planes are added up, and no quadrics are left.
    bool thins = false;
};

/// Collapses what costs no more than the price; sets it where it is 0.
template <int N>
Round<N> collapse_tiles(const Surface<N>& surface, const Mesh& mesh, const UnitCube& cube,
                        const TriangleQuadrics<N>& of_triangles, RoundOptions& options);

} // namespace glcast
