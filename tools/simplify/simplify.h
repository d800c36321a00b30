// Quadric edge collapse (Garland and Heckbert 1997; colours and normals: Hoppe 1999), and a fit of what is
// left.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "tools/mesh/check.h"
#include "tools/mesh/mesh.h"
#include "tools/simplify/collapse_log.h"

namespace glcast {

struct SimplifyTarget {
    enum class Unit { edges, triangles, ratio } unit = Unit::triangles;
    double value = 0; ///< ratio: share of the triangles to keep, 0..1
};

/// How much work a fit may be: `little` is a tenth of it, for levels that stand by their 99.9 % error.
enum class FitWork { none, little, full };

struct SimplifyOptions {
    /// A two-manifold with boundaries is taken too; they keep their shape as far as the target allows.
    bool allow_boundaries = false;
    /// After the collapses, lay each level as well as it goes along the surface (Hoppe et al. 1993): about
    /// half the error. Without, levels are what a progressive mesh holds.
    bool refit = true;
    /// How far a surface may as well be off as have a colour (channel, 0..1) or a normal (component) that is
    /// off by 1: shares of the longest side of the mesh's box. 0: not looked at. A normal's, where it is not
    /// given: what leaves the least error, with and without the fit (docs/design/method.md, "Levels").
    double colour_weight = 0.002;
    std::optional<double> normal_weight = {};
    /// What check_mesh() says of the mesh, where that is known already.
    const MeshCheck* checked = nullptr;
    /// Called once, where most is done: what is left needs one core for the most part and little memory, and
    /// reads mesh.normals no more. Something else may begin beside it.
    std::function<void()> last_stretch = {};
};

/// A closed two-manifold with at most the asked number of edges or triangles, or as few as collapses that
/// keep it manifold, and from passing through itself where it did not, allow; colours and normals follow the
/// surface. Needs a closed two-manifold: throws std::runtime_error on anything else, and on a target below 0
/// or a ratio above 1. Where the mesh is small enough already it comes back as it is. Every colour is one
/// that the mesh has. The same mesh gives the same result, bit for bit, on any number of threads.
Mesh simplify(const Mesh& mesh, const SimplifyTarget& target, const SimplifyOptions& options = {});

/// A mesh per target, in the order of the targets, made by one run of collapses from fine to coarse: as much
/// work as the coarsest alone. `log`, if given, takes all collapses down to the coarsest target: without
/// refit each level is collapsed(mesh, log, k) bit for bit, k the first number that meets its target.
std::vector<Mesh> simplify_levels(const Mesh& mesh, std::span<const SimplifyTarget> targets,
                                  const SimplifyOptions& options = {}, CollapseLog* log = nullptr);

/// One run of collapses, from which levels are taken at whatever counts are asked for, in any order: for who
/// looks for a count. Each is what simplify() gives for that count.
class Simplification {
  public:
    /// `mesh` must be a closed two-manifold, and outlive this, unchanged. Throws std::runtime_error as
    /// simplify() does. last_stretch and checked of the options as there.
    Simplification(const Mesh& mesh, const SimplifyOptions& options = {});
    ~Simplification();

    void collapse_to(std::size_t triangles); ///< no more than so many, or as few as collapses can leave
    std::size_t least() const;               ///< triangles that are left

    /// A level with at most so many triangles, not fewer than least(). Levels may be taken on several threads
    /// at once, but not while collapse_to() runs. One so fine that a part of the run would have to be undone
    /// for it is made by a run of its own. Laid along the surface with so much work, where the options say
    /// so; without, in some milliseconds.
    Mesh level(std::size_t triangles, FitWork fit = FitWork::full) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace glcast
