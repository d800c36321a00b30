// Which glEnable caps a pass keeps, forces or tracks.
#pragma once
#include "capture/forced_state.h"
#include "capture/gl/gl_table.h"

namespace glcast {

enum class CapPolicy {
    keep,   ///< the program's; off when a pass begins, GL's default
    off,    ///< forced off
    engine, ///< the pass sets it before it draws
    track,  ///< the program's value is noted, and what we set follows from it (ForcedState)
};

/// Unknown caps are kept.
CapPolicy cap_policy(GLenum cap, PassKind kind);

/// Put every cap of the table where a pass begins; those of the engine are left alone.
void reset_caps(const GlTable& gl);

} // namespace glcast
