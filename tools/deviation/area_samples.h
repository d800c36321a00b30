// Points spread evenly over a surface, and where in it they lie. Internal.
#pragma once
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

struct AreaSample {
    glm::dvec3 position{0}, normal{0}; ///< the unit normal of the triangle
    std::uint32_t triangle = 0;
    glm::dvec3 weights{1, 0, 0}; ///< of its corners
};

/// Spread by area, in the order of the triangles, always the same ones. None on a mesh without area.
std::vector<AreaSample> area_samples(const Mesh& mesh, std::size_t samples);

} // namespace glcast
