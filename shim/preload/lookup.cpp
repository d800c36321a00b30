#include "shim/preload/lookup.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>

#include "shim/preload/elf_file.h"
#include "shim/preload/pretence.h"
#include "shim/preload/real.h"
#include "shim/preload/stub.h"
#include "shim/preload/window_entries.h"

namespace glcast::preload {
namespace {

constexpr const char* gl_library_prefixes[] = {"libGL.",     "libGL-",        "libGLX",    "libEGL",
                                               "libOpenGL.", "libGLdispatch", "libGLES",   "libgallium",
                                               "libOSMesa",  "libglapi",      "libnvidia-"};

const char* file_name(const char* path) {
    const char* slash = std::strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool is_gl_library(const char* path) {
    const char* name = file_name(path);
    for (const char* prefix : gl_library_prefixes)
        if (std::strncmp(name, prefix, std::strlen(prefix)) == 0) return true;
    return std::strstr(name, "_dri.so") != nullptr;
}

/// The names of gl_call_names are sorted.
GlProc find_stub(const char* name) {
    const auto end = gl_call_names + gl_call_count;
    const auto at = std::lower_bound(gl_call_names, end, name,
                                     [](const char* a, const char* b) { return std::strcmp(a, b) < 0; });
    return at != end && std::strcmp(*at, name) == 0 ? stubs[at - gl_call_names] : nullptr;
}

GlProc find_window_entry(const char* name) {
    for (const WindowEntries& list : {glx_entries(), egl_entries(), osmesa_entries()})
        for (std::size_t i = 0; i < list.count; ++i)
            if (std::strcmp(list.entries[i].name, name) == 0) return list.entries[i].function;
    return nullptr;
}

} // namespace

GlProc find_ours(const char* name) {
    if (std::strncmp(name, "glX", 3) == 0 || std::strncmp(name, "egl", 3) == 0 ||
        std::strncmp(name, "OSMesa", 6) == 0)
        return find_window_entry(name);
    if (std::strncmp(name, "gl", 2) == 0) return find_stub(name);
    return nullptr;
}

bool in_gl_library(const void* code) {
    Dl_info info;
    return dladdr(code, &info) && info.dli_fname && is_gl_library(info.dli_fname);
}

bool in_osmesa(const void* code) {
    Dl_info info;
    return dladdr(code, &info) && info.dli_fname &&
           std::strncmp(file_name(info.dli_fname), "libOSMesa", std::strlen("libOSMesa")) == 0;
}

GlProc ours_instead(const char* name, GlProc real, const void* caller) {
    if (!real || !name) return real;
    if (hides_entry(name) && !in_gl_library(caller)) return nullptr;
    GlProc ours = find_ours(name);
    return ours && !in_gl_library(caller) ? ours : real;
}

Lookup look_up_ours(void* handle, const char* name, const void* caller) {
    if (!name) return {false, nullptr};
    const GlProc ours = find_ours(name);
    if (!ours || in_gl_library(caller)) return {false, nullptr};
    const void* found = real_dlsym()(handle, name);
    if (!found) return {false, nullptr};
    // The global scope has our own exports; the program finds them only if it would have found others without
    // us.
    const void* const recorded = find_symbol(name);
    if (is_own(found) && !recorded) return {true, nullptr};
    // A program with two GLs, OSMesa and another: one of them is recorded, calls of the other must not go
    // there.
    if (!is_own(found) && recorded && in_osmesa(found) != in_osmesa(recorded)) return {false, nullptr};
    return {true, reinterpret_cast<void*>(ours)};
}

int adjust_dlopen_flags(const char* file, int flags) {
    if (!(flags & RTLD_DEEPBIND) || !file || is_gl_library(file)) return flags;
    const bool links_gl = any_needed_library(file, [](const char* needed) { return is_gl_library(needed); });
    return links_gl ? flags & ~RTLD_DEEPBIND : flags;
}

} // namespace glcast::preload
