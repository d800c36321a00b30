// dlsym and dlopen. Both end in a tail call of the real one, so that the C library sees the program as the
// caller: RUNPATH, $ORIGIN, RTLD_NEXT and RTLD_DEFAULT depend on it (VirtualGL #107, #227, #250, #266). This
// file is always compiled with -O2 and without sanitizers; a test looks at its disassembly.
#include <dlfcn.h>

#include "shim/preload/lookup.h"
#include "shim/preload/real.h"
#include "shim/preload/stub.h"

using namespace glcast::preload;

extern "C" GLCAST_EXPORT void* dlsym(void* handle, const char* name) noexcept {
    if (Lookup found = look_up_ours(handle, name, __builtin_return_address(0)); found.decided)
        return found.address;
    return real_dlsym()(handle, name);
}

extern "C" GLCAST_EXPORT void* dlopen(const char* file, int flags) noexcept {
    return real_dlopen()(file, adjust_dlopen_flags(file, flags));
}
