// dlsym and dlopen. Both end in a tail call of the real one, so that the C library sees the program as the
// caller: RUNPATH, $ORIGIN, RTLD_NEXT and RTLD_DEFAULT depend on it (VirtualGL #107, #227, #250, #266). This
// file is always compiled with -O2, and without sanitizers, because they call dlsym before they are ready
// themselves; a test looks at its disassembly.
#include <dlfcn.h>

#include <atomic>

#include "shim/preload/lookup.h"
#include "shim/preload/real.h"
#include "shim/preload/stub.h"

namespace glcast::preload {
namespace {

/// dlsym by version: dlvsym is not interposed by anybody, and no private name of the C library is used.
void* find_dl(const char* name) {
    for (const char* version : {"GLIBC_2.34", "GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.1",
                                "GLIBC_2.0"}) // 2.17: aarch64; 2.1, 2.0: i386
        if (void* function = dlvsym(RTLD_NEXT, name, version)) return function;
    return nullptr;
}

template <class Function> Function cached_dl(std::atomic<Function>& cache, const char* name) {
    Function function = cache.load(std::memory_order_relaxed);
    if (!function) {
        function = reinterpret_cast<Function>(find_dl(name));
        cache.store(function, std::memory_order_relaxed);
    }
    return function;
}

} // namespace

DlsymFunction real_dlsym() {
    static constinit std::atomic<DlsymFunction> cache{nullptr};
    return cached_dl(cache, "dlsym");
}

DlopenFunction real_dlopen() {
    static constinit std::atomic<DlopenFunction> cache{nullptr};
    return cached_dl(cache, "dlopen");
}

} // namespace glcast::preload

using namespace glcast::preload;

extern "C" GLCAST_EXPORT void* dlsym(void* handle, const char* name) noexcept {
    if (handle == RTLD_NEXT) return real_dlsym()(handle, name);
    if (Lookup found = look_up_ours(handle, name, __builtin_return_address(0)); found.decided)
        return found.address;
    return real_dlsym()(handle, name);
}

extern "C" GLCAST_EXPORT void* dlopen(const char* file, int flags) noexcept {
    return real_dlopen()(file, adjust_dlopen_flags(file, flags));
}
