// A texture atlas laid over a mesh.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "tools/mesh/picture.h"

namespace glcast {

/// Coordinates and tangents belong to corners of triangles, not to vertices, so that the mesh stays the two-manifold
/// that it is; a file format that wants them per vertex splits vertices along seams when it writes. Both pictures
/// have one size and one layout.
struct Texture {
    std::vector<std::array<glm::vec2, 3>> coordinates; ///< per triangle; (0, 0) is the top left of the pictures, as in glTF
    /// Per triangle: direction of growing x of the picture, square to the vertex normal, as MikkTSpace has it; w = +1 or
    /// -1: bitangent = w * cross(normal, tangent).
    std::vector<std::array<glm::vec4, 3>> tangents;
    Picture colour; ///< display values (sRGB), without light
    Picture normal; ///< tangent space, (n + 1) / 2, +y is the bitangent (up in the picture, as glTF wants it)

    bool empty() const { return coordinates.empty(); }
};

} // namespace glcast
