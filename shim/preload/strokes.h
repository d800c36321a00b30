// Lines and points made solid: what GL would draw of them, as prisms and cubes about a sample wide.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "capture/engine.h"

namespace glcast::preload {

/// A line, or a point where both ends are one. Capture frame.
struct Stroke {
    glm::dvec3 from, to;
    glm::vec4 from_colour, to_colour;
};

/// All lines and points that `draw` draws inside `options.box`, found by GL's feedback mode: so in whatever way
/// they are drawn. In the current context.
std::vector<Stroke> collect_strokes(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options);

/// Draws them through `gl`, 2 `half_width` thick, in their own colours and whatever state was left behind.
void draw_strokes(const std::vector<Stroke>& strokes, double half_width, const glm::dmat4& eye_to_capture,
                  const GlTable& gl);

} // namespace glcast::preload
