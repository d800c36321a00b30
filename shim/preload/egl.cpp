// EGL: the calls that make, drop, choose and show contexts. Contexts of OpenGL ES are let through unseen.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <optional>
#include <vector>

#include "shim/preload/lookup.h"
#include "shim/preload/pretence.h"
#include "shim/preload/real.h"
#include "shim/preload/session.h"
#include "shim/preload/stub.h"
#include "shim/preload/window_entries.h"

extern "C" {
EGLBoolean eglSwapBuffersWithDamageKHR(EGLDisplay, EGLSurface, const EGLint*, EGLint);
EGLBoolean eglSwapBuffersWithDamageEXT(EGLDisplay, EGLSurface, const EGLint*, EGLint);
}

namespace glcast::preload {
namespace {

#define GLCAST_EGL_CALLS(X)                                                                                  \
    X(eglGetProcAddress)                                                                                     \
    X(eglCreateContext)                                                                                      \
    X(eglDestroyContext)                                                                                     \
    X(eglMakeCurrent)                                                                                        \
    X(eglReleaseThread)                                                                                      \
    X(eglCreateWindowSurface)                                                                                \
    X(eglCreatePbufferSurface)                                                                               \
    X(eglCreatePixmapSurface)                                                                                \
    X(eglSwapBuffers)                                                                                        \
    X(eglSwapBuffersWithDamageKHR)                                                                           \
    X(eglSwapBuffersWithDamageEXT)                                                                           \
    X(eglWaitGL)                                                                                             \
    X(eglWaitClient)

#define GLCAST_EGL_QUERIES(X)                                                                                \
    X(eglBindAPI)                                                                                            \
    X(eglQueryAPI)                                                                                           \
    X(eglQuerySurface)                                                                                       \
    X(eglGetError)                                                                                           \
    X(eglGetCurrentContext)                                                                                  \
    X(eglGetCurrentDisplay)                                                                                  \
    X(eglGetCurrentSurface)

GLCAST_DEFINE_REAL_CALLS(GLCAST_EGL_CALLS, GLCAST_EGL_QUERIES)

/// Requests of ours are made for desktop GL and leave the thread's API as it was.
class DesktopApi {
  public:
    DesktopApi() : before(real().eglQueryAPI()) { real().eglBindAPI(EGL_OPENGL_API); }
    ~DesktopApi() { real().eglBindAPI(before); }
    DesktopApi(const DesktopApi&) = delete;
    DesktopApi& operator=(const DesktopApi&) = delete;

  private:
    const EGLenum before;
};

std::uintptr_t as_number(EGLSurface surface) { return reinterpret_cast<std::uintptr_t>(surface); }
EGLSurface as_surface(std::uintptr_t number) { return reinterpret_cast<EGLSurface>(number); }

class Egl : public WindowSystem {
  public:
    const char* name() const override { return "EGL"; }

    Binding current() const override {
        return {real().eglGetCurrentDisplay(), as_number(real().eglGetCurrentSurface(EGL_DRAW)),
                as_number(real().eglGetCurrentSurface(EGL_READ)), real().eglGetCurrentContext()};
    }
    bool bind(const Binding& b) const override {
        const DesktopApi api;
        return real().eglMakeCurrent(b.display, as_surface(b.draw), as_surface(b.read), b.context);
    }
    bool can_return_to(const Binding& b) const override {
        EGLint id = 0;
        bool alive = true;
        for (const std::uintptr_t surface : {b.draw, b.read})
            alive &=
                surface == 0 || real().eglQuerySurface(b.display, as_surface(surface), EGL_CONFIG_ID, &id);
        if (!alive) real().eglGetError(); // ours
        return alive;
    }
    std::uint32_t window_of(std::uintptr_t) const override { return 0; }
    std::string server(void*) const override { return {}; }
    void destroy(void* display, void* context) const override { real().eglDestroyContext(display, context); }
};
const Egl egl;

std::vector<EGLint> copy_attributes(const EGLint* attributes) {
    std::vector<EGLint> copy;
    for (; attributes && *attributes != EGL_NONE; attributes += 2)
        copy.insert(copy.end(), {attributes[0], attributes[1]});
    copy.push_back(EGL_NONE);
    return copy;
}

template <class Swap> EGLBoolean swap(EGLSurface surface, const Swap& real_swap) {
    const Outermost outermost;
    if (outermost) before_swap(as_number(surface));
    const EGLBoolean done = real_swap();
    if (outermost) after_swap(as_number(surface));
    return done;
}

} // namespace

GLCAST_DEFINE_WINDOW_ENTRIES(egl_entries, GLCAST_EGL_CALLS)

} // namespace glcast::preload

