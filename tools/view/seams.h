// A textured level as a graphics card wants it: one place, normal, coordinate and tangent a vertex. Internal.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/mesh/texture.h"

namespace glcast::view {

struct CutMesh {
    Mesh mesh; ///< no two-manifold any more: cut open along the seams of the texture
    std::vector<double> distance;
    std::vector<glm::vec2> coordinates;
    std::vector<glm::vec4> tangents;
};

/// Vertices whose corners differ in coordinate or tangent become several. `distance`: of each vertex. Throws
/// std::runtime_error where texture and mesh do not go together.
CutMesh cut_at_seams(const Mesh& mesh, std::span<const double> distance, const Texture& texture);

} // namespace glcast::view
