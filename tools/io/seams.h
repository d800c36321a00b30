// Vertices that we copied along seams when we wrote a file (tools/mesh/corner_split.h) become one again. Internal.
#pragma once
#include <span>

#include "tools/mesh/level.h"

namespace glcast::format {

/// What the last vertices of a mesh, those from `first` on, were before they were copied: by the numbers here.
struct Copies {
    std::size_t first = 0;             ///< of the vertices that they are about
    std::size_t count = 0;             ///< how many there were
    std::vector<std::uint32_t> of;     ///< for each vertex from `first` on, which of them it is
};
/// Of a mesh whose last vertices, `originals.size()` of them, are copies of earlier ones.
Copies copies_at_end(const Mesh& mesh, std::span<const std::uint32_t> originals);
/// Is each at one place with the others that it is said to be one with, and is there one of each? A file that was changed by others
/// may say anything.
bool are_copies(const Mesh& mesh, const Copies& copies);

/// Takes copies out of a mesh, and keeps the normals and colours that they have. A file may have several meshes, each
/// with copies at its end, that become one.
class CopyJoiner {
  public:
    /// The last vertices of the mesh so far, which must be copies.
    void join(Mesh& mesh, const Copies& copies);
    /// Once, when the mesh is whole: what was kept, for normals and colours that the mesh has.
    Wedges wedges(Mesh& mesh);

  private:
    CornerValues normals, colours; ///< of the triangles so far, once a copy differs from its original
};

} // namespace glcast::format
