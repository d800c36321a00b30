// The GLX and EGL calls that are interposed; everything else of GLX and EGL is the real thing.
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

} // namespace glcast::preload
