// Vertices that we copied along seams when we wrote a file (tools/mesh/corner_split.h) become one again. Internal.
#pragma once
#include <span>

#include "tools/mesh/level.h"

namespace glcast::format {

/// Does `originals` name, for each of the last vertices, an earlier one at the same place? A file that was
/// changed by others may say anything.
bool are_copies(const Mesh& mesh, std::span<const std::uint32_t> originals);

/// Takes copies out of a mesh, and keeps the normals and colours that they have. A file may have several meshes, each
/// with copies at its end, that become one.
class CopyJoiner {
  public:
    /// The last vertices of the mesh so far, which must be copies.
    void join(Mesh& mesh, std::span<const std::uint32_t> originals);
    /// Once, when the mesh is whole: what was kept, for normals and colours that the mesh has.
    Wedges wedges(Mesh& mesh);

  private:
    CornerValues normals, colours; ///< of the triangles so far, once a copy differs from its original
};

} // namespace glcast::format
