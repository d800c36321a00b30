// Calls that a GL 1.0-2.1 program may make and that would spoil a pass if they came through.
#pragma once
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::test {

struct HostileCall {
    const char* name;
    void (*call)(const GlTable& gl);
    bool harmless_here = false; ///< with float targets of one sample, and one small scene, in OSMesa
};
const std::vector<HostileCall>& hostile_calls();

} // namespace glcast::test
