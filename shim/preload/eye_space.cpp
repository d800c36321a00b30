#include "shim/preload/eye_space.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "capture/gl/gl_query.h"

namespace glcast::preload {
void EyeSpace::enter(const EyeMap* map, double nudge) {
    if (map) move(*map);
    // As a trimmed depth range, which capture/depth_offset.h makes a level of.
    if (nudge == 0) return;
    if (get_int(gl, GL_ATTRIB_STACK_DEPTH, 0) + 1 >= get_int(gl, GL_MAX_ATTRIB_STACK_DEPTH, 16)) return;
    gl.PushAttrib(GL_VIEWPORT_BIT);
    gl.DepthRange(nudge, 1 + nudge);
    is_nudged = true;
}

void EyeSpace::leave() {
    if (is_nudged) gl.PopAttrib();
    is_nudged = false;
    if (!is_moved) return;
    is_moved = false;
    set_planes(glm::dmat4(1.0));
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadMatrixd(glm::value_ptr(modelview));
    gl.MatrixMode(static_cast<GLenum>(matrix_mode));
}

void EyeSpace::move(const EyeMap& map) {
    matrix_mode = get_int(gl, GL_MATRIX_MODE, GL_MODELVIEW);
    gl.GetDoublev(GL_MODELVIEW_MATRIX, glm::value_ptr(modelview));
    const glm::dmat4 moved = map.apply(modelview);
    note_planes();
    gl.MatrixMode(GL_MODELVIEW);
    if (!planes.empty()) set_planes(moved * glm::inverse(modelview));
    gl.LoadMatrixd(glm::value_ptr(moved));
    gl.MatrixMode(static_cast<GLenum>(matrix_mode));
    is_moved = true;
}

void EyeSpace::note_planes() {
    planes.clear();
    const GLint clips = get_int(gl, GL_MAX_CLIP_PLANES, 6);
    for (GLint i = 0; i < clips; ++i) {
        const GLenum name = GL_CLIP_PLANE0 + static_cast<GLenum>(i);
        if (!gl.IsEnabled(name)) continue;
        Plane& plane = planes.emplace_back(Plane{false, name, 0, {}});
        gl.GetClipPlane(name, plane.values);
    }
    const GLint active = get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0);
    const GLint units = gl.ActiveTexture ? get_int(gl, GL_MAX_TEXTURE_UNITS, 1) : 1;
    for (GLint unit = 0; unit < units; ++unit) {
        if (gl.ActiveTexture) gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        for (GLenum i = 0; i < 4; ++i) {
            GLint mode = 0;
            if (gl.IsEnabled(GL_TEXTURE_GEN_S + i)) gl.GetTexGeniv(GL_S + i, GL_TEXTURE_GEN_MODE, &mode);
            if (mode != GL_EYE_LINEAR) continue;
            Plane& plane =
                planes.emplace_back(Plane{true, GL_S + i, GL_TEXTURE0 + static_cast<GLenum>(unit), {}});
            gl.GetTexGendv(plane.name, GL_EYE_PLANE, plane.values);
        }
    }
    if (gl.ActiveTexture) gl.ActiveTexture(static_cast<GLenum>(active));
}

/// The planes as noted, given in `space` in the place of eye space.
void EyeSpace::set_planes(const glm::dmat4& space) {
    if (planes.empty()) return;
    const GLint active = get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0);
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadMatrixd(glm::value_ptr(space));
    for (const Plane& plane : planes) {
        if (!plane.is_texture) {
            gl.ClipPlane(plane.name, plane.values);
            continue;
        }
        if (gl.ActiveTexture) gl.ActiveTexture(plane.unit);
        gl.TexGendv(plane.name, GL_EYE_PLANE, plane.values);
    }
    if (gl.ActiveTexture) gl.ActiveTexture(static_cast<GLenum>(active));
}

} // namespace glcast::preload
