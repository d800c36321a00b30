// Which of our functions a program gets when it asks by name.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast::preload {

/// Our function of this name, or null: a GL call, or one of the GLX and EGL calls that are interposed.
GlProc find_ours(const char* name);

/// Is this code of a GL library or driver? Those get the real functions.
bool in_gl_library(const void* code);

/// Is this code of OSMesa, which has GL calls of its own?
bool in_osmesa(const void* code);

/// What a GetProcAddress returns: ours in place of `real`, where there is one and the caller is not a GL
/// library.
GlProc ours_instead(const char* name, GlProc real, const void* caller);

struct Lookup {
    bool decided; ///< false: the real dlsym must answer, called as if by the program
    void* address;
};
/// For dlsym with any handle but RTLD_NEXT: our function, if the program would have found the real one.
Lookup look_up_ours(void* handle, const char* name, const void* caller);

/// For dlopen: RTLD_DEEPBIND is dropped for a library that links GL, because its calls would go past us.
int adjust_dlopen_flags(const char* file, int flags);

} // namespace glcast::preload
