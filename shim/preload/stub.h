// The exported gl* entry points: what each of them does when no frame is recorded, and when one is.
#pragma once
#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "capture/gl/gl_table.h"
#include "shim/preload/pretence.h"
#pragma GCC visibility push(hidden) // so that the stubs read `active` and `idle` with no detour over the GOT
#include "shim/record/record.h"
#pragma GCC visibility pop

#define GLCAST_EXPORT __attribute__((visibility("default")))

namespace glcast::preload {

/// What the stubs call while nothing is recorded: real functions. Constant-initialised with thunks that look
/// the function up at its first call; where the call is shadowed always (record::always_shadowed), the thunk
/// stays and goes to the recorder.
extern GlTable idle __attribute__((visibility("hidden")));

/// The exported stubs, indexed by GlCall.
extern const GlProc stubs[gl_call_count] __attribute__((visibility("hidden")));

/// Ten times the version of OpenGL that brought a call (15, 20, ...); 255 where it is of extensions alone.
extern const std::uint8_t core_versions[gl_call_count] __attribute__((visibility("hidden")));

/// The table to find a call in at its first use: `idle`, with the real function put there from now on, or the
/// recorder's where the call is shadowed always.
const GlTable& resolve(GlCall call);

/// The recorder's, after making this thread known to it.
const GlTable& recording_table();

/// Before a real read of pixels: it ends the frame of a program that never swaps (reads.cpp).
namespace before {
void ReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                void* pixels) noexcept;
void ReadnPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, GLsizei bytes,
                 void* pixels) noexcept;
void ReadnPixelsARB(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                    GLsizei bytes, void* pixels) noexcept;
void GetTexImage(GLenum target, GLint level, GLenum format, GLenum type, void* pixels) noexcept;
void GetnTexImage(GLenum target, GLint level, GLenum format, GLenum type, GLsizei bytes,
                  void* pixels) noexcept;
void GetnTexImageARB(GLenum target, GLint level, GLenum format, GLenum type, GLsizei bytes,
                     void* pixels) noexcept;
void GetTextureImage(GLuint texture, GLint level, GLenum format, GLenum type, GLsizei bytes,
                     void* pixels) noexcept;
} // namespace before

/// Before glDrawBuffer: the front buffer may be chosen for a while only, and flushed later.
void draw_buffer_chosen(GLenum buffer) noexcept;

/// After a real glFlush or glFinish: the end of a frame for who draws to the front buffer.
void flushed() noexcept;

} // namespace glcast::preload

// A stub is a load, a branch that is never taken in an idle program, and an indirect tail call. The asm label
// keeps it clear of the prototypes in GL/gl.h.
#define GLCAST_STUB(RESULT, NAME, PARAMETERS, ARGUMENTS)                                                     \
    extern "C" GLCAST_EXPORT RESULT APIENTRY gl##NAME##_stub PARAMETERS __asm__("gl" #NAME);                 \
    extern "C" GLCAST_EXPORT RESULT APIENTRY gl##NAME##_stub PARAMETERS {                                    \
        if (glcast::record::active.load(std::memory_order_relaxed) == 0) [[likely]]                          \
            return glcast::preload::idle.NAME ARGUMENTS;                                                     \
        return glcast::preload::recording_table().NAME ARGUMENTS;                                            \
    }                                                                                                        \
    GLCAST_THUNK(RESULT, NAME, PARAMETERS, ARGUMENTS)

#define GLCAST_FRAME_END_STUB(RESULT, NAME, PARAMETERS, ARGUMENTS)                                           \
    extern "C" GLCAST_EXPORT void APIENTRY gl##NAME##_stub() __asm__("gl" #NAME);                            \
    extern "C" GLCAST_EXPORT void APIENTRY gl##NAME##_stub() {                                               \
        const bool idles = glcast::record::active.load(std::memory_order_relaxed) == 0;                      \
        (idles ? glcast::preload::idle : glcast::preload::recording_table()).NAME();                         \
        glcast::preload::flushed();                                                                          \
    }                                                                                                        \
    GLCAST_THUNK(RESULT, NAME, PARAMETERS, ARGUMENTS)

#define GLCAST_READ_STUB(RESULT, NAME, PARAMETERS, ARGUMENTS)                                                \
    extern "C" GLCAST_EXPORT void APIENTRY gl##NAME##_stub PARAMETERS __asm__("gl" #NAME);                   \
    extern "C" GLCAST_EXPORT void APIENTRY gl##NAME##_stub PARAMETERS {                                      \
        glcast::preload::before::NAME ARGUMENTS;                                                             \
        const bool idles = glcast::record::active.load(std::memory_order_relaxed) == 0;                      \
        (idles ? glcast::preload::idle : glcast::preload::recording_table()).NAME ARGUMENTS;                 \
    }                                                                                                        \
    GLCAST_THUNK(RESULT, NAME, PARAMETERS, ARGUMENTS)

#define GLCAST_DRAW_BUFFER_STUB(RESULT, NAME, PARAMETERS, ARGUMENTS)                                         \
    extern "C" GLCAST_EXPORT void APIENTRY gl##NAME##_stub PARAMETERS __asm__("gl" #NAME);                   \
    extern "C" GLCAST_EXPORT void APIENTRY gl##NAME##_stub PARAMETERS {                                      \
        glcast::preload::draw_buffer_chosen ARGUMENTS;                                                       \
        const bool idles = glcast::record::active.load(std::memory_order_relaxed) == 0;                      \
        (idles ? glcast::preload::idle : glcast::preload::recording_table()).NAME ARGUMENTS;                 \
    }                                                                                                        \
    GLCAST_THUNK(RESULT, NAME, PARAMETERS, ARGUMENTS)

// Versions and extensions, about which the program may be told something else (pretence.h).
#define GLCAST_TOLD_STUB(RESULT, NAME, PARAMETERS, ARGUMENTS)                                                \
    extern "C" GLCAST_EXPORT RESULT APIENTRY gl##NAME##_stub PARAMETERS __asm__("gl" #NAME);                 \
    extern "C" GLCAST_EXPORT RESULT APIENTRY gl##NAME##_stub PARAMETERS {                                    \
        const bool idles = glcast::record::active.load(std::memory_order_relaxed) == 0;                      \
        const glcast::GlTable& table = idles ? glcast::preload::idle : glcast::preload::recording_table();   \
        if (glcast::preload::pretending.load(std::memory_order_relaxed)) [[unlikely]]                        \
            return glcast::preload::Told{table}.NAME ARGUMENTS;                                              \
        return table.NAME ARGUMENTS;                                                                         \
    }                                                                                                        \
    GLCAST_THUNK(RESULT, NAME, PARAMETERS, ARGUMENTS)

#define GLCAST_THUNK(RESULT, NAME, PARAMETERS, ARGUMENTS)                                                    \
    namespace glcast::preload::thunk {                                                                       \
    RESULT APIENTRY NAME PARAMETERS { return resolve(GlCall::NAME).NAME ARGUMENTS; }                         \
    }
