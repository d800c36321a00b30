#include "shim/preload/x_errors.h"

#include <X11/Xlib.h>
#include <dlfcn.h>

#include <atomic>

#include "shim/preload/real.h"

namespace glcast::preload {
namespace {

struct XCalls {
    decltype(&::XSetErrorHandler) set_handler = nullptr;
    decltype(&::XSync) sync = nullptr;
    decltype(&::XNextRequest) next_request = nullptr;
    decltype(&::XGetGeometry) get_geometry = nullptr;
    decltype(&::XDisplayString) display_string = nullptr;

    bool complete() const { return set_handler && sync && next_request && get_geometry && display_string; }
};

template <class Function> void find(void* library, const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(real_dlsym()(library, name));
}

const XCalls& x_calls() {
    static const XCalls calls = [] {
        XCalls found;
        void* library = real_dlopen()("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
        if (!library) return found;
        find(library, "XSetErrorHandler", found.set_handler);
        find(library, "XSync", found.sync);
        find(library, "XNextRequest", found.next_request);
        find(library, "XGetGeometry", found.get_geometry);
        find(library, "XDisplayString", found.display_string);
        return found;
    }();
    return calls;
}

/// What the handler needs to know; one trap at a time.
struct Trap {
    Display* display = nullptr;
    unsigned long first_request = 0;
    XErrorHandler previous = nullptr;
    std::atomic<bool> failed{false};
};
constinit Trap trap;

int handle_error(Display* display, XErrorEvent* event) {
    if (display == trap.display && event->serial >= trap.first_request) {
        trap.failed = true;
        return 0;
    }
    return trap.previous ? trap.previous(display, event) : 0;
}

} // namespace

XErrorTrap::XErrorTrap(void* display) {
    if (!x_calls().complete()) return;
    trap.display = static_cast<Display*>(display);
    trap.first_request = x_calls().next_request(trap.display);
    trap.failed = false;
    trap.previous = x_calls().set_handler(handle_error);
}

XErrorTrap::~XErrorTrap() {
    if (!x_calls().complete()) return;
    x_calls().sync(trap.display, False);
    x_calls().set_handler(trap.previous);
    trap.display = nullptr;
}

bool x_drawable_exists(void* display, unsigned long drawable) {
    if (!x_calls().complete()) return true;
    XErrorTrap trap(display);
    Window root = 0;
    int x = 0, y = 0;
    unsigned width = 0, height = 0, border = 0, depth = 0;
    return x_calls().get_geometry(static_cast<Display*>(display), drawable, &root, &x, &y, &width, &height,
                                  &border, &depth) != 0;
}

std::string x_display_name(void* display) {
    const char* name = x_calls().complete() && display ? x_calls().display_string(static_cast<Display*>(display)) : "";
    return name ? name : "";
}

bool XErrorTrap::failed() {
    if (!x_calls().complete()) return false;
    x_calls().sync(trap.display, False);
    return trap.failed;
}

} // namespace glcast::preload
