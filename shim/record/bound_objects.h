// Binding an object of the program's in its own context, to read it, so that nothing is lost of what was
// bound.
//
// An object that another context has deleted lives on without a name where it is bound, and cannot be bound a
// second time: its name is another object's, or none. So objects are bound where nothing is.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

/// The texture `name` on the active texture unit, which may be another than before, for as long as it lives.
/// Needs `can_query`.
class BoundTexture {
  public:
    BoundTexture(Context& context, GLenum target, GLuint name);
    ~BoundTexture();
    BoundTexture(const BoundTexture&) = delete;
    BoundTexture& operator=(const BoundTexture&) = delete;

    /// False where something has to go for it that cannot be bound again: it is not bound then.
    explicit operator bool() const { return is_bound; }

  private:
    bool move_to_free_unit(Context& context, GLenum binding);

    const GlTable& gl;
    const GLenum target;
    GLuint before = 0, bound = 0;
    GLenum unit_before = 0; ///< 0: still active
    bool is_bound = true;
};

/// The buffer `name`, for as long as it lives, on a target that no vertex array object holds. Needs
/// `can_query`.
class BoundBuffer {
  public:
    BoundBuffer(Context& context, GLuint name);
    ~BoundBuffer();
    BoundBuffer(const BoundBuffer&) = delete;
    BoundBuffer& operator=(const BoundBuffer&) = delete;

    GLint parameter(GLenum name) const;
    void read(std::size_t offset, void* to, std::size_t bytes) const;

  private:
    const GlTable& gl;
    GLenum target = GL_ARRAY_BUFFER;
    GLuint before = 0, bound = 0;
};

} // namespace glcast::record
