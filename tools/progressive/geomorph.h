// From one level of a progressive mesh to a finer one without a jump (Hoppe 1996, 3.2): "it is possible to
// gradually split a vertex".
#pragma once
#include "tools/progressive/progressive_mesh.h"

namespace glcast {

/// The triangles of the finer level, whose vertices go from where their ancestors are in the coarser one to
/// their own place; colours and normals go with them.
class Geomorph {
  public:
    /// Levels of `mesh`, coarse <= fine <= splits(); the mesh comes back at the level that it was at.
    /// Throws std::runtime_error, one line, on other levels.
    Geomorph(ProgressiveMesh& mesh, std::size_t coarse, std::size_t fine);

    /// 0: looks exactly like the coarser level: vertices that are one there are in one place here, and the
    /// triangles that are not there have no area; all others are those of the coarser level, in its order. 1:
    /// the finer level, bit for bit. Between, positions and colours are in proportion, normals too, then made
    /// unit length. Throws std::runtime_error where the fraction is not 0..1.
    Mesh at(double fraction) const;

    /// For each vertex of at(), the vertex of the coarser level that it comes from, by its index there.
    const std::vector<std::uint32_t>& ancestors() const { return ancestor; }

  private:
    Mesh from, to; ///< the coarser level; the finer one
    std::vector<std::uint32_t> ancestor;
};

} // namespace glcast
