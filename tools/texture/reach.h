// How far from a level its surface is looked for. Internal.
#pragma once
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast {

/// Samples: what most of the level's triangles need, and as much again. Farther off are other parts of the
/// scene. `normals`: of the triangles.
double needed_reach(const Mesh& mesh, const CapturedSurface& captured, const std::vector<glm::vec3>& normals);

} // namespace glcast
