#include "shim/preload/stencil_events.h"

#include "capture/gl/gl_query.h"
#include "capture/program_stencil.h"

namespace glcast::preload {
namespace {

constexpr GLuint all_bits = 0xff;

StencilFace front_now(const GlTable& gl) {
    const auto get = [&](GLenum name) { return static_cast<GLuint>(get_int(gl, name)); };
    return {get(GL_STENCIL_FUNC),           get_int(gl, GL_STENCIL_REF), get(GL_STENCIL_VALUE_MASK),
            get(GL_STENCIL_WRITEMASK),      get(GL_STENCIL_FAIL),        get(GL_STENCIL_PASS_DEPTH_FAIL),
            get(GL_STENCIL_PASS_DEPTH_PASS)};
}

StencilFace back_now(const GlTable& gl) {
    const auto get = [&](GLenum name) { return static_cast<GLuint>(get_int(gl, name)); };
    return {get(GL_STENCIL_BACK_FUNC),           get_int(gl, GL_STENCIL_BACK_REF),
            get(GL_STENCIL_BACK_VALUE_MASK),     get(GL_STENCIL_BACK_WRITEMASK),
            get(GL_STENCIL_BACK_FAIL),           get(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
            get(GL_STENCIL_BACK_PASS_DEPTH_PASS)};
}

} // namespace

bool StencilFace::marks() const {
    const bool changes = (tests() && failed != GL_KEEP) || hidden != GL_KEEP || shown != GL_KEEP;
    return (writes & all_bits) && changes && function != GL_NEVER;
}

bool StencilFace::passes(int value) const {
    return passes_stencil(static_cast<int>(function), reference, bits, value);
}

StencilClear stencil_clear_now(const GlTable& gl, GLuint framebuffer) {
    StencilClear clear;
    clear.framebuffer = framebuffer;
    clear.is_scissored = gl.IsEnabled(GL_SCISSOR_TEST);
    if (clear.is_scissored) gl.GetIntegerv(GL_SCISSOR_BOX, clear.scissor.data());
    clear.value = get_int(gl, GL_STENCIL_CLEAR_VALUE) & static_cast<int>(all_bits);
    clear.writes = static_cast<GLuint>(get_int(gl, GL_STENCIL_WRITEMASK)) & all_bits;
    return clear;
}

StencilDraw stencil_draw_now(const GlTable& gl, std::size_t number) {
    StencilDraw draw;
    draw.draw = number;
    draw.front = front_now(gl);
    draw.back = gl.StencilOpSeparate ? back_now(gl) : draw.front;
    draw.tests_depth = gl.IsEnabled(GL_DEPTH_TEST);
    draw.depth_function = static_cast<GLenum>(get_int(gl, GL_DEPTH_FUNC));
    GLboolean mask[4] = {};
    gl.GetBooleanv(GL_COLOR_WRITEMASK, mask);
    draw.shows = mask[0] || mask[1] || mask[2];
    for (GLenum plane = 0; plane < 6; ++plane)
        draw.is_clipped |= gl.IsEnabled(GL_CLIP_PLANE0 + plane) == GL_TRUE;
    return draw;
}

} // namespace glcast::preload
