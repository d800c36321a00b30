// What a capture needs of GLX or EGL.
#pragma once
#include <cstdint>
#include <string>

namespace glcast::preload {

/// A context with the drawables it is current on.
struct Binding {
    void* display = nullptr;
    std::uintptr_t draw = 0, read = 0;
    void* context = nullptr;
};

class WindowSystem {
  public:
    virtual ~WindowSystem() = default;
    virtual const char* name() const = 0;
    /// Of this thread, asked from the window system.
    virtual Binding current() const = 0;
    /// False when it failed; errors do not reach the program.
    virtual bool bind(const Binding& binding) const = 0;
    /// The same on a thread of ours, without a drawable, or none where `context` is null: says nothing to an
    /// X server, whose connection belongs to the program's threads.
    virtual bool bind_alone(void* display, void* context) const { return bind({display, 0, 0, context}); }
    /// `gone(display)` is called before the program closes it. Asked on a thread of the program's.
    virtual void watch_display(void*, void (*)(void*)) const {}
    /// Whether its drawables still exist: to leave a context whose window has been destroyed is to lose it.
    virtual bool can_return_to(const Binding& binding) const = 0;
    virtual void destroy(void* display, void* context) const = 0;
    /// The X server's name of a drawable that may be a window; 0: not known.
    virtual std::uint32_t window_of(std::uintptr_t drawable) const = 0;
    /// Of the X server, as in $DISPLAY; empty: not known.
    virtual std::string server(void* display) const = 0;
};

} // namespace glcast::preload
