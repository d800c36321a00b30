// The calls of GLX, EGL and OSMesa that are interposed; everything else of them is the real thing.
#pragma once
#include <cstddef>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

struct WindowEntry {
    const char* name;
    GlProc function;
};
struct WindowEntries {
    const WindowEntry* entries;
    std::size_t count;
};
WindowEntries glx_entries();
WindowEntries egl_entries();
WindowEntries osmesa_entries();

} // namespace glcast::preload
