// GLX: the calls that make, drop, choose and show contexts.
#include <GL/glx.h>

#include <memory>
#include <optional>
#include <vector>

#include "shim/preload/lookup.h"
#include "shim/preload/pretence.h"
#include "shim/preload/real.h"
#include "shim/preload/session.h"
#include "shim/preload/status.h"
#include "shim/preload/stub.h"
#include "shim/preload/window_entries.h"
#include "shim/preload/x_close.h"
#include "shim/preload/x_errors.h"

extern "C" {
GLXContext glXCreateContextAttribsARB(Display*, GLXFBConfig, GLXContext, Bool, const int*);
GLXContext glXCreateContextWithConfigSGIX(Display*, GLXFBConfig, int, GLXContext, Bool);
Bool glXMakeCurrentReadSGI(Display*, GLXDrawable, GLXDrawable, GLXContext);
GLXPbuffer glXCreateGLXPbufferSGIX(Display*, GLXFBConfig, unsigned, unsigned, int*);
int64_t glXSwapBuffersMscOML(Display*, GLXDrawable, int64_t, int64_t, int64_t);
void glXCopySubBufferMESA(Display*, GLXDrawable, int, int, int, int);
}

namespace glcast::preload {
namespace {

// One line an entry point of ours: the table of real ones and the list for GetProcAddress are made of it.
#define GLCAST_GLX_CALLS(X)                                                                                  \
    X(glXGetProcAddress)                                                                                     \
    X(glXGetProcAddressARB)                                                                                  \
    X(glXCreateContext)                                                                                      \
    X(glXCreateNewContext)                                                                                   \
    X(glXCreateContextAttribsARB)                                                                            \
    X(glXCreateContextWithConfigSGIX)                                                                        \
    X(glXDestroyContext)                                                                                     \
    X(glXMakeCurrent)                                                                                        \
    X(glXMakeContextCurrent)                                                                                 \
    X(glXMakeCurrentReadSGI)                                                                                 \
    X(glXCreateWindow)                                                                                       \
    X(glXCreatePbuffer)                                                                                      \
    X(glXCreateGLXPbufferSGIX)                                                                               \
    X(glXCreatePixmap)                                                                                       \
    X(glXCreateGLXPixmap)                                                                                    \
    X(glXSwapBuffers)                                                                                        \
    X(glXSwapBuffersMscOML)                                                                                  \
    X(glXCopySubBufferMESA)                                                                                  \
    X(glXWaitGL)                                                                                             \
    X(glXUseXFont)                                                                                           \
    X(glXQueryExtensionsString)                                                                              \
    X(glXGetClientString)                                                                                    \
    X(glXQueryServerString)

// Asked for, not interposed.
#define GLCAST_GLX_QUERIES(X)                                                                                \
    X(glXGetCurrentContext)                                                                                  \
    X(glXGetCurrentDisplay)                                                                                  \
    X(glXGetCurrentDrawable)                                                                                 \
    X(glXGetCurrentReadDrawable)                                                                             \
    X(glXQueryDrawable)

GLCAST_DEFINE_REAL_CALLS(GLCAST_GLX_CALLS, GLCAST_GLX_QUERIES)

Display* as_display(void* display) { return static_cast<Display*>(display); }

/// Windows and pixmaps are X's to ask about, GLXWindows and pbuffers GLX's.
bool drawable_exists(void* display, GLXDrawable drawable) {
    if (drawable == 0 || x_drawable_exists(display, drawable)) return true;
    if (!real().glXQueryDrawable) return true;
    XErrorTrap trap(display);
    unsigned width = 0;
    real().glXQueryDrawable(as_display(display), drawable, GLX_WIDTH, &width);
    return !trap.failed();
}

class Glx : public WindowSystem {
  public:
    const char* name() const override { return "GLX"; }

