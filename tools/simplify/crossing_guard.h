// Keeps a surface that changes from passing through itself. Internal.
//
// A change takes triangles away and fills the hole with others. It is looked at in the box B of both. Where
// all triangles in B, old and new, face one direction d, a closed surface that did not cross itself meets a
// line along d once in B at most: two meetings in a row never have the same sense. The new triangles have the
// rim and the sense of the old ones, so they meet such a line where those did, and once too: neither each
// other, nor anything else of that surface. So only what is not joined to them is tested pair by pair (it may
// be of another surface, the wrong way round). Where not all faces one way, all pairs are tested.
#pragma once
#include <optional>
#include <span>

#include "tools/simplify/box_tree.h"
#include "tools/simplify/facing_grid.h"
#include "tools/simplify/separation.h"

namespace glcast {

/// Triangles that are replaced, and those in their place, in which vertex `moved`, where there is one, is at
/// `to`.
struct SurfaceChange {
    std::vector<std::uint32_t> replaced;
    std::vector<Triangle> made;
    std::uint32_t moved = UINT32_MAX;
    glm::dvec3 to{0};
};

class CrossingGuard {
  public:
    /// As its owner keeps it; three corners to a triangle. What has a corner that is no vertex is gone, or
    /// passed over.
    struct Surface {
        std::span<const glm::dvec3> positions;
        std::span<const std::uint32_t> corners;
    };

    CrossingGuard() = default;
    /// `closed`: without boundaries.
    CrossingGuard(const Surface& surface, bool closed);

    /// From now on look at the surface as it is; spares work after many changes.
    void build(const Surface& surface);

    /// Would a triangle that is made cross another one, or come nearer to it than positions change when they
    /// are rounded to floats, or lie folded on a neighbour? What a replaced triangle crossed already does not
    /// count.
    bool crosses(const Surface& surface, const SurfaceChange& change);

    /// The change that was last asked about has been made.
    void made_it(const Surface& surface, const SurfaceChange& change);

  private:
    /// A triangle that is made.
    struct Made {
        Facet facet;
        FloatBox box;
        glm::dvec3 normal; ///< of length 1, or 0
    };

    struct Slab {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        void add(double at) { low = std::min(low, at), high = std::max(high, at); }
        bool clear_of(const Slab& o, double by) const { return low > o.high + by || high < o.low - by; }
    };

    bool lives(const Surface& surface, std::uint32_t t) const;
    FloatBox box_of(const std::array<glm::dvec3, 3>& at) const;
    std::vector<BoxTree::Item> all_items(const Surface& surface) const;
    void build_tree(const Surface& surface);
    BoxTree::Item item_of(const Surface& surface, std::uint32_t t) const;
    /// The direction that all made triangles face, if there is one.
    std::optional<glm::dvec3> take_made(const Surface& surface, const SurfaceChange& change);
    Slab slab_of(const Surface& surface, const SurfaceChange& change, const glm::dvec3& direction) const;
    void bring_up_to_date(const Surface& surface, const FloatBox& box);
    void mark(const Surface& surface, const SurfaceChange& change);
    bool beyond(const Made& triangle, const Facet& other) const;
    bool meets(const Surface& surface, const SurfaceChange& change, const BoxTree::Item& other) const;
    bool meet_each_other(const Surface& surface, const SurfaceChange& change) const;

    bool is_closed = false;
    glm::dvec3 middle{0}; ///< boxes are relative to it
    Nearness nearness;
    FacingGrid grid;
    BoxTree tree;
    bool has_tree = false; ///< made when it is first needed
    /// Triangles that have changed, but not in the tree: for each cell of the grid a list of ranges of
    /// `changed`.
    struct Late {
        std::uint32_t first, count, next;
    };
    std::vector<std::uint32_t> changed;
    std::vector<Late> late;
    std::vector<std::uint32_t> first_late; ///< by cell
    std::size_t live = 0, built = 0;       ///< triangles now, and when the grid was made

    std::vector<std::uint32_t> triangle_mark, vertex_mark; ///< `marks`: replaced, a corner of what is made
    std::uint32_t marks = 0;
    std::vector<Made> made;
    FloatBox made_box;
    Facing faced = 0;                         ///< by all that is made
    std::vector<const BoxTree::Item*> others; ///< in the box of the change
};

} // namespace glcast
