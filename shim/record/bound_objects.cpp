#include "shim/record/bound_objects.h"

#include "shim/record/snapshot.h"

namespace glcast::record {

BoundTexture::BoundTexture(Context& context, GLenum of, GLuint name)
    : gl(context.real), target(of), bound(name) {
    const GLenum binding = texture_binding(target);
    before = GLuint(get_int(gl, binding));
    if (before == bound) return;
    if (before && move_to_free_unit(context, binding)) before = 0;
    if (before && !gl.IsTexture(before)) {
        is_bound = false;
        return;
    }
    if (before != bound) gl.BindTexture(target, bound);
}

BoundTexture::~BoundTexture() {
    if (is_bound && before != bound) gl.BindTexture(target, before);
    if (unit_before) gl.ActiveTexture(unit_before);
}

bool BoundTexture::move_to_free_unit(Context& context, GLenum binding) {
    const Limits& limits = context.get_limits();
    if (!limits.has(13)) return false;
    const auto active = GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0));
    for (int unit = 0; unit < limits.texture_units; ++unit) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        if (get_int(gl, binding) == 0) {
            unit_before = active;
            return true;
        }
    }
    gl.ActiveTexture(active);
    return false;
}

BoundBuffer::BoundBuffer(Context& context, GLuint name) : gl(context.real), bound(name) {
    struct Place {
        GLenum target, binding;
        int since;
    };
    static constexpr Place places[] = {{GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING, 15},
                                       {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING, 31},
                                       {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING, 21}};
    for (const Place& place : places) {
        if (!context.get_limits().has(place.since)) continue;
        const auto there = GLuint(get_int(gl, place.binding));
        if (there != 0 && there != bound) continue;
        target = place.target;
        before = there;
        if (before != bound) gl.BindBuffer(target, bound);
        return;
    }
    before = GLuint(get_int(gl, GL_ARRAY_BUFFER_BINDING));
    gl.BindBuffer(target, bound);
}

BoundBuffer::~BoundBuffer() {
    if (before != bound) gl.BindBuffer(target, before);
}

GLint BoundBuffer::parameter(GLenum name) const {
    GLint value = 0;
    gl.GetBufferParameteriv(target, name, &value);
    return value;
}

void BoundBuffer::read(std::size_t offset, void* to, std::size_t bytes) const {
    gl.GetBufferSubData(target, GLintptr(offset), GLsizeiptr(bytes), to);
}

} // namespace glcast::record
