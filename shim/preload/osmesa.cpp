// OSMesa: contexts that draw into the program's own memory. A frame ends where the driver fills that memory
// (glFinish, glFlush), where it is asked for, where another context is made current, and where pixels are
// read.
#include <GL/osmesa.h>

#include <atomic>
#include <map>
#include <mutex>
#include <vector>

#include "shim/preload/lookup.h"
#include "shim/preload/pretence.h"
#include "shim/preload/real.h"
#include "shim/preload/session.h"
#include "shim/preload/status.h"
#include "shim/preload/stub.h"
#include "shim/preload/window_entries.h"

namespace glcast::preload {
namespace {

#define GLCAST_OSMESA_CALLS(X)                                                                               \
    X(OSMesaCreateContext)                                                                                   \
    X(OSMesaCreateContextExt)                                                                                \
    X(OSMesaCreateContextAttribs)                                                                            \
    X(OSMesaDestroyContext)                                                                                  \
    X(OSMesaMakeCurrent)                                                                                     \
    X(OSMesaGetColorBuffer)                                                                                  \
    X(OSMesaGetDepthBuffer)                                                                                  \
    X(OSMesaGetProcAddress)

#define GLCAST_OSMESA_QUERIES(X) X(OSMesaGetCurrentContext)

GLCAST_DEFINE_REAL_CALLS(GLCAST_OSMESA_CALLS, GLCAST_OSMESA_QUERIES)

/// The program's memory that a context draws into.
struct Image {
    void* memory = nullptr;
    GLenum type = GL_UNSIGNED_BYTE;
    GLsizei width = 0, height = 0;
};
struct Images {
    std::mutex mutex;
    std::map<void*, Image> of; ///< by context
};
/// Never destroyed, as the session.
Images& images() {
    static auto* const all = new Images;
    return *all;
}

/// For contexts of ours, which draw to framebuffer objects.
constexpr GLsizei spare_size = 16;
alignas(16) std::uint32_t spare_memory[spare_size * spare_size];

Image image_of(void* context) {
    const std::lock_guard lock(images().mutex);
    const auto at = images().of.find(context);
    return at == images().of.end() ? Image{spare_memory, GL_UNSIGNED_BYTE, spare_size, spare_size}
                                   : at->second;
}

std::uintptr_t as_number(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

class Osmesa : public WindowSystem {
  public:
    const char* name() const override { return "OSMesa"; }

    Binding current() const override {
        void* const context = real().OSMesaGetCurrentContext();
        const std::uintptr_t memory = context ? as_number(image_of(context).memory) : 0;
        return {nullptr, memory, memory, context};
    }
    /// What is drawn goes into the program's memory before its context is left: it is read from there again.
    bool bind(const Binding& binding) const override {
        if (real().OSMesaGetCurrentContext()) real_table().Finish();
        if (!binding.context) return real().OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        const Image image = image_of(binding.context);
        return real().OSMesaMakeCurrent(static_cast<OSMesaContext>(binding.context), image.memory, image.type,
                                        image.width, image.height);
    }
    bool can_return_to(const Binding&) const override { return true; }
    std::uint32_t window_of(std::uintptr_t) const override { return 0; }
    std::string server(void*) const override { return {}; }
    void destroy(void*, void* context) const override {
        real().OSMesaDestroyContext(static_cast<OSMesaContext>(context));
    }
};
const Osmesa osmesa;

/// Whether the recorder's GL is OSMesa's: a program may have another one beside it. The answer is kept, as
/// the stubs keep the functions that they have found.
bool is_recorded() {
    enum Answer { unknown, no, yes };
    static constinit std::atomic<Answer> kept{unknown};
    if (kept == unknown) {
        const void* const finish = find_symbol("glFinish");
        if (!finish) return false;
        kept = in_osmesa(finish) ? yes : no;
    }
    return kept == yes;
}

/// Contexts of ours have a format that fits the spare memory.
template <class Create> OSMesaContext make_context(GLenum format, OSMesaContext share, const Create& create) {
    const Outermost outermost;
    const OSMesaContext context = create(format, share);
    if (!context || !outermost) return context;
    if (!is_recorded()) {
        if (shadows_calls())
            say_once("what OSMesa draws beside another OpenGL of the program is not recorded");
        return context;
    }
    context_made(osmesa, nullptr, context, share, [=]() -> void* { return create(OSMESA_RGBA, context); });
    return context;
}

/// The memory is about to be looked at.
void memory_is_shown() {
    if (real().OSMesaGetCurrentContext() && is_recorded()) before_leaving();
}

} // namespace

GLCAST_DEFINE_WINDOW_ENTRIES(osmesa_entries, GLCAST_OSMESA_CALLS)

} // namespace glcast::preload

using namespace glcast;
using namespace glcast::preload;

extern "C" {

GLCAST_EXPORT OSMESAproc OSMesaGetProcAddress(const char* name) {
    if (!real().OSMesaGetProcAddress) return nullptr;
    const auto found = reinterpret_cast<GlProc>(real().OSMesaGetProcAddress(name));
    return is_recorded()
               ? reinterpret_cast<OSMESAproc>(ours_instead(name, found, __builtin_return_address(0)))
               : reinterpret_cast<OSMESAproc>(found);
}

GLCAST_EXPORT OSMesaContext OSMesaCreateContext(GLenum format, OSMesaContext share) {
    return make_context(format, share,
                        [](GLenum of, OSMesaContext with) { return real().OSMesaCreateContext(of, with); });
}

GLCAST_EXPORT OSMesaContext OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil,
                                                   GLint accumulation, OSMesaContext share) {
    return make_context(format, share, [=](GLenum of, OSMesaContext with) {
        return real().OSMesaCreateContextExt(of, depth, stencil, accumulation, with);
    });
}

GLCAST_EXPORT OSMesaContext OSMesaCreateContextAttribs(const int* attributes, OSMesaContext share) {
    if (!real().OSMesaCreateContextAttribs) return nullptr;
    std::vector<int> copy;
    const auto refused =
        refused_attributes(attributes, 0, OSMESA_CONTEXT_MAJOR_VERSION, OSMESA_CONTEXT_MINOR_VERSION);
    if (refused) attributes = refused->data();
    for (const int* at = attributes; at && *at; at += 2) copy.insert(copy.end(), {at[0], at[1]});
    copy.insert(copy.end(), {0, 0});
    const auto format = [](std::vector<int>& list) -> int* {
        for (std::size_t i = 0; i + 2 < list.size(); i += 2)
            if (list[i] == OSMESA_FORMAT) return &list[i + 1];
        return nullptr;
    };
    const int* const given = format(copy);
    return make_context(given ? GLenum(*given) : OSMESA_RGBA, share, [=](GLenum of, OSMesaContext with) {
        std::vector<int> list = copy;
        if (int* place = format(list)) *place = int(of);
        return real().OSMesaCreateContextAttribs(list.data(), with);
    });
}

GLCAST_EXPORT void OSMesaDestroyContext(OSMesaContext context) {
    const Outermost outermost;
    if (outermost && real().OSMesaGetCurrentContext() == context) memory_is_shown();
    if (outermost && !context_destroyed(nullptr, context)) return;
    {
        const std::lock_guard lock(images().mutex);
        images().of.erase(context);
    }
    real().OSMesaDestroyContext(context);
}

GLCAST_EXPORT GLboolean OSMesaMakeCurrent(OSMesaContext context, void* buffer, GLenum type, GLsizei width,
                                          GLsizei height) {
    const Outermost outermost;
    if (outermost) memory_is_shown();
    const GLboolean done = real().OSMesaMakeCurrent(context, buffer, type, width, height);
    if (!done || !outermost || !is_recorded()) return done;
    if (context) {
        const std::lock_guard lock(images().mutex);
        images().of[context] = {buffer, type, width, height};
    }
    offscreen_made(as_number(buffer), false);
    made_current({nullptr, as_number(buffer), as_number(buffer), context});
    return done;
}

GLCAST_EXPORT GLboolean OSMesaGetColorBuffer(OSMesaContext context, GLint* width, GLint* height,
                                             GLint* format, void** buffer) {
    memory_is_shown();
    return real().OSMesaGetColorBuffer(context, width, height, format, buffer);
}

GLCAST_EXPORT GLboolean OSMesaGetDepthBuffer(OSMesaContext context, GLint* width, GLint* height, GLint* bytes,
                                             void** buffer) {
    memory_is_shown();
    return real().OSMesaGetDepthBuffer(context, width, height, bytes, buffer);
}

} // extern "C"
