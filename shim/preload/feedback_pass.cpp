#include "shim/preload/feedback_pass.h"

#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <stdexcept>

#include "capture/engine_pass.h"
#include "capture/engine_target.h"

namespace glcast::preload {
namespace {

constexpr std::size_t first_feedback = 1 << 20, most_feedback = std::size_t(1) << 28; // floats
constexpr int pixels = 64; // nothing is rasterised; window coordinates are not rounded

} // namespace

FeedbackLattice::FeedbackLattice(const Box& box)
    : to_capture(glm::inverse(lattice_projection(box, Axis::z))) {}

glm::dvec3 FeedbackLattice::point(const GLfloat* v) const {
    const glm::dvec4 clip(2.0 * v[0] / pixels - 1, 2.0 * v[1] / pixels - 1, 2.0 * v[2] - 1, 1);
    return glm::dvec3(to_capture * clip);
}

std::vector<GLfloat> feed_back(const GlTable& real, const DrawFunction& draw, const EngineOptions& options,
                               GLenum type) {
    const GlTable gl = with_framebuffer_calls(real);
    const Target target(gl, pixels, false);
    if (!target.complete()) return {};
    Pass pass;
    pass.box = *options.box;
    std::vector<GLfloat> values(first_feedback);
    for (;;) {
        GLint used = 0;
        const DrawFunction listen = [&](const GlTable& table) {
            gl.FeedbackBuffer(static_cast<GLsizei>(values.size()), type, values.data());
            gl.RenderMode(GL_FEEDBACK);
            draw(table);
            used = gl.RenderMode(GL_RENDER);
        };
        PassRunner(gl, listen, options).run(pass, target);
        if (used >= 0) {
            values.resize(static_cast<std::size_t>(used));
            return values;
        }
        if (values.size() >= most_feedback) throw std::runtime_error("GL feeds back too much of the frame");
        values.resize(values.size() * 4);
    }
}

} // namespace glcast::preload
