// The axes of the capture: those of the model where they can be told, never mirrored against the screen.
#pragma once
#include <glm/mat4x4.hpp>
#include <optional>

#include "shim/preload/options.h"

namespace glcast::preload {

/// What the program's view tells about the axes.
struct ViewAxes {
    std::optional<glm::dmat4> base_modelview;
    bool mirrored = false; ///< the window shows the mirror image of eye space
};

/// From eye space to the capture frame: a similarity, or one with a reflection where the screen shows eye
/// space mirrored. Throws std::runtime_error where the options ask for what cannot be.
glm::dmat4 choose_eye_to_capture(const ViewAxes& view, const Options& options);

} // namespace glcast::preload
