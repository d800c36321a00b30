// A driver that lacks something, played on one that has it.
#pragma once
#include "capture/gl/override_table.h"

namespace glcast::preload {

/// What GLCAST_MASK takes away from the capture's view of the driver; the program's stays whole.
struct Mask {
    bool floats = false; ///< float: no floating-point colour targets
    bool framebuffers =
        false; ///< fbo: no framebuffer objects, though the entry points are there, as glvnd has them
    bool queries = false; ///< queries: none counts samples
    bool any() const { return floats || framebuffers || queries; }
};

extern const OverrideRules mask_rules;

/// `real`, less what the mask takes away. Kept for the life of the process: one mask a process.
const GlTable& masked_table(const GlTable& real, const Mask& mask);

} // namespace glcast::preload
