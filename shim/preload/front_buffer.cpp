#include "shim/preload/front_buffer.h"

#include "shim/preload/real.h"
#include "shim/preload/stub.h"

namespace glcast::preload {
namespace {

/// Open Inventor's ivview draws to the front buffer, chooses the back buffer again, and flushes then.
constinit thread_local bool front_was_chosen = false;

bool is_front(GLenum buffer) {
    return buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_FRONT_RIGHT ||
           buffer == GL_FRONT_AND_BACK;
}

} // namespace

bool draws_to_front() {
    GLint buffer = GL_BACK;
    real_table().GetIntegerv(GL_DRAW_BUFFER, &buffer);
    return front_was_chosen || is_front(GLenum(buffer));
}

void forget_front() { front_was_chosen = false; }

void draw_buffer_chosen(GLenum buffer) noexcept {
    if (is_front(buffer)) front_was_chosen = true;
}

} // namespace glcast::preload
