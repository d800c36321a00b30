// Reading buffer objects, and noticing that the program changes one.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

/// The buffer bound to a target, 0 for none. Needs `can_query`.
GLuint bound_buffer(const GlTable& gl, GLenum target);

/// Drops the copies of one buffer in the whole share group; 0: of all.
void forget_buffer(Context& context, GLuint name);

enum NamedBy { by_target, by_name };

/// Forgets a buffer when it goes out of scope. Does nothing where `context` is null.
class ForgetBuffer {
  public:
    ForgetBuffer(Context* changing, GLenum target_or_name, NamedBy by);
    ~ForgetBuffer();
    ForgetBuffer(const ForgetBuffer&) = delete;
    ForgetBuffer& operator=(const ForgetBuffer&) = delete;

  private:
    Context* context;
    GLuint name = 0;
};

/// Reads `bytes` of a buffer from `offset`. False when it has fewer or cannot be read. Needs `can_query`.
bool read_buffer(Context& context, GLuint name, std::size_t offset, void* to, std::size_t bytes);

/// All of a buffer. Null when it cannot be read now, or should not be kept: it is persistently mapped, or
/// changes again and again in this frame (then the parts that are drawn are less than copies of the whole).
Blob whole_buffer(Context& context, GLuint name);

} // namespace glcast::record
