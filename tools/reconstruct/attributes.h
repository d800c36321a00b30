// Colour and normal of each vertex, from the pixels that saw it.
// Natvig 2006, section 4: "we always check the actual depth of captured color information".
#pragma once
#include "tools/mesh/mesh.h"
#include "tools/reconstruct/rays.h"

namespace glcast {

struct Attribute {
    glm::vec3 colour{0};
    glm::vec3 normal{0}; ///< unit, as drawn; 0: none was drawn
    glm::vec3 plane{0};  ///< unit normal of the tangent planes, on the side of the surface's
    bool found = false;
};

/// What the view that faces the surface most squarely, and agrees, saw at a point of it; in samples. Bilinear
/// among the pixels that agree.
Attribute sample_point(const Rays& rays, const glm::dvec3& at, const glm::vec3& surface_normal);

/// What came of it.
struct Sampled {
    std::size_t missing = 0;              ///< vertices that no pixel agrees with
    double disagreeing_normals_share = 0; ///< ReconstructReport::disagreeing_normals_share
};

/// Fills normals (unit) and colours of a contour; positions in samples. Where no pixel agrees with vertices
/// that close an opening, they have colour and normal of what lies behind it (behind.h);
/// else their colour is the nearest one along the surface, their normal that of the surface.
Sampled sample_vertices(const Rays& rays, Mesh& mesh, bool geometric_normals);

/// The same for the paper's squares (triangles 2 q and 2 q + 1 are square q): a square has the colour and
/// normal of its pixel, a vertex the mean of its squares.
Sampled sample_squares(const Rays& rays, Mesh& mesh, bool geometric_normals);

} // namespace glcast
