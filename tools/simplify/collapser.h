// The run of edge collapses behind simplify(). Internal.
//
// A large surface is collapsed in rounds. In each it is cut into tiles, and tile by tile, on all cores, every
// edge inside a tile that costs no more than the round's price collapses, cheapest first; the rims stay. The
// next round has a higher price and other tiles. What is small, or near its target, is one patch without
// rims. Tiles, prices and order do not depend on threads.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "tools/mesh/mesh.h"
#include "tools/simplify/collapse_log.h"
#include "tools/simplify/surface.h"

namespace glcast {

class Collapser {
  public:
    /// What is left of the mesh: `sources` names for every vertex one of the original it came from, near it.
    struct Remainder {
        std::vector<glm::dvec3> positions;
        std::vector<std::uint32_t> sources;
        std::vector<std::uint32_t> became; ///< for every vertex of the original, which one it was merged into
        std::vector<Triangle> triangles;
        bool closed = true; ///< no boundaries
    };

    /// As many as may be left.
    struct Limit {
        std::size_t triangles = SIZE_MAX, edges = SIZE_MAX;
    };

    /// What has been collapsed so far; colours and normals are left to whoever needs them.
    struct Log {
        CollapseLog collapses;
        std::vector<std::uint32_t> sources; ///< of each: a vertex of the mesh near the new one
    };

    /// `mesh` must be a two-manifold, closed or with boundaries, with `have` edges and triangles, and must
    /// outlive this.
    static std::unique_ptr<Collapser> make(const Mesh& mesh, const Limit& have,
                                           const AttributeWeights& weights, bool keep_log);
    virtual ~Collapser() = default;

    /// Collapse edges, cheapest first, until the limit is kept, or no edge may collapse.
    virtual void reduce_to(const Limit& limit) = 0;
    /// As much of it as is done in rounds, on all cores. True where all the rest is one patch, and so on one
    /// core.
    virtual bool run_rounds(const Limit& limit) = 0;
    virtual Remainder remainder() const = 0;
    /// As remainder() was when the limit was first kept, once reduce_to() has gone past it. Nothing where that was before
    /// the rest became one patch.
    virtual std::optional<Remainder> remainder_at(const Limit& limit) const = 0;
    virtual std::size_t collapses() const = 0; ///< so far
    virtual Log take_log() = 0;                ///< empty unless it was to be kept
};

} // namespace glcast
