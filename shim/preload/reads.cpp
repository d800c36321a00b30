// Reads of pixels. What they mean for a frame is said in session.h.
#include "shim/preload/real.h"
#include "shim/preload/session.h"
#include "shim/preload/stub.h"

namespace glcast::preload {
namespace {

/// GL refuses what these two ask only where it refuses the read itself, with the same error.
long pixels_of(GLenum target, GLint level) {
    if (level != 0 || (target != GL_TEXTURE_2D && target != GL_TEXTURE_RECTANGLE)) return 0;
    GLint width = 0, height = 0;
    real_table().GetTexLevelParameteriv(target, level, GL_TEXTURE_WIDTH, &width);
    real_table().GetTexLevelParameteriv(target, level, GL_TEXTURE_HEIGHT, &height);
    return long(width) * height;
}

long pixels_of_texture(GLuint texture, GLint level) {
    if (level != 0) return 0;
    GLint width = 0, height = 0;
    real_table().GetTextureLevelParameteriv(texture, level, GL_TEXTURE_WIDTH, &width);
    real_table().GetTextureLevelParameteriv(texture, level, GL_TEXTURE_HEIGHT, &height);
    return long(width) * height;
}

void picture(GLsizei width, GLsizei height, GLenum format) {
    if (reads_may_end_frames() && format != GL_STENCIL_INDEX && width > 0 && height > 0)
        pixels_are_read(long(width) * height);
}

void texture(GLenum target, GLint level) {
    if (reads_may_end_frames()) pixels_are_read(pixels_of(target, level));
}

} // namespace

namespace before {

void ReadPixels(GLint, GLint, GLsizei width, GLsizei height, GLenum format, GLenum, void*) noexcept {
    picture(width, height, format);
}
void ReadnPixels(GLint, GLint, GLsizei width, GLsizei height, GLenum format, GLenum, GLsizei,
                 void*) noexcept {
    picture(width, height, format);
}
void ReadnPixelsARB(GLint, GLint, GLsizei width, GLsizei height, GLenum format, GLenum, GLsizei,
                    void*) noexcept {
    picture(width, height, format);
}
void GetTexImage(GLenum target, GLint level, GLenum, GLenum, void*) noexcept { texture(target, level); }
void GetnTexImage(GLenum target, GLint level, GLenum, GLenum, GLsizei, void*) noexcept {
    texture(target, level);
}
void GetnTexImageARB(GLenum target, GLint level, GLenum, GLenum, GLsizei, void*) noexcept {
    texture(target, level);
}
void GetTextureImage(GLuint name, GLint level, GLenum, GLenum, GLsizei, void*) noexcept {
    if (reads_may_end_frames()) pixels_are_read(pixels_of_texture(name, level));
}

} // namespace before
} // namespace glcast::preload
