// Tangent planes at the hits: the captured normal where the depths bear it out, else fitted to the depths.
#pragma once
#include <glm/vec3.hpp>

#include "tools/reconstruct/rays.h"

namespace glcast {

/// Unit vector in 32 bits (octahedral, 3e-5 radians); never 0.
std::uint32_t pack_normal(const glm::vec3& unit);
glm::vec3 unpack_normal(std::uint32_t packed);

/// Fills AxisRays::plane.
void find_planes(Rays& rays);

} // namespace glcast
