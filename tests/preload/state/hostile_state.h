// A context in which hardly anything is as it was at the start.
#pragma once
#include "capture/gl/gl_table.h"
#include "tests/preload/state/every_query.h"

namespace glcast::test {

/// Changes state of every kind that a compatibility context of GL 4.5 has. Leaves no error.
void set_hostile_state(const GlTable& gl);

/// Where its client arrays, select and feedback buffers lie.
Memory client_memory();

} // namespace glcast::test
