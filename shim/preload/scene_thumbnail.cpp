#include "shim/preload/scene_thumbnail.h"

#include <algorithm>

#include "capture/engine_target.h"
#include "shim/preload/ignored_calls.h"

namespace glcast::preload {
namespace {

constinit thread_local const GlTable* real = nullptr;
constinit thread_local bool culls = true; ///< the program may

bool is_ours(GLenum cap) {
    return (cap == GL_CULL_FACE && !culls) || cap == GL_SCISSOR_TEST || cap == GL_STENCIL_TEST ||
           cap == GL_FRAMEBUFFER_SRGB || cap == GL_DITHER;
}
void APIENTRY enable(GLenum cap) {
    if (!is_ours(cap)) real->Enable(cap);
}
void APIENTRY disable(GLenum cap) {
    if (!is_ours(cap)) real->Disable(cap);
}
void APIENTRY push_attrib(GLbitfield mask) {
    real->PushAttrib(mask & ~GLbitfield(GL_VIEWPORT_BIT | GL_SCISSOR_BIT | GL_STENCIL_BUFFER_BIT));
}

using G = GlTable;

} // namespace

GlTable picture_table(const GlTable& gl, bool program_culls) {
    real = &gl;
    culls = program_culls;
    GlTable table = gl;
    ignore<&G::Viewport, &G::Scissor, &G::StencilFunc, &G::StencilOp, &G::StencilMask,
           &G::StencilFuncSeparate, &G::StencilOpSeparate, &G::StencilMaskSeparate, &G::Clear, &G::ClearColor,
           &G::ClearDepth, &G::ClearStencil, &G::DrawBuffer, &G::DrawBuffers, &G::ReadBuffer,
           &G::BindFramebuffer, &G::BindFramebufferEXT, &G::BlitFramebuffer, &G::BlitFramebufferEXT,
           &G::DeleteFramebuffers, &G::DeleteFramebuffersEXT, &G::Accum, &G::ColorMask, &G::CopyTexImage1D,
           &G::CopyTexImage2D, &G::CopyTexSubImage1D, &G::CopyTexSubImage2D, &G::CopyTexSubImage3D,
           &G::ReadPixels, &G::Flush, &G::Finish, &G::RenderMode>(table);
    table.Enable = enable;
    table.Disable = disable;
    table.PushAttrib = push_attrib;
    return table;
}

namespace {

void prepare(const GlTable& gl, const Target& target, int width, int height, bool depth_reversed) {
    target.bind();
    gl.Viewport(0, 0, width, height);
    for (const GLenum cap : {GL_SCISSOR_TEST, GL_DITHER}) gl.Disable(cap);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_ALWAYS, 1, ~0u);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl.StencilMask(~0u);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.ClearColor(0.5f, 0.5f, 0.5f, 0);
    gl.ClearDepth(depth_reversed ? 0 : 1);
    gl.ClearStencil(0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void read(const GlTable& gl, const Target& target, Thumbnail& thumbnail) {
    const int n = target.size();
    std::vector<glm::vec4> colour;
    std::vector<float> depth;
    target.read_colour(colour);
    target.read_depth(depth);
    std::vector<GLubyte> drawn(std::size_t(n) * n);
    gl.ReadPixels(0, 0, n, n, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, drawn.data());
    float nearest = 1, furthest = 0;
    long covered = 0;
    for (int y = 0; y < thumbnail.height; ++y) {
        for (int x = 0; x < thumbnail.width; ++x) {
            const std::size_t at = std::size_t(y) * n + x;
            for (int channel = 0; channel < 3; ++channel)
                thumbnail.rgb.push_back(
                    std::uint8_t(std::clamp(colour[at][channel], 0.0f, 1.0f) * 255 + 0.5f));
            if (!drawn[at]) continue;
            ++covered;
            nearest = std::min(nearest, depth[at]), furthest = std::max(furthest, depth[at]);
        }
    }
    thumbnail.coverage = double(covered) / (double(thumbnail.width) * thumbnail.height);
    thumbnail.flat = covered > 0 && furthest - nearest < 1e-6f;
}

} // namespace

PictureSize::PictureSize(const std::array<GLint, 4>& viewport, int longer_side) {
    const int longer = std::max({viewport[2], viewport[3], 1});
    width = std::clamp(longer_side * viewport[2] / longer, 1, longer_side);
    height = std::clamp(longer_side * viewport[3] / longer, 1, longer_side);
}

Thumbnail draw_thumbnail(const GlTable& gl, const DrawFunction& draw, const std::array<GLint, 4>& viewport,
                         bool depth_reversed, int size) {
    Thumbnail thumbnail;
    const GlTable calls = with_framebuffer_calls(gl);
    if (!has_framebuffer_calls(calls)) return thumbnail;
    const PictureSize picture(viewport, size);
    thumbnail.width = picture.width;
    thumbnail.height = picture.height;
    const Target target(calls, size, false);
    if (!target.complete()) return thumbnail;
    prepare(calls, target, thumbnail.width, thumbnail.height, depth_reversed);
    draw(picture_table(calls));
    gl.Finish();
    target.bind();
    read(calls, target, thumbnail);
    swallow_errors(gl);
    return thumbnail;
}

DepthPicture draw_depths(const GlTable& gl, const DrawFunction& draw, const std::array<GLint, 4>& viewport,
                         bool program_culls, int size, bool nearest) {
    DepthPicture picture;
    const GlTable calls = with_framebuffer_calls(gl);
    const Target target(calls, size, false);
    if (!target.complete()) return picture;
    const PictureSize sides(viewport, size);
    picture.width = sides.width;
    picture.height = sides.height;
    picture.stride = size;
    prepare(calls, target, sides.width, sides.height, false);
    gl.Disable(GL_CULL_FACE);
    GlTable table = picture_table(calls, program_culls);
    ignore<&G::DepthMask>(table);
    if (nearest) {
        gl.DepthFunc(GL_LESS);
        ignore<&G::DepthFunc>(table);
    }
    draw(table);
    gl.Finish();
    target.bind();
    target.read_depth(picture.depth);
    swallow_errors(gl);
    return picture;
}

} // namespace glcast::preload