    Binding current() const override {
        return {real().glXGetCurrentDisplay(), real().glXGetCurrentDrawable(),
                real().glXGetCurrentReadDrawable ? real().glXGetCurrentReadDrawable()
                                                 : real().glXGetCurrentDrawable(),
                real().glXGetCurrentContext()};
    }

    bool bind(const Binding& b) const override {
        XErrorTrap trap(b.display);
        const auto context = static_cast<GLXContext>(b.context);
        const bool is_surfaceless = b.context && b.draw == 0;
        const bool done = (is_surfaceless || b.draw != b.read) && real().glXMakeContextCurrent
                              ? real().glXMakeContextCurrent(as_display(b.display), b.draw, b.read, context)
                              : real().glXMakeCurrent(as_display(b.display), b.draw, context);
        return done && !trap.failed();
    }

    bool bind_alone(void* display, void* context) const override {
        return real().glXMakeContextCurrent &&
               real().glXMakeContextCurrent(as_display(display), 0, 0, static_cast<GLXContext>(context));
    }

    void watch_display(void* display, void (*gone)(void*)) const override {
        call_before_close(display, gone);
    }

    bool can_return_to(const Binding& b) const override {
        return drawable_exists(b.display, b.draw) && (b.read == b.draw || drawable_exists(b.display, b.read));
    }

    std::uint32_t window_of(std::uintptr_t drawable) const override { return std::uint32_t(drawable); }

    std::string server(void* display) const override { return x_display_name(display); }

    void destroy(void* display, void* context) const override {
        XErrorTrap trap(display);
        real().glXDestroyContext(as_display(display), static_cast<GLXContext>(context));
    }
};
const Glx glx;

/// Contexts made by `create(share)`: remembered together with how to make a sibling of them.
template <class Create>
GLXContext make_context(Display* display, GLXContext share, bool desktop, const Create& create) {
    const Outermost outermost;
    const GLXContext context = create(share);
    if (!context || !outermost) return context;
    std::function<void*()> make_sibling;
    if (desktop) {
        make_sibling = [=]() -> void* {
            XErrorTrap trap(display);
            const GLXContext sibling = create(context);
            return trap.failed() ? nullptr : sibling;
        };
    }
    context_made(glx, display, context, share, std::move(make_sibling));
    return context;
}

template <class MakeCurrent> Bool make_current(const Binding& binding, const MakeCurrent& real_make_current) {
    const Outermost outermost;
    if (outermost) before_leaving();
    const Bool done = real_make_current();
    if (done && outermost) made_current(binding);
    return done;
}

template <class Make> GLXDrawable make_offscreen(bool is_pbuffer, const Make& real_make) {
    const Outermost outermost;
    const GLXDrawable made = real_make();
    if (outermost) offscreen_made(made, is_pbuffer);
    return made;
}

template <class Swap> auto swap(GLXDrawable drawable, const Swap& real_swap) {
    const Outermost outermost;
    if (outermost) before_swap(drawable);
    struct After {
        const Outermost& outermost;
        GLXDrawable drawable;
        ~After() {
            if (outermost) after_swap(drawable);
        }
    } after{outermost, drawable};
    return real_swap();
}

/// An attribute list, copied with its end.
std::optional<std::vector<int>> copy_attributes(const int* attributes) {
    if (!attributes) return std::nullopt;
    std::vector<int> copy;
    for (; *attributes; attributes += 2) copy.insert(copy.end(), {attributes[0], attributes[1]});
    copy.push_back(0);
    return copy;
}

constexpr int context_major_version = 0x2091, context_minor_version = 0x2092; // GLX_CONTEXT_.._VERSION_ARB

bool asks_for_es(const std::optional<std::vector<int>>& attributes) {
    constexpr int profile_mask = 0x9126, es_bits = 0x4; // GLX_CONTEXT_PROFILE_MASK_ARB, .._ES_PROFILE_BIT_EXT
    for (std::size_t i = 0; attributes && i + 1 < attributes->size(); i += 2)
        if ((*attributes)[i] == profile_mask && (*attributes)[i + 1] & es_bits) return true;
    return false;
}

} // namespace

GLCAST_DEFINE_WINDOW_ENTRIES(glx_entries, GLCAST_GLX_CALLS)

} // namespace glcast::preload

