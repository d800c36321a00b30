#include "shim/preload/way_to_window.h"

#include <algorithm>

namespace glcast::preload {
namespace {

/// The textures that a framebuffer draws into, where this context can see it.
std::vector<GLuint> attached_textures(GLuint framebuffer, const GlTable& gl) {
    std::vector<GLuint> textures;
    if (!gl.IsFramebuffer || !gl.GetFramebufferAttachmentParameteriv || !gl.BindFramebuffer) return textures;
    if (!gl.IsFramebuffer(framebuffer)) return textures;
    constexpr GLenum most = 8;
    GLint bound = 0, count = 1;
    gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
    gl.GetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &count);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    for (GLenum i = 0; i < std::min(most, static_cast<GLenum>(std::max(count, 0))); ++i) {
        GLint type = GL_NONE, name = 0;
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + i;
        gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment,
                                               GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
        if (type != GL_TEXTURE) continue;
        gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment,
                                               GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
        textures.push_back(static_cast<GLuint>(name));
    }
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
    return textures;
}

} // namespace

void WayToWindow::blit(GLuint from, GLuint to, const BlitRect& source, const BlitRect& target) {
    const auto turns = [&](std::size_t axis) {
        return (source[axis + 2] < source[axis]) != (target[axis + 2] < target[axis]);
    };
    if (from != to) steps.push_back({false, from, to, turns(0) != turns(1)});
}

void WayToWindow::show_texture(GLuint texture, GLuint to, bool mirrored) {
    steps.push_back({true, texture, to, mirrored});
}

std::optional<bool> WayToWindow::mirrors(GLuint framebuffer, const GlTable& gl) const {
    bool mirrored = false;
    for (std::size_t step = 0; framebuffer != 0; ++step) {
        if (step > steps.size()) return std::nullopt; // round and round
        const std::vector<GLuint> textures = attached_textures(framebuffer, gl);
        const auto leaves = [&](const Step& s) {
            if (s.to == framebuffer) return false;
            if (!s.is_texture) return s.from == framebuffer;
            return std::find(textures.begin(), textures.end(), s.from) != textures.end();
        };
        const auto last = std::find_if(steps.rbegin(), steps.rend(), leaves);
        if (last == steps.rend()) return std::nullopt;
        mirrored ^= last->mirrored;
        framebuffer = last->to;
    }
    return mirrored;
}

} // namespace glcast::preload
