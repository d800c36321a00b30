// Rotation, translation and one scale: the transforms that keep shapes.
#pragma once
#include <glm/mat4x4.hpp>

namespace glcast::preload {

/// To `tolerance`, relative to the scale; mirrored ones are not counted.
bool is_similarity(const glm::dmat4& matrix, double tolerance = 1e-4);

} // namespace glcast::preload