using namespace glcast;
using namespace glcast::preload;

extern "C" {

GLCAST_EXPORT __GLXextFuncPtr glXGetProcAddress(const GLubyte* name) {
    const auto text = reinterpret_cast<const char*>(name);
    return real().glXGetProcAddress
               ? ours_instead(text, real().glXGetProcAddress(name), __builtin_return_address(0))
               : nullptr;
}

GLCAST_EXPORT __GLXextFuncPtr glXGetProcAddressARB(const GLubyte* name) {
    const auto text = reinterpret_cast<const char*>(name);
    return real().glXGetProcAddressARB
               ? ours_instead(text, real().glXGetProcAddressARB(name), __builtin_return_address(0))
               : nullptr;
}

GLCAST_EXPORT GLXContext glXCreateContext(Display* display, XVisualInfo* visual, GLXContext share,
                                          Bool direct) {
    if (!visual) return real().glXCreateContext(display, visual, share, direct);
    return make_context(display, share, true, [=, copy = *visual](GLXContext with) {
        XVisualInfo info = copy;
        return real().glXCreateContext(display, &info, with, direct);
    });
}

GLCAST_EXPORT GLXContext glXCreateNewContext(Display* display, GLXFBConfig config, int type, GLXContext share,
                                             Bool direct) {
    return make_context(display, share, true, [=](GLXContext with) {
        return real().glXCreateNewContext(display, config, type, with, direct);
    });
}

GLCAST_EXPORT GLXContext glXCreateContextAttribsARB(Display* display, GLXFBConfig config, GLXContext share,
                                                    Bool direct, const int* attributes) {
    if (!real().glXCreateContextAttribsARB) return nullptr;
    auto copy = copy_attributes(attributes);
    const bool desktop = !asks_for_es(copy);
    if (desktop)
        if (auto refused = refused_attributes(attributes, 0, context_major_version, context_minor_version))
            copy = std::move(refused);
    return make_context(display, share, desktop, [=, copy = std::move(copy)](GLXContext with) {
        return real().glXCreateContextAttribsARB(display, config, with, direct,
                                                 copy ? copy->data() : nullptr);
    });
}

GLCAST_EXPORT GLXContext glXCreateContextWithConfigSGIX(Display* display, GLXFBConfig config, int type,
                                                        GLXContext share, Bool direct) {
    if (!real().glXCreateContextWithConfigSGIX) return nullptr;
    return make_context(display, share, true, [=](GLXContext with) {
        return real().glXCreateContextWithConfigSGIX(display, config, type, with, direct);
    });
}

GLCAST_EXPORT void glXDestroyContext(Display* display, GLXContext context) {
    const Outermost outermost;
    if (outermost && !context_destroyed(display, context)) return;
    real().glXDestroyContext(display, context);
}

GLCAST_EXPORT Bool glXMakeCurrent(Display* display, GLXDrawable drawable, GLXContext context) {
    return make_current({display, drawable, drawable, context},
                        [=] { return real().glXMakeCurrent(display, drawable, context); });
}

GLCAST_EXPORT Bool glXMakeContextCurrent(Display* display, GLXDrawable draw, GLXDrawable read,
                                         GLXContext context) {
    return make_current({display, draw, read, context},
                        [=] { return real().glXMakeContextCurrent(display, draw, read, context); });
}

GLCAST_EXPORT Bool glXMakeCurrentReadSGI(Display* display, GLXDrawable draw, GLXDrawable read,
                                         GLXContext context) {
    if (!real().glXMakeCurrentReadSGI) return False;
    return make_current({display, draw, read, context},
                        [=] { return real().glXMakeCurrentReadSGI(display, draw, read, context); });
}

GLCAST_EXPORT GLXWindow glXCreateWindow(Display* display, GLXFBConfig config, Window window,
                                        const int* attributes) {
    if (!real().glXCreateWindow) return 0;
    const Outermost outermost;
    const GLXWindow made = real().glXCreateWindow(display, config, window, attributes);
    if (outermost) surface_made(made, std::uint32_t(window));
    return made;
}

GLCAST_EXPORT GLXPbuffer glXCreatePbuffer(Display* display, GLXFBConfig config, const int* attributes) {
    return make_offscreen(true, [=] { return real().glXCreatePbuffer(display, config, attributes); });
}

GLCAST_EXPORT GLXPbuffer glXCreateGLXPbufferSGIX(Display* display, GLXFBConfig config, unsigned width,
                                                 unsigned height, int* attributes) {
    if (!real().glXCreateGLXPbufferSGIX) return 0;
    return make_offscreen(
        true, [=] { return real().glXCreateGLXPbufferSGIX(display, config, width, height, attributes); });
}

GLCAST_EXPORT GLXPixmap glXCreatePixmap(Display* display, GLXFBConfig config, Pixmap pixmap,
                                        const int* attributes) {
    return make_offscreen(false, [=] { return real().glXCreatePixmap(display, config, pixmap, attributes); });
}

GLCAST_EXPORT GLXPixmap glXCreateGLXPixmap(Display* display, XVisualInfo* visual, Pixmap pixmap) {
    return make_offscreen(false, [=] { return real().glXCreateGLXPixmap(display, visual, pixmap); });
}

GLCAST_EXPORT void glXSwapBuffers(Display* display, GLXDrawable drawable) {
    swap(drawable, [=] { real().glXSwapBuffers(display, drawable); });
}

GLCAST_EXPORT int64_t glXSwapBuffersMscOML(Display* display, GLXDrawable drawable, int64_t target,
                                           int64_t divisor, int64_t remainder) {
    if (!real().glXSwapBuffersMscOML) return -1;
    return swap(drawable,
                [=] { return real().glXSwapBuffersMscOML(display, drawable, target, divisor, remainder); });
}

/// Shows a part, from which a program may make up its picture: what it drew for all of it is cast at the
/// first.
GLCAST_EXPORT void glXCopySubBufferMESA(Display* display, GLXDrawable drawable, int x, int y, int width,
                                        int height) {
    if (!real().glXCopySubBufferMESA) return;
    swap(drawable, [=] { real().glXCopySubBufferMESA(display, drawable, x, y, width, height); });
}

GLCAST_EXPORT void glXWaitGL() {
    const Outermost outermost;
    real().glXWaitGL();
    if (outermost) flushed();
}

/// Its lists are made inside the library, where nobody sees them: they hold bitmaps only, never a solid.
GLCAST_EXPORT void glXUseXFont(Font font, int first, int count, int list) {
    if (shadows_calls()) say_once("lists made by glXUseXFont are not recorded (they hold text)");
    real().glXUseXFont(font, first, count, list);
    if (shadows_calls()) lists_made_elsewhere(GLuint(list), count);
}

GLCAST_EXPORT const char* glXQueryExtensionsString(Display* display, int screen) {
    return told_window_extensions(real().glXQueryExtensionsString(display, screen));
}

GLCAST_EXPORT const char* glXGetClientString(Display* display, int name) {
    const char* text = real().glXGetClientString(display, name);
    return name == GLX_EXTENSIONS ? told_window_extensions(text) : text;
}

GLCAST_EXPORT const char* glXQueryServerString(Display* display, int screen, int name) {
    const char* text = real().glXQueryServerString(display, screen, name);
    return name == GLX_EXTENSIONS ? told_window_extensions(text) : text;
}

} // extern "C"
