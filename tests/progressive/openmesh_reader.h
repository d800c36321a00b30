// OpenMesh's .pm read as its ProgViewer reads it, and refined by OpenMesh's own vertex split. Nothing of
// glcast's writer.
#pragma once
#include <string_view>

#include "tools/mesh/mesh.h"

namespace glcast::test {

struct OpenMeshRefined {
    std::size_t base_vertices = 0, base_triangles = 0, splits = 0;
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;
    bool manifold = false; ///< by OpenMesh's mesh checker
};

/// After `splits` of them, or all. Throws std::runtime_error where the file is not one, or a split is not one
/// of the mesh.
OpenMeshRefined refined_by_openmesh(std::string_view file, std::size_t splits = SIZE_MAX);

/// What OpenMesh's decimater makes of a mesh with its ModProgMesh: the .pm file that it writes.
void write_by_openmesh(const Mesh& mesh, std::size_t vertices, const std::string& path);

} // namespace glcast::test
