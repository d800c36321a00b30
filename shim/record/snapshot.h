// The state of a context, asked for and written as ordinary calls.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

/// Writes all server state but the matrix stacks into `stream`. Asks only what the context knows, so that no
/// GL error comes of it, and leaves everything as it was. `at_start`: the modelview may be overwritten, since
/// the stacks are loaded after.
void write_state(Context& context, Stream& stream, bool at_start);

/// The parts of write_state that have files of their own.
void write_lights(Context& context, Stream& stream);
void write_textures(Context& context, Stream& stream);
void write_default_textures(Context& context, Stream& stream);
void write_evaluators(Context& context, Stream& stream);

/// One level of the texture that is bound, as an upload. False when there is none.
bool write_level(Context& context, Stream& stream, GLenum target, GLint level);

/// All levels of the texture that is bound, and its parameters.
void write_texture(Context& context, Stream& stream, GLenum target);

/// The query for what is bound to a target of textures or to a face of a cube; 0 for proxies and targets that fixed
/// functions have not. `object`: the target that the texture itself has.
GLenum texture_binding(GLenum target, GLenum* object = nullptr);

/// The tops of all matrix stacks, with depths and current modes.
void read_matrices(Context& context, Recording& recording);

/// glPixelStore for packing at its defaults, with no pack buffer, for as long as it lives.
class DefaultPacking {
  public:
    explicit DefaultPacking(Context& context);
    ~DefaultPacking();
    DefaultPacking(const DefaultPacking&) = delete;
    DefaultPacking& operator=(const DefaultPacking&) = delete;

  private:
    static constexpr int count = 8;
    Context& context;
    GLint before[count];
    GLuint buffer = 0;
    bool is_pushed = false;
};

} // namespace glcast::record
