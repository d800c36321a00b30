#include "tools/render/osmesa.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace glcast {
namespace {

struct Library {
    decltype(&OSMesaCreateContextExt) create = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetIntegerv) get = nullptr;
    decltype(&OSMesaGetProcAddress) entry = nullptr;

    Library() {
        void* handle = nullptr;
        for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
            if (!handle) handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (!handle) {
            const char* why = dlerror();
            throw std::runtime_error("cannot draw: no OSMesa (install libosmesa6): " +
                                     std::string(why ? why : ""));
        }
        find(handle, create, "OSMesaCreateContextExt");
        find(handle, destroy, "OSMesaDestroyContext");
        find(handle, make_current, "OSMesaMakeCurrent");
        find(handle, get, "OSMesaGetIntegerv");
        find(handle, entry, "OSMesaGetProcAddress");
    }

    template <class F> static void find(void* handle, F& function, const char* name) {
        function = reinterpret_cast<F>(dlsym(handle, name));
        if (!function) throw std::runtime_error("cannot draw: OSMesa has no " + std::string(name));
    }
};

const Library& library() {
    static const Library loaded;
    return loaded;
}

} // namespace

Osmesa::Osmesa(int size) {
    const Library& osmesa = library();
    context = osmesa.create(OSMESA_RGBA, 24, 0, 0, nullptr);
    if (!context) throw std::runtime_error("cannot draw: OSMesa gives no context");
    pixels.resize(std::size_t(size) * std::size_t(size) * 4);
    if (!osmesa.make_current(static_cast<OSMesaContext>(context), pixels.data(), GL_UNSIGNED_BYTE, size,
                             size)) {
        osmesa.destroy(static_cast<OSMesaContext>(context));
        throw std::runtime_error("cannot draw: OSMesa refuses a picture of " + std::to_string(size) +
                                 " pixels");
    }
    table = load_gl_table([](const char* name) { return reinterpret_cast<GlProc>(library().entry(name)); });
}

Osmesa::~Osmesa() {
    library().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    library().destroy(static_cast<OSMesaContext>(context));
}

const std::vector<std::uint8_t>& Osmesa::finish() {
    table.Finish();
    return pixels;
}

int Osmesa::largest() {
    GLint width = 0, height = 0;
    library().get(OSMESA_MAX_WIDTH, &width);
    library().get(OSMESA_MAX_HEIGHT, &height);
    return std::min(width, height);
}

} // namespace glcast
