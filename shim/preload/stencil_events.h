// What a frame does to the stencil buffer, in the order of the frame.
#pragma once
#include <array>
#include <cstddef>
#include <variant>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

struct StencilClear {
    GLuint framebuffer = 0;
    bool is_scissored = false;
    std::array<GLint, 4> scissor{};
    int value = 0;
    GLuint writes = 0xff; ///< the bits that are cleared
};

/// Test and operations of one side of the faces.
struct StencilFace {
    GLenum function = GL_ALWAYS;
    GLint reference = 0;
    GLuint bits = ~0u;   ///< that are compared
    GLuint writes = ~0u; ///< that may change
    GLenum failed = GL_KEEP, hidden = GL_KEEP, shown = GL_KEEP;

    bool tests() const { return function != GL_ALWAYS; }
    bool marks() const;
    bool passes(int value) const;
};

/// A draw with the stencil test on.
struct StencilDraw {
    std::size_t draw = 0; ///< index into Scene::draws
    StencilFace front, back;
    bool tests_depth = false;
    GLenum depth_function = GL_LESS;
    bool shows = true;       ///< it writes colours
    bool is_clipped = false; ///< by the program's clip planes
};

using StencilEvent = std::variant<StencilClear, StencilDraw>;

/// Of the state of a context, outside of glBegin.
StencilClear stencil_clear_now(const GlTable& gl, GLuint framebuffer);
StencilDraw stencil_draw_now(const GlTable& gl, std::size_t draw);

} // namespace glcast::preload
