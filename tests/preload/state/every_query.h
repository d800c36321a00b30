// Everything that a GL context can be asked.
#pragma once
#include <string>

#include "capture/gl/gl_table.h"

namespace glcast::test {

/// Client memory that pointers are printed relative to: it lies elsewhere in each run.
struct Memory {
    const char* base;
    std::size_t bytes;
};

/// A line for each answer. Every value of gl.xml's enums is put to every query of a compatibility context, in
/// every unit, target, light, face, attribute and attachment; what GL refuses is left out. Then the contents
/// of objects and the names in use. Left out: what changes by itself (clocks, free memory). Changes nothing;
/// wants no GL error to be pending.
std::string every_query(const GlTable& gl, const Memory& memory);

/// What lies below the tops of matrix and attribute stacks, found by popping: the stacks are empty
/// afterwards.
std::string pop_every_stack(const GlTable& gl, const Memory& memory);

} // namespace glcast::test
