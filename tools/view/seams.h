// A level as a graphics card wants it: one place, normal, colour, coordinate and tangent a vertex. Internal.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast::view {

struct CutMesh {
    Mesh mesh; ///< no two-manifold any more: cut open along creases and the seams of the texture
    std::vector<double> distance;
    std::vector<glm::vec2> coordinates; ///< empty without a texture
    std::vector<glm::vec4> tangents;    ///< the same
};

/// Vertices whose corners differ become several. `distance`: of each vertex. Throws std::runtime_error where texture or
/// wedges and mesh do not go together.
CutMesh cut_at_seams(const Mesh& mesh, std::span<const double> distance, const Texture& texture,
                     const Wedges& wedges);

} // namespace glcast::view
