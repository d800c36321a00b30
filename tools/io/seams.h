// Texture coordinates belong to corners, in glTF to vertices: vertices are copied along seams, and joined
// again. Internal.
#pragma once
#include <span>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast::format {

/// The vertices of the mesh, one set of coordinates each, and behind them copies for the corners that have
/// others.
struct SeamSplit {
    std::vector<std::uint32_t> originals; ///< for every copy, in order, the vertex that it copies
    std::vector<glm::vec2> coordinates;   ///< of vertices, then copies; empty without a texture
    std::vector<glm::vec4> tangents;      ///< the same
    std::vector<Triangle> triangles;

    std::size_t vertices(const Mesh& mesh) const { return mesh.positions.size() + originals.size(); }
    /// Of the mesh, for a vertex or a copy.
    std::uint32_t original(const Mesh& mesh, std::size_t vertex) const {
        return vertex < mesh.positions.size() ? std::uint32_t(vertex)
                                              : originals[vertex - mesh.positions.size()];
    }
};

SeamSplit split_along_seams(const Level& level);

/// Does `originals` name, for each of the last vertices, an earlier one at the same place? A file that was
/// changed by others may say anything.
bool are_copies(const Mesh& mesh, std::span<const std::uint32_t> originals);

/// Takes the copies out of the mesh. They must be copies.
void join_copies(Mesh& mesh, std::span<const std::uint32_t> originals);

} // namespace glcast::format