using namespace glcast;
using namespace glcast::preload;

extern "C" {

GLCAST_EXPORT __eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
    return ours_instead(name, real().eglGetProcAddress(name), __builtin_return_address(0));
}

GLCAST_EXPORT EGLContext eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                          const EGLint* attributes) {
    const Outermost outermost;
    const bool desktop = real().eglQueryAPI() == EGL_OPENGL_API;
    std::optional<std::vector<int>> refused;
    if (desktop && outermost)
        refused =
            refused_attributes(attributes, EGL_NONE, EGL_CONTEXT_MAJOR_VERSION, EGL_CONTEXT_MINOR_VERSION);
    const EGLContext context =
        real().eglCreateContext(display, config, share, refused ? refused->data() : attributes);
    if (!context || !outermost) return context;
    std::function<void*()> make_sibling;
    if (desktop) {
        make_sibling = [=, copy = copy_attributes(attributes)]() -> void* {
            const DesktopApi api;
            return real().eglCreateContext(display, config, context, copy.data());
        };
    }
    context_made(egl, display, context, share, std::move(make_sibling));
    return context;
}

GLCAST_EXPORT EGLBoolean eglDestroyContext(EGLDisplay display, EGLContext context) {
    const Outermost outermost;
    if (outermost && !context_destroyed(display, context)) return EGL_TRUE;
    return real().eglDestroyContext(display, context);
}

GLCAST_EXPORT EGLBoolean eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read,
                                        EGLContext context) {
    const Outermost outermost;
    if (outermost) before_leaving();
    const EGLBoolean done = real().eglMakeCurrent(display, draw, read, context);
    if (done && outermost) made_current({display, as_number(draw), as_number(read), context});
    return done;
}

GLCAST_EXPORT EGLBoolean eglReleaseThread() {
    const Outermost outermost;
    if (outermost) before_leaving();
    const EGLBoolean done = real().eglReleaseThread();
    if (done && outermost) made_current({});
    return done;
}

GLCAST_EXPORT EGLSurface eglCreateWindowSurface(EGLDisplay display, EGLConfig config,
                                                EGLNativeWindowType window, const EGLint* attributes) {
    const Outermost outermost;
    const EGLSurface made = real().eglCreateWindowSurface(display, config, window, attributes);
    // Under Wayland it is a pointer, and of no use to the X server.
    if (outermost) surface_made(as_number(made), std::uint32_t(std::uintptr_t(window)));
    return made;
}

GLCAST_EXPORT EGLSurface eglCreatePbufferSurface(EGLDisplay display, EGLConfig config,
                                                 const EGLint* attributes) {
    const Outermost outermost;
    const EGLSurface made = real().eglCreatePbufferSurface(display, config, attributes);
    if (outermost) offscreen_made(as_number(made), true);
    return made;
}

GLCAST_EXPORT EGLSurface eglCreatePixmapSurface(EGLDisplay display, EGLConfig config,
                                                EGLNativePixmapType pixmap, const EGLint* attributes) {
    const Outermost outermost;
    const EGLSurface made = real().eglCreatePixmapSurface(display, config, pixmap, attributes);
    if (outermost) offscreen_made(as_number(made), false);
    return made;
}

GLCAST_EXPORT EGLBoolean eglSwapBuffers(EGLDisplay display, EGLSurface surface) {
    return swap(surface, [=] { return real().eglSwapBuffers(display, surface); });
}

GLCAST_EXPORT EGLBoolean eglSwapBuffersWithDamageKHR(EGLDisplay display, EGLSurface surface,
                                                     const EGLint* rects, EGLint count) {
    if (!real().eglSwapBuffersWithDamageKHR) return EGL_FALSE;
    return swap(surface, [=] { return real().eglSwapBuffersWithDamageKHR(display, surface, rects, count); });
}

GLCAST_EXPORT EGLBoolean eglSwapBuffersWithDamageEXT(EGLDisplay display, EGLSurface surface,
                                                     const EGLint* rects, EGLint count) {
    if (!real().eglSwapBuffersWithDamageEXT) return EGL_FALSE;
    return swap(surface, [=] { return real().eglSwapBuffersWithDamageEXT(display, surface, rects, count); });
}

GLCAST_EXPORT EGLBoolean eglWaitGL() {
    const Outermost outermost;
    const EGLBoolean done = real().eglWaitGL();
    if (outermost) flushed();
    return done;
}

GLCAST_EXPORT EGLBoolean eglWaitClient() {
    const Outermost outermost;
    const EGLBoolean done = real().eglWaitClient();
    if (outermost) flushed();
    return done;
}

} // extern "C"
