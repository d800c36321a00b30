// Asks the program's own view how draws lie to what marked the stencil buffer (stencil_plan.h).
#pragma once
#include "capture/gl/override_table.h"
#include "shim/preload/stencil_plan.h"
#include "shim/record/record.h"

namespace glcast::preload {

/// Draws the group's marks, and each draw in question over them, into a small framebuffer of ours in the
/// current context, as the program looks at them, and counts fragments. Without occlusion queries every
/// question stays open. A frame without questions draws nothing.
void judge(const GlTable& gl, const record::Frame& frame, Scene& scene, int group, StencilPlan& plan);

extern const OverrideRules judge_rules;

} // namespace glcast::preload
