// All that a draw function draws inside a box, asked of GL by feedback: in whatever way it is drawn, and
// nothing is rasterised.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "capture/engine.h"

namespace glcast::preload {

/// From the window coordinates of a feedback pass to the capture frame.
class FeedbackLattice {
  public:
    explicit FeedbackLattice(const Box& box);
    glm::dvec3 point(const GLfloat* window) const;

  private:
    glm::dmat4 to_capture;
};

/// The values of `draw` inside `options.box`, in the current context; `type`: GL_3D, GL_3D_COLOR, ... Throws
/// std::runtime_error where they need more than a gigabyte.
std::vector<GLfloat> feed_back(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options,
                               GLenum type);

} // namespace glcast::preload
