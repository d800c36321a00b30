// Textures that the program changes or deletes in a frame that has drawn from them: each draw must see its
// own picture.
//
// Contexts share textures with a name, so at replay there is only what they held last. What a texture holds
// is copied before it changes, if anything may have been drawn from it since it was bound or copied; replays
// bind such copies (texture_stand_ins.h) until they come to the change.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

/// Those that are bound when the frame starts, found in its prologue.
void note_bound_textures(Recording& recording);

/// Those that are bound and that another context has deleted: no name finds them at replay. When the frame
/// starts.
void copy_nameless_textures(Context& context);

/// Before a call that changes what is bound to `target` (or a face of a cube). Needs `can_query`.
void copy_before_change(Context& context, GLenum target);

/// Before an image goes into what is bound to `target`: whether that is the texture named 0. Needs
/// `can_query`.
bool note_default_filled(Context& context, GLenum target);

} // namespace glcast::record
