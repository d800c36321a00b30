// The backdrops of a recorded frame's scene: asked of GL, judged by backdrop.h, and marked.
#pragma once
#include <span>
#include <string>

#include "capture/engine.h"
#include "shim/preload/scene.h"

namespace glcast::preload {

/// What one part of a frame draws of the scene.
struct ScenePart {
    const record::Frame& frame;
    Scene& scene;
    int group; ///< index into the scene's groups
};

struct LeftOut {
    long draws = 0;   ///< that were solid so far
    std::string text; ///< a line that tells of them and of those that are known by their state alone; empty
                      ///< where there are none
};

/// Marks the backdrops in the scenes (Draw::backdrop). `engine.box`: around all that is drawn. In the current
/// context. GL is asked only where there may be some: what is drawn covers half of the window (`coverage`),
/// or its box reaches beyond it. Mesa takes 50 ms to make ready for feedback.
LeftOut leave_out_backdrops(std::span<const ScenePart> parts, const GlTable& gl, const EngineOptions& engine,
                            double coverage);

} // namespace glcast::preload
