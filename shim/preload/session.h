// The life of a preloaded process: its contexts, its frames, and when one of them is cast.
#pragma once
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <vector>

#include "shim/preload/options.h"
#include "shim/preload/window_system.h"
#include "shim/record/record.h"

namespace glcast::preload {

/// A context of the program's.
struct NativeContext {
    const WindowSystem* system = nullptr;
    void* display = nullptr;
    void* handle = nullptr;
    std::function<void*()>
        make_sibling; ///< repeats the call that made it, sharing with it; null where that failed
    std::shared_ptr<record::Context> shadow;   ///< null where it is not desktop GL
    std::atomic<void*> sibling{nullptr};       ///< made when first needed, ours to destroy
    std::atomic<bool> sibling_is_spent{false}; ///< it has drawn: to be destroyed on a thread of the program's
    // Changed by the thread on which it is current, where there is one, and with the session's mutex held.
    bool recording = false;
    std::uintptr_t recorded_drawable = 0;
    int threads = 0; ///< on which it is current
    bool destroyed = false;
    bool in_cast =
        false; ///< a cast has left it and will come back, or makes a sibling of it; on whatever thread
    /// Of the frame that is recorded, since something was drawn: how far that was, and the pixels read.
    struct Reads {
        std::uint64_t drawn = 0;
        long pixels = 0;
    } reads;
    /// A frame has ended elsewhere while this context was current on a thread of its own: what it has drawn
    /// by its next flush belongs to that frame.
    std::atomic<bool> end_is_due{false};
};

/// What one context has drawn to one drawable since the last frame ended. A frame may have several parts: Qt
/// draws the scene in one context, to a framebuffer object, and puts it on the window in another.
struct FramePart {
    std::shared_ptr<NativeContext> context;
    std::uintptr_t drawable = 0;
    std::shared_ptr<const record::Frame> frame;
    long draws = 0; ///< those that can be replayed
};

/// Must GL be shadowed at all? False for good when nothing can be asked of this process.
bool shadows_calls();

// What the GLX and EGL wrappers report. None of them throws, fails or changes what the program sees.

/// `share` is a native handle or null. A null `make_sibling`: the context is not desktop GL.
void context_made(const WindowSystem& system, void* display, void* handle, void* share,
                  std::function<void*()> make_sibling) noexcept;
/// Before the real destroy. False where a cast on another thread uses the context: that destroys it at its
/// end.
bool context_destroyed(void* display, void* handle) noexcept;
/// After a make-current that succeeded; null context: none is current on this thread.
void made_current(const Binding& binding) noexcept;
/// A surface that shows in a window of X.
void surface_made(std::uintptr_t drawable, std::uint32_t window) noexcept;
/// Around the real swap of a drawable, whichever is current.
void before_swap(std::uintptr_t drawable) noexcept;
void after_swap(std::uintptr_t drawable) noexcept;
/// A drawable that no swap shows: its frames end where they are read. A pixmap shows what is flushed to it.
void offscreen_made(std::uintptr_t drawable, bool is_pbuffer) noexcept;
/// Of an idle program, and of one that has swapped, nothing need be asked.
bool reads_may_end_frames() noexcept;
/// Before a read of so many pixels. While nothing was ever swapped, a frame ends where a picture of it is
/// read; a few pixels are no picture, for programs look so what the pointer is on.
void pixels_are_read(long pixels) noexcept;
/// Before another context or drawable becomes current on this thread: what was drawn to a pixmap is flushed
/// then.
void before_leaving() noexcept;
/// Display lists of this thread's context that were filled by other means than GL calls.
void lists_made_elsewhere(GLuint first, GLsizei count) noexcept;

/// More than 0 while a wrapper is inside a real GLX or EGL call on this thread: calls that the GL library
/// then makes to our exported names are its own business.
class Outermost {
  public:
    Outermost() : outermost(depth++ == 0) {}
    ~Outermost() { --depth; }
    Outermost(const Outermost&) = delete;
    Outermost& operator=(const Outermost&) = delete;
    explicit operator bool() const { return outermost; }

  private:
    static thread_local int depth;
    const bool outermost;
};

} // namespace glcast::preload
