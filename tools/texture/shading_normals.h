// Normals that a level can be shaded with: those that a normal map is made for, and those of wedges.
#pragma once
#include "tools/mesh/wedges.h"
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

/// Turns normals of wedges that are further than `degrees` from a triangle of theirs towards it, until they are not. What
/// points inward, further from it than 180 - `degrees`, stays inward and is bounded likewise.
void bound_normals(const Mesh& mesh, const Neighbours& neighbours, Wedges& wedges,
                   const std::vector<glm::vec3>& triangle_normals, double degrees);

/// The same for wedges that a normal map is made for; and what then points inward, joined to what does not, is turned
/// about.
void make_shading_normals(const Mesh& mesh, const Neighbours& neighbours, Wedges& wedges,
                          const std::vector<glm::vec3>& triangle_normals);

} // namespace glcast
