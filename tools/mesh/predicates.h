// On which side of a plane or a line a point lies, without rounding (Shewchuk 1997, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates"). Coordinates must be finite and of a size
// whose cubes neither overflow nor vanish.
#pragma once
#include <glm/vec3.hpp>

namespace glcast {

/// Sign of det(b - a, c - a, d - a): +1 when d sees a, b, c counter-clockwise, -1 clockwise, 0 on their
/// plane.
int orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Sign of the area of a, b, c seen along axis `drop` (from its plus side).
int orient2d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int drop);

} // namespace glcast
