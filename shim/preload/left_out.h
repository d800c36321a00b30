// The draws of a recorded frame's scene that are solid by their state and are not cast: backdrops
// (backdrop.h) and outlines (outline.h). They are marked in the scenes (Draw::left_out).
#pragma once
#include <span>
#include <string>

#include "shim/preload/scene_shapes.h"

namespace glcast::preload {

struct LeftOut {
    long draws = 0;    ///< that were solid so far
    std::string lines; ///< that tell of them, and of backdrops that are known by their state alone; empty
                       ///< where there are none
};

/// Where there may be some. GL is asked only then: Mesa takes 50 ms to make ready for feedback.
struct MayHave {
    bool backdrops = false, outlines = false;
};

/// What is drawn covers half of the window (`coverage`), or its box reaches beyond it, or something is
/// pinned.
bool may_have_backdrops(std::span<const ScenePart> parts, const EngineOptions& engine, double coverage);

/// `engine.box`: around all that is drawn. In the current context.
LeftOut leave_out(std::span<const ScenePart> parts, const GlTable& gl, const EngineOptions& engine,
                  MayHave may_have);

} // namespace glcast::preload
