// The functions that our exported ones stand in front of.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast::preload {

/// dlsym and dlopen of whoever comes after us: the C library, or another preload.
using DlsymFunction = void* (*)(void* handle, const char* name) noexcept; // or they would not be tail-called
using DlopenFunction = void* (*)(const char* file, int flags) noexcept;
DlsymFunction real_dlsym();
DlopenFunction real_dlopen();

/// The function which a program would reach by this name without us, in libraries that it has loaded: as a
/// linked symbol, in a GL library loaded by dlopen, or from glXGetProcAddress or eglGetProcAddress. Null when
/// there is none. Loads nothing.
GlProc find_real(const char* name);

/// The same, of symbols alone.
void* find_symbol(const char* name);

/// Every GL call looked up. What nobody has is a function that does nothing and returns 0.
const GlTable& real_table();

/// Is this code of our own library?
bool is_own(const void* code);

template <class Function> void find_real(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(find_real(name));
}

} // namespace glcast::preload
