#include "shim/preload/x_errors.h"

#include <X11/Xlib.h>
#include <dlfcn.h>

#include <mutex>
#include <vector>

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

/// All traps that live, of all threads. The handler is one for the process: the first trap puts it in place,
/// the last gives the program's back.
struct Traps {
    std::mutex mutex; ///< never held over a request
    std::vector<XErrorTrap*> living;
    XErrorHandler previous = nullptr;
};
Traps& traps() {
    static auto* all = new Traps; // never destroyed: threads may outlive exit()
    return *all;
}

int handle_error(Display* display, XErrorEvent* event) {
    XErrorHandler previous = nullptr;
    {
        const std::lock_guard lock(traps().mutex);
        for (XErrorTrap* trap : traps().living)
            if (trap->catches(display, event->serial)) return 0;
        previous = traps().previous;
    }
    return previous ? previous(display, event) : 0;
}

} // namespace

XErrorTrap::XErrorTrap(void* of) : display(of) {
    if (!x_calls().complete()) return;
    first_request = x_calls().next_request(static_cast<Display*>(display));
    const std::lock_guard lock(traps().mutex);
    traps().living.push_back(this);
    if (traps().living.size() == 1) traps().previous = x_calls().set_handler(handle_error);
}

XErrorTrap::~XErrorTrap() {
    if (!x_calls().complete()) return;
    x_calls().sync(static_cast<Display*>(display), False);
    const std::lock_guard lock(traps().mutex);
    std::erase(traps().living, this);
    if (traps().living.empty()) x_calls().set_handler(traps().previous);
}

bool XErrorTrap::catches(const void* on, unsigned long request) {
    if (on != display || request < first_request) return false;
    has_failed = true;
    return true;
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
    const char* name =
        x_calls().complete() && display ? x_calls().display_string(static_cast<Display*>(display)) : "";
    return name ? name : "";
}

bool XErrorTrap::failed() {
    if (!x_calls().complete()) return false;
    x_calls().sync(static_cast<Display*>(display), False);
    return has_failed;
}

} // namespace glcast::preload
