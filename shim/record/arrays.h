// Client arrays: read back from the context when a draw needs them, so nothing has to be followed while
// nothing is recorded.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

/// Brings `context.arrays` up to date: the arrays that are enabled and mean something to fixed-function GL,
/// the position (GL_VERTEX_ARRAY, or generic attribute 0, which takes its place) last. Needs `can_query`.
void refresh_arrays(Context& context);

/// Before glBegin: refreshes, and copies the buffers that glArrayElement may read where nothing can be asked.
void prepare_arrays(Context& context);

/// Bytes of one element; 0 for a type that we do not know.
std::size_t element_bytes(const Array& array);

/// Name of the generic attribute 0 among array kinds: it has none in GL.
inline constexpr GLenum attribute_0_array = GL_VERTEX_ATTRIB_ARRAY_ENABLED;

/// Counts a draw that replay leaves out, with why.
void count_if_not_played(Context& context);

/// The primitive restart index in force for indices of a type; nothing where there is none.
std::optional<std::uint32_t> restart_index(Context& context, GLenum type);

} // namespace glcast::record
