// Asking GL for values.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast {

/// A query that GL refuses leaves `fallback`. The first of up to 16 values.
inline GLint get_int(const GlTable& gl, GLenum name, GLint fallback = 0) {
    GLint values[16] = {fallback};
    gl.GetIntegerv(name, values);
    return values[0];
}

} // namespace glcast
