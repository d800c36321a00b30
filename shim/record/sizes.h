// How much memory a pointer of a call points at, where the registry says only COMPSIZE. In elements of the
// pointer's type.
#pragma once
#include <cstddef>

#include "capture/gl/gl_table.h"

namespace glcast::record::sizes {

std::size_t fog(GLenum pname);
std::size_t light(GLenum pname);
std::size_t light_model(GLenum pname);
std::size_t material(GLenum pname);
std::size_t point_parameter(GLenum pname);
std::size_t tex_env(GLenum pname);
std::size_t tex_gen(GLenum pname);
std::size_t tex_parameter(GLenum pname);

/// Values per control point of an evaluator map; 0: not a map.
std::size_t map_components(GLenum target);
/// Evaluator packets hold their points tightly packed: the strides are the number of components.
std::size_t map1(GLenum target, double u1, double u2, GLint stride, GLint order, const void*);
std::size_t map2(GLenum target, double u1, double u2, GLint ustride, GLint uorder, double v1, double v2,
                 GLint vstride, GLint vorder, const void*);

/// Image packets hold their pixels tightly packed: alignment 1, nothing skipped, native byte order.
struct PixelSize {
    std::size_t bits;    ///< of a pixel; 0: format or type unknown
    std::size_t element; ///< bytes that GL_UNPACK_SWAP_BYTES swaps as one
};
PixelSize pixel_size(GLenum format, GLenum type);
std::size_t image_bytes(GLenum format, GLenum type, GLsizei width, GLsizei height, GLsizei depth);

inline std::size_t bitmap(GLsizei w, GLsizei h, GLfloat, GLfloat, GLfloat, GLfloat, const GLubyte*) {
    return image_bytes(GL_COLOR_INDEX, GL_BITMAP, w, h, 1);
}
inline std::size_t draw_pixels(GLsizei w, GLsizei h, GLenum format, GLenum type, const void*) {
    return image_bytes(format, type, w, h, 1);
}
inline std::size_t tex_image_1d(GLenum, GLint, GLint, GLsizei w, GLint, GLenum format, GLenum type,
                                const void*) {
    return image_bytes(format, type, w, 1, 1);
}
inline std::size_t tex_image_2d(GLenum, GLint, GLint, GLsizei w, GLsizei h, GLint, GLenum format, GLenum type,
                                const void*) {
    return image_bytes(format, type, w, h, 1);
}
inline std::size_t tex_image_3d(GLenum, GLint, GLint, GLsizei w, GLsizei h, GLsizei d, GLint, GLenum format,
                                GLenum type, const void*) {
    return image_bytes(format, type, w, h, d);
}
inline std::size_t tex_sub_image_1d(GLenum, GLint, GLint, GLsizei w, GLenum format, GLenum type,
                                    const void*) {
    return image_bytes(format, type, w, 1, 1);
}
inline std::size_t tex_sub_image_2d(GLenum, GLint, GLint, GLint, GLsizei w, GLsizei h, GLenum format,
                                    GLenum type, const void*) {
    return image_bytes(format, type, w, h, 1);
}
inline std::size_t tex_sub_image_3d(GLenum, GLint, GLint, GLint, GLint, GLsizei w, GLsizei h, GLsizei d,
                                    GLenum format, GLenum type, const void*) {
    return image_bytes(format, type, w, h, d);
}

} // namespace glcast::record::sizes
