#include "shim/preload/real.h"

#include <dlfcn.h>

#include <cstring>

#include "shim/preload/session.h"
#include "shim/preload/status.h"
#include "shim/preload/stub.h"

extern "C" {
extern const char __ehdr_start __attribute__((visibility("hidden")));
extern const char _end __attribute__((visibility("hidden")));
}

namespace glcast::preload {
namespace {

/// In the order in which they are asked. glvnd's libGL and libOpenGL have the same functions.
constexpr const char* gl_libraries[] = {"libGL.so.1",     "libOpenGL.so.0", "libGLX.so.0",   "libEGL.so.1",
                                        "libGLESv2.so.2", "libOSMesa.so.8", "libOSMesa.so.6"};

void* find_in_loaded_libraries(const char* name) {
    for (const char* library : gl_libraries) {
        void* handle = real_dlopen()(library, RTLD_LAZY | RTLD_NOLOAD);
        if (!handle) continue;
        void* function = real_dlsym()(handle, name);
        dlclose(handle);
        if (function && !is_own(function)) return function;
    }
    return nullptr;
}

} // namespace

void* find_symbol(const char* name) {
    void* next = real_dlsym()(RTLD_NEXT, name);
    if (next && !is_own(next)) return next;
    return find_in_loaded_libraries(name);
}

namespace {

GlProc ask_get_proc_address(const char* name) {
    using GetProcAddress = GlProc (*)(const char*);
    for (const char* get_name : {"glXGetProcAddressARB", "eglGetProcAddress"}) {
        if (get_name[0] != name[0] && name[0] != 'g') continue; // egl* names: EGL alone
        if (auto get = reinterpret_cast<GetProcAddress>(find_symbol(get_name)))
            if (GlProc function = get(name)) return function;
    }
    return nullptr;
}

std::uintptr_t do_nothing() { return 0; }

GlProc real_or_nothing(const char* name) {
    if (GlProc function = find_real(name)) return function;
    return reinterpret_cast<GlProc>(do_nothing);
}

GlProc& slot(GlTable& table, GlCall call) {
    return reinterpret_cast<GlProc*>(&table)[static_cast<std::size_t>(call)];
}

} // namespace

bool is_own(const void* code) { return code >= &__ehdr_start && code < &_end; }

GlProc find_real(const char* name) {
    GlProc function = reinterpret_cast<GlProc>(find_symbol(name));
    if (!function) function = ask_get_proc_address(name);
    if (!is_own(reinterpret_cast<const void*>(function))) return function;
    say_once("found itself where it looked for %s: that call does nothing", name);
    return nullptr;
}

const GlTable& real_table() {
    static const GlTable table = load_gl_table(real_or_nothing);
    return table;
}

const GlTable& resolve(GlCall call) {
    if (shadows_calls() && record::always_shadowed(call)) return recording_table();
    const GlProc function = real_or_nothing(gl_call_names[static_cast<std::size_t>(call)]);
    __atomic_store_n(&slot(idle, call), function, __ATOMIC_RELAXED);
    return idle;
}

} // namespace glcast::preload
