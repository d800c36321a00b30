#include "capture/engine_target.h"

#include <algorithm>
#include <cstring>

namespace glcast {

bool has_extension(const GlTable& gl, const char* name) {
    const auto* all = reinterpret_cast<const char*>(gl.GetString(GL_EXTENSIONS));
    const std::size_t length = std::strlen(name);
    for (const char* at = all; at && (at = std::strstr(at, name)); at += length)
        if ((at == all || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0)) return true;
    return false;
}

namespace {

/// Signed colours need targets that hold them and clamps that can be switched off.
bool has_float_targets(const GlTable& gl) {
    return gl.ClampColor && has_extension(gl, "GL_ARB_color_buffer_float") &&
           has_extension(gl, "GL_ARB_texture_float");
}

/// The program's pixel paths are not for our reads.
void reset_pixel_state(const GlTable& gl) {
    constexpr GLenum zero[] = {GL_PACK_SWAP_BYTES,  GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH,
                               GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES,
                               GL_PACK_INVERT_MESA};
    for (GLenum name : zero) gl.PixelStorei(name, 0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    constexpr GLenum scales[] = {GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE, GL_DEPTH_SCALE};
    constexpr GLenum biases[] = {GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS, GL_DEPTH_BIAS};
    for (GLenum name : scales) gl.PixelTransferf(name, 1);
    for (GLenum name : biases) gl.PixelTransferf(name, 0);
    for (GLenum name : {GL_MAP_COLOR, GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET})
        gl.PixelTransferi(name, 0);
    if (gl.BindBuffer) gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

} // namespace

Target::Target(const GlTable& gl, int size, bool want_float) : gl(gl), pixels(size) {
    swallow_errors(gl);
    gl.GenFramebuffers(1, &framebuffer);
    gl.GenRenderbuffers(1, &colour_buffer);
    gl.GenRenderbuffers(1, &depth_buffer);
    const bool floats = want_float && has_float_targets(gl);
    for (GLenum colour : {GL_RGBA32F, GL_RGBA16F, GL_RGBA8}) {
        if (colour != GL_RGBA8 && !floats) continue;
        for (GLenum depth : {GL_DEPTH32F_STENCIL8, GL_DEPTH24_STENCIL8}) {
            framebuffer_complete = try_formats(colour, depth);
            framebuffer_float = framebuffer_complete && colour != GL_RGBA8;
            if (framebuffer_complete) return;
        }
    }
}

Target::~Target() {
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteRenderbuffers(1, &colour_buffer);
    gl.DeleteRenderbuffers(1, &depth_buffer);
}

bool Target::try_formats(GLenum colour_format, GLenum depth_format) {
    gl.BindRenderbuffer(GL_RENDERBUFFER, colour_buffer);
    gl.RenderbufferStorage(GL_RENDERBUFFER, colour_format, pixels, pixels);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth_buffer);
    gl.RenderbufferStorage(GL_RENDERBUFFER, depth_format, pixels, pixels);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_buffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_buffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_buffer);
    const bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    const bool clean = gl.GetError() == GL_NO_ERROR;
    swallow_errors(gl);
    return complete && clean;
}

void Target::bind() const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.DrawBuffer(GL_COLOR_ATTACHMENT0);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.Viewport(0, 0, pixels, pixels);
}

template <class Value>
void Target::read(std::vector<Value>& values, const std::optional<PixelRect>& only, GLenum format,
                  GLenum type) const {
    values.resize(std::size_t(pixels) * pixels);
    const PixelRect rect = only.value_or(PixelRect::whole(pixels));
    if (rect.empty()) return;
    reset_pixel_state(gl);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, pixels);
    Value* const first = values.data() + std::size_t(rect.y0) * pixels + rect.x0;
    gl.ReadPixels(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0, format, type, first);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
}

void Target::read_depth(std::vector<float>& depth, const std::optional<PixelRect>& only) const {
    read(depth, only, GL_DEPTH_COMPONENT, GL_FLOAT);
}

void Target::read_colour(std::vector<glm::vec4>& colour, const std::optional<PixelRect>& only) const {
    read(colour, only, GL_RGBA, GL_FLOAT);
}

void Target::read_stencil(std::vector<std::uint8_t>& stencil, const std::optional<PixelRect>& only) const {
    read(stencil, only, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE);
}

GlTable with_framebuffer_calls(GlTable gl) {
    if (!gl.BindFramebuffer) gl.BindFramebuffer = gl.BindFramebufferEXT;
    if (!gl.BindRenderbuffer) gl.BindRenderbuffer = gl.BindRenderbufferEXT;
    return gl;
}

bool has_framebuffer_calls(const GlTable& gl) {
    return gl.GenFramebuffers && gl.BindFramebuffer && gl.DeleteFramebuffers && gl.GenRenderbuffers &&
           gl.BindRenderbuffer && gl.DeleteRenderbuffers && gl.RenderbufferStorage &&
           gl.FramebufferRenderbuffer && gl.CheckFramebufferStatus;
}

int largest_target(const GlTable& gl) {
    GLint buffer = 0, viewport[2] = {};
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min({buffer, viewport[0], viewport[1]});
}

void swallow_errors(const GlTable& gl) {
    for (int i = 0; i < 64 && gl.GetError() != GL_NO_ERROR; ++i) {
    } // a lost context reports errors for ever
}

} // namespace glcast
