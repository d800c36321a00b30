// What simplification did, step by step: the road from a mesh to every coarser one, and back.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

/// Vertex `removed` is merged into vertex `kept`, which takes the position, colour and normal given. Triangles that had
/// both go. Vertices are named by their index in the mesh that the log begins with.
struct Collapse {
    std::uint32_t kept = 0, removed = 0;
    glm::dvec3 position{0};
    glm::vec3 colour{0}, normal{0}; ///< left out of account where the mesh has none
};

/// In the order in which they were made.
using CollapseLog = std::vector<Collapse>;

/// The mesh after the first `count` collapses of the log: vertices and triangles that are left, in their first order,
/// each triangle beginning with the corner that it began with. What is left of the log leads on from there, once its
/// names are changed. Throws std::runtime_error where the log is not one of this mesh.
Mesh collapsed(const Mesh& mesh, std::span<const Collapse> log, std::size_t count);

} // namespace glcast
