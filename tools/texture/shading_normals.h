// Normals that a level can be shaded with: those that a normal map is made for, and those of wedges.
#pragma once
#include "tools/mesh/wedges.h"
#include "tools/texture/neighbours.h"

namespace glcast {

/// A vertex keeps the normal that it has where that is within 60 degrees of every triangle around it, or of
/// the backs of all; else, as at a sharp edge, where it is the normal of one side, it gets the mean of the
/// triangles, weighted by angle (Thürmer and Wüthrich 1998), turned until it is within 60 degrees of all of
/// them or as near to that as can be (Aubry and Löhner 2008), so that every normal around it can be written
/// in its tangent frame. What then points inward, joined to what does not, is turned about, as on a closing
/// that has the normals of what lies behind it (behind.h); a body with all normals inward keeps them. One
/// normal for all corners of a vertex: seams of the atlas are no seams of the shading.
void make_shading_normals(Mesh& mesh, const Neighbours& neighbours,
                          const std::vector<glm::vec3>& triangle_normals);

/// No normal of a wedge is further than `degrees` from the mean of its triangles, by area, or turned towards it until it
/// is not. Corners whose own triangle is still further from it, as slivers are that lie across, become wedges of their
/// own. What points inward, further from the mean than 180 - `degrees`, stays inward and is bounded likewise.
void bound_normals(const Mesh& mesh, Wedges& wedges, const std::vector<glm::vec3>& triangle_normals, double degrees);

/// The same for wedges that a normal map is made for; and what then points inward, joined to what does not, is turned
/// about.
void make_shading_normals(const Mesh& mesh, const Neighbours& neighbours, Wedges& wedges,
                          const std::vector<glm::vec3>& triangle_normals);

} // namespace glcast
