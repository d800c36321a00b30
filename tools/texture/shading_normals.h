// The vertex normals that a normal map is made for.
#pragma once
#include "tools/texture/neighbours.h"

namespace glcast {

/// A vertex keeps the normal that it has where that is within 60 degrees of every triangle around it, or of
/// the backs of all; else, as at a sharp edge, where it is the normal of one side, it gets the mean of the
/// triangles, weighted by angle (Thürmer and Wüthrich 1998), so that every normal around it can be written in
/// its tangent frame. What then points inward, joined to what does not, is turned about, as on a closing that
/// has the normals of what lies behind it (behind.h); a body with all normals inward keeps them. One normal
/// for all corners of a vertex: seams of the atlas are no seams of the shading.
void make_shading_normals(Mesh& mesh, const Neighbours& neighbours,
                          const std::vector<glm::vec3>& triangle_normals);

} // namespace glcast
