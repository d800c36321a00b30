// Which corners of a vertex are one wedge. Internal.
#pragma once
#include "tools/texture/face_sums.h"
#include "tools/texture/neighbours.h"

namespace glcast {

/// Corners of one vertex are joined while what is shown there, over their triangles, agrees to this.
struct JoinLimits {
    double degrees; ///< between normals
    double colour;  ///< of a channel
};

/// By triangle, the wedge of each corner, numbered by vertex; `wedges`: how many there are. Corners of a vertex are
/// joined in pairs of groups, those that agree best first, by the means of groups; one over whose triangle nothing is shown
/// goes to the group that faces most as the triangle does. `normals`: of the triangles.
std::vector<Triangle> group_corners(const Mesh& mesh, const Neighbours& neighbours,
                                    const std::vector<FaceSums>& faces, const std::vector<glm::vec3>& normals,
                                    const JoinLimits& limits, std::uint32_t& wedges);

} // namespace glcast
