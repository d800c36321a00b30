// Sides of creases: triangles of a vertex that meet at small angles.
#pragma once
#include <cstdint>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::pictures {

struct Sides {
    std::vector<Triangle> of_corner; ///< by triangle: the side of each corner
    std::vector<glm::dvec3> normals; ///< by side: mean of its triangles, of length 1, or 0
    std::vector<glm::dvec3> middles; ///< by side: mean of the middles of its triangles
    std::vector<std::uint32_t> vertex;
};

/// Two triangles at an edge are on one side where their normals' cosine is more than `least`. Vertices count
/// as one by their number.
Sides sides_of_creases(const Mesh& mesh, double least);

} // namespace glcast::pictures
