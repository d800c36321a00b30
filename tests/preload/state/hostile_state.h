// A context in which hardly anything is as it was at the start.
#pragma once
#include "capture/gl/gl_table.h"
#include "tests/preload/state/every_query.h"

namespace glcast::test {

/// Changes state of every kind that a compatibility context of GL 4.5 has. Leaves no error. `fill_0`: the texture
/// named 0 gets an image too.
void set_hostile_state(const GlTable& gl, bool fill_0);

/// Where its client arrays, select and feedback buffers lie.
Memory client_memory();

} // namespace glcast::test
