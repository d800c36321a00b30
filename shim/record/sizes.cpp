#include "shim/record/sizes.h"

#include <algorithm>

namespace glcast::record::sizes {

std::size_t fog(GLenum pname) { return pname == GL_FOG_COLOR ? 4 : 1; }

std::size_t light(GLenum pname) {
    switch (pname) {
    case GL_AMBIENT:
    case GL_DIFFUSE:
    case GL_SPECULAR:
    case GL_POSITION:
        return 4;
    case GL_SPOT_DIRECTION:
        return 3;
    default:
        return 1;
    }
}

std::size_t light_model(GLenum pname) { return pname == GL_LIGHT_MODEL_AMBIENT ? 4 : 1; }

std::size_t material(GLenum pname) {
    switch (pname) {
    case GL_AMBIENT:
    case GL_DIFFUSE:
    case GL_SPECULAR:
    case GL_EMISSION:
    case GL_AMBIENT_AND_DIFFUSE:
        return 4;
    case GL_COLOR_INDEXES:
        return 3;
    default:
        return 1;
    }
}

std::size_t point_parameter(GLenum pname) { return pname == GL_POINT_DISTANCE_ATTENUATION ? 3 : 1; }

std::size_t tex_env(GLenum pname) { return pname == GL_TEXTURE_ENV_COLOR ? 4 : 1; }

std::size_t tex_gen(GLenum pname) { return pname == GL_OBJECT_PLANE || pname == GL_EYE_PLANE ? 4 : 1; }

std::size_t tex_parameter(GLenum pname) {
    return pname == GL_TEXTURE_BORDER_COLOR || pname == GL_TEXTURE_SWIZZLE_RGBA ? 4 : 1;
}

std::size_t map_components(GLenum target) {
    switch (target) {
    case GL_MAP1_VERTEX_4:
    case GL_MAP1_COLOR_4:
    case GL_MAP1_TEXTURE_COORD_4:
    case GL_MAP2_VERTEX_4:
    case GL_MAP2_COLOR_4:
    case GL_MAP2_TEXTURE_COORD_4:
        return 4;
    case GL_MAP1_VERTEX_3:
    case GL_MAP1_NORMAL:
    case GL_MAP1_TEXTURE_COORD_3:
    case GL_MAP2_VERTEX_3:
    case GL_MAP2_NORMAL:
    case GL_MAP2_TEXTURE_COORD_3:
        return 3;
    case GL_MAP1_TEXTURE_COORD_2:
    case GL_MAP2_TEXTURE_COORD_2:
        return 2;
    case GL_MAP1_INDEX:
    case GL_MAP1_TEXTURE_COORD_1:
    case GL_MAP2_INDEX:
    case GL_MAP2_TEXTURE_COORD_1:
        return 1;
    default:
        return 0;
    }
}

std::size_t map1(GLenum target, double, double, GLint, GLint order, const void*) {
    return map_components(target) * std::size_t(std::max(order, 0));
}

std::size_t map2(GLenum target, double, double, GLint, GLint uorder, double, double, GLint, GLint vorder,
                 const void*) {
    return map_components(target) * std::size_t(std::max(uorder, 0)) * std::size_t(std::max(vorder, 0));
}

namespace {

std::size_t components(GLenum format) {
    switch (format) {
    case GL_COLOR_INDEX:
    case GL_STENCIL_INDEX:
    case GL_DEPTH_COMPONENT:
    case GL_RED:
    case GL_GREEN:
    case GL_BLUE:
    case GL_ALPHA:
    case GL_LUMINANCE:
    case GL_INTENSITY:
    case GL_RED_INTEGER:
    case GL_GREEN_INTEGER:
    case GL_BLUE_INTEGER:
    case GL_ALPHA_INTEGER:
        return 1;
    case GL_LUMINANCE_ALPHA:
    case GL_RG:
    case GL_RG_INTEGER:
    case GL_DEPTH_STENCIL:
        return 2;
    case GL_RGB:
    case GL_BGR:
    case GL_RGB_INTEGER:
    case GL_BGR_INTEGER:
        return 3;
    case GL_RGBA:
    case GL_BGRA:
    case GL_ABGR_EXT:
    case GL_RGBA_INTEGER:
    case GL_BGRA_INTEGER:
        return 4;
    default:
        return 0;
    }
}

} // namespace

PixelSize pixel_size(GLenum format, GLenum type) {
    const std::size_t n = components(format);
    switch (type) {
    case GL_BITMAP:
        return {n ? std::size_t(1) : 0, 1};
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
        return {8 * n, 1};
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_HALF_FLOAT:
        return {16 * n, 2};
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
        return {32 * n, 4};
    case GL_UNSIGNED_BYTE_3_3_2:
    case GL_UNSIGNED_BYTE_2_3_3_REV:
        return {8, 1};
    case GL_UNSIGNED_SHORT_5_6_5:
    case GL_UNSIGNED_SHORT_5_6_5_REV:
    case GL_UNSIGNED_SHORT_4_4_4_4:
    case GL_UNSIGNED_SHORT_4_4_4_4_REV:
    case GL_UNSIGNED_SHORT_5_5_5_1:
    case GL_UNSIGNED_SHORT_1_5_5_5_REV:
        return {16, 2};
    case GL_UNSIGNED_INT_8_8_8_8:
    case GL_UNSIGNED_INT_8_8_8_8_REV:
    case GL_UNSIGNED_INT_10_10_10_2:
    case GL_UNSIGNED_INT_2_10_10_10_REV:
    case GL_UNSIGNED_INT_24_8:
    case GL_UNSIGNED_INT_10F_11F_11F_REV:
    case GL_UNSIGNED_INT_5_9_9_9_REV:
        return {32, 4};
    case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
        return {64, 4};
    default:
        return {0, 1};
    }
}

std::size_t image_bytes(GLenum format, GLenum type, GLsizei width, GLsizei height, GLsizei depth) {
    if (width <= 0 || height <= 0 || depth <= 0) return 0;
    const std::size_t row = (pixel_size(format, type).bits * std::size_t(width) + 7) / 8;
    return row * std::size_t(height) * std::size_t(depth);
}

} // namespace glcast::record::sizes
