// glCopyTexImage and its kin. What they copied into a texture with a name is there at replay; what they
// copied into the one named 0, which contexts do not share, is read back when it has been copied.
#include "shim/record/buffers.h"
#include "shim/record/packets.h"
#include "shim/record/snapshot.h"
#include "shim/record/textures.h"

namespace glcast::record {
namespace {

void note_copy(GLenum target, GLint level) {
    Context* context = listening_context();
    if (!context || !context->recording || !context->can_query()) return;
    if (!note_default_filled(*context, target)) return;
    if (context->compilation) return context->count("a copy into the texture named 0 by a display list");
    context->emit(false, [&](Stream& stream) { write_level(*context, stream, target, level); });
}

void note_change(GLenum target) {
    Context* context = listening_context();
    if (context && context->can_query()) copy_before_change(*context, target);
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY CopyTexImage1D(GLenum target, GLint level, GLenum internal, GLint x, GLint y, GLsizei w,
                             GLint border) {
    note_change(target);
    this_thread.real->CopyTexImage1D(target, level, internal, x, y, w, border);
    note_copy(target, level);
}

void APIENTRY CopyTexImage2D(GLenum target, GLint level, GLenum internal, GLint x, GLint y, GLsizei w,
                             GLsizei h, GLint border) {
    note_change(target);
    this_thread.real->CopyTexImage2D(target, level, internal, x, y, w, h, border);
    note_copy(target, level);
}

void APIENTRY CopyTexSubImage1D(GLenum target, GLint level, GLint to_x, GLint x, GLint y, GLsizei w) {
    note_change(target);
    this_thread.real->CopyTexSubImage1D(target, level, to_x, x, y, w);
    note_copy(target, level);
}

void APIENTRY CopyTexSubImage2D(GLenum target, GLint level, GLint to_x, GLint to_y, GLint x, GLint y,
                                GLsizei w, GLsizei h) {
    note_change(target);
    this_thread.real->CopyTexSubImage2D(target, level, to_x, to_y, x, y, w, h);
    note_copy(target, level);
}

void APIENTRY CopyTexSubImage3D(GLenum target, GLint level, GLint to_x, GLint to_y, GLint to_z, GLint x,
                                GLint y, GLsizei w, GLsizei h) {
    note_change(target);
    this_thread.real->CopyTexSubImage3D(target, level, to_x, to_y, to_z, x, y, w, h);
    note_copy(target, level);
}

void APIENTRY GenerateMipmap(GLenum target) {
    note_change(target);
    if (Context* context = listening_context())
        context->emit(false, [&](Stream& stream) { packets::GenerateMipmap::write(stream, target); });
    this_thread.real->GenerateMipmap(target);
}

} // namespace glcast::record::custom
