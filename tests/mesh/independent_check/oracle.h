// Whether a mesh is a closed two-manifold, in the opinion of code that we did not write: OpenMesh's half-edge
// mesh takes only what is one.
#pragma once
#include <filesystem>
#include <string>

#include "tools/mesh/mesh.h"

namespace glcast::test {

struct OracleOpinion {
    std::size_t vertices = 0, edges = 0, triangles = 0; ///< as OpenMesh holds them
    std::string fault;                                  ///< empty: a closed two-manifold
};

OracleOpinion ask_oracle(const Mesh& mesh);
/// .obj, .off, .ply by OpenMesh's own readers.
OracleOpinion ask_oracle(const std::filesystem::path& file);

} // namespace glcast::test
