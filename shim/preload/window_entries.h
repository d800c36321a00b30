// The calls of GLX, EGL and OSMesa that are interposed; everything else of them is the real thing.
#pragma once
#include <cstddef>
#include <iterator>

#include "capture/gl/gl_table.h"
#include "shim/preload/real.h"

namespace glcast::preload {

struct WindowEntry {
    const char* name;
    GlProc function;
};
struct WindowEntries {
    const WindowEntry* entries;
    std::size_t count;
};
/// X(NAME) for each call of CALLS: of ours.
#define GLCAST_WINDOW_ENTRY(NAME) {#NAME, reinterpret_cast<GlProc>(&::NAME)},
#define GLCAST_DEFINE_WINDOW_ENTRIES(FUNCTION, CALLS)                                                        \
    WindowEntries FUNCTION() {                                                                               \
        static const WindowEntry entries[] = {CALLS(GLCAST_WINDOW_ENTRY)};                                   \
        return {entries, std::size(entries)};                                                                \
    }

/// The real ones, of CALLS and of QUERIES that are asked and not interposed: real().NAME, null where the
/// system has it not.
#define GLCAST_REAL_MEMBER(NAME) decltype(&::NAME) NAME = nullptr;
#define GLCAST_FIND_REAL(NAME) find_real(#NAME, found.NAME);
#define GLCAST_DEFINE_REAL_CALLS(CALLS, QUERIES)                                                             \
    struct RealCalls {                                                                                       \
        CALLS(GLCAST_REAL_MEMBER)                                                                            \
        QUERIES(GLCAST_REAL_MEMBER)                                                                          \
    };                                                                                                       \
    const RealCalls& real() {                                                                                \
        static const RealCalls table = [] {                                                                  \
            RealCalls found;                                                                                 \
            CALLS(GLCAST_FIND_REAL)                                                                          \
            QUERIES(GLCAST_FIND_REAL)                                                                        \
            return found;                                                                                    \
        }();                                                                                                 \
        return table;                                                                                        \
    }

WindowEntries glx_entries();
WindowEntries egl_entries();
WindowEntries osmesa_entries();

} // namespace glcast::preload
