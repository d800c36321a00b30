#include "shim/preload/x_close.h"

#include <X11/Xlib.h>
#include <dlfcn.h>

#include <mutex>
#include <set>

#include "shim/preload/real.h"

namespace glcast::preload {
namespace {

struct Watched {
    std::mutex mutex; ///< never held over a call of Xlib's
    std::set<void*> displays;
    void (*gone)(void* display) = nullptr;
};
Watched& watched() {
    static auto* all = new Watched; // never destroyed: threads may outlive exit()
    return *all;
}

int display_closes(Display* display, XExtCodes*) {
    void (*gone)(void*) = nullptr;
    {
        const std::lock_guard lock(watched().mutex);
        watched().displays.erase(display);
        gone = watched().gone;
    }
    gone(display);
    return 0;
}

template <class Function> Function* find(const char* name) {
    void* library = real_dlopen()("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    return library ? reinterpret_cast<Function*>(real_dlsym()(library, name)) : nullptr;
}

} // namespace

void call_before_close(void* display, void (*gone)(void*)) {
    {
        const std::lock_guard lock(watched().mutex);
        watched().gone = gone;
        if (!watched().displays.insert(display).second) return;
    }
    // An extension of the client's alone: the server hears nothing of it. The one that came last is called
    // first, and so before that of the GL library.
    static const auto add = find<decltype(::XAddExtension)>("XAddExtension");
    using Close = int (*)(Display*, XExtCodes*); // Xlibint.h, which defines min and max
    static const auto set_close = find<Close(Display*, int, Close)>("XESetCloseDisplay");
    if (!add || !set_close) return;
    if (const XExtCodes* codes = add(static_cast<Display*>(display)))
        set_close(static_cast<Display*>(display), codes->extension, display_closes);
}

} // namespace glcast::preload
