// The axes of the capture: those of the model where they can be told, never mirrored against the screen.
#pragma once
#include <glm/mat4x4.hpp>
#include <optional>

#include "shim/preload/options.h"

namespace glcast::preload {

/// What the program's view tells about the axes.
struct ViewAxes {
    std::optional<glm::dmat4> base_modelview;
    bool mirrored = false; ///< the screen shows the mirror image of eye space (see is_mirrored)
};

/// From eye space to the capture frame: a similarity, or one with a reflection where the screen shows eye
/// space mirrored. Throws std::runtime_error where the options ask for what cannot be.
glm::dmat4 choose_eye_to_capture(const ViewAxes& view, const Options& options);

/// Does what is drawn appear mirrored? glFrustum and glOrtho turn eye space into a left-handed one, so their
/// determinant is negative; a scale by -1, or a left-handed projection as other graphics systems have, makes it
/// positive. `depth_reversed`: the greater depth is in front (GL_GREATER, or glDepthRange(1, 0)), which turns the
/// viewer round.
bool is_mirrored(const glm::dmat4& projection, bool depth_reversed);

} // namespace glcast::preload
