// Colour and normal of each vertex, from the pixels that saw it.
// Natvig 2006, section 4: "we always check the actual depth of captured color information".
#pragma once
#include "tools/mesh/mesh.h"
#include "tools/reconstruct/rays.h"

namespace glcast {

/// Fills normals (unit) and colours of a contour; positions in samples. Returns how many vertices no pixel
/// agrees with: their colour is the nearest one along the surface, their normal that of the surface.
std::size_t sample_vertices(const Rays& rays, Mesh& mesh, bool geometric_normals);

/// The same for the paper's squares (triangles 2 q and 2 q + 1 are square q): a square has the colour and
/// normal of its pixel, a vertex the mean of its squares.
std::size_t sample_squares(const Rays& rays, Mesh& mesh, bool geometric_normals);

} // namespace glcast
