// Files and graphics cards want normals, colours and texture coordinates per vertex, a level has them per corner:
// vertices are copied where their corners differ.
#pragma once
#include "tools/mesh/level.h"

namespace glcast {

/// The vertices of the mesh, with one set of values each, and behind them copies for the corners that have others.
struct CornerSplit {
    std::vector<std::uint32_t> originals;     ///< for every copy, in order, the vertex that it copies
    std::vector<glm::vec3> normals, colours;  ///< of vertices, then copies; empty without wedges of them
    std::vector<glm::vec2> coordinates;       ///< of vertices, then copies; empty without a texture
    std::vector<glm::vec4> tangents;          ///< the same; a texture without tangents has (1, 0, 0, 1)
    std::vector<Triangle> triangles;

    std::size_t vertices(const Mesh& mesh) const { return mesh.positions.size() + originals.size(); }
    /// Of the mesh, for a vertex or a copy.
    std::uint32_t original(const Mesh& mesh, std::size_t vertex) const {
        return vertex < mesh.positions.size() ? std::uint32_t(vertex) : originals[vertex - mesh.positions.size()];
    }
    const glm::vec3& normal(const Mesh& mesh, std::size_t vertex) const {
        return normals.empty() ? mesh.normals[original(mesh, vertex)] : normals[vertex];
    }
    const glm::vec3& colour(const Mesh& mesh, std::size_t vertex) const {
        return colours.empty() ? mesh.colours[original(mesh, vertex)] : colours[vertex];
    }
};

/// Throws std::runtime_error where texture or wedges are not those of the mesh.
CornerSplit split_corners(const Mesh& mesh, const Texture& texture, const Wedges& wedges);

} // namespace glcast
