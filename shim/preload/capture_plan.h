// How a group is cast: in which frame and box, with which of its draws, and what the stencil buffer has to do
// with it.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "capture/engine.h"
#include "capture/program_stencil.h"
#include "shim/preload/frame_replay.h"
#include "shim/preload/stencil_plan.h"

namespace glcast::preload {

class CapturePlan {
  public:
    /// Draws the group to find its box, and leaves backdrops and outlines out. All must outlive it.
    CapturePlan(FrameReplay& replay, const Options& options, const Candidate& candidate);
    CapturePlan(const CapturePlan&) = delete;
    CapturePlan& operator=(const CapturePlan&) = delete;

    /// False: nothing of it is solid.
    bool has_box() const { return engine.box.has_value(); }
    /// Nothing is, but it would be if all that is blended were kept.
    bool would_show_blended();

    const EngineOptions& options_of_engine() const { return engine; }
    /// What is cast, in the capture frame of `with`.
    DrawFunction solid(const EngineOptions& with) const;

    const Candidate& candidate;
    /// Places that are seen through culled faces, capture frame.
    const std::vector<glm::dvec3>& seen_places() const { return places; }
    const StencilPlan& stencil_plan() const { return plan; }
    const Sides& sides() const { return both; }

  private:
    EngineOptions start_options() const;
    void follow_stencil();
    void look_at_sides();
    std::vector<glm::dvec3> look_through(const DrawFunction& as_drawn);
    std::optional<Box> find_scene_box(const DrawFunction& draw) const;
    DrawFunction drawing(Wanted wanted) const;
    DrawFunction thickened(const EngineOptions& with) const;

    FrameReplay& replay;
    const Options& options;
    StencilPlan plan;
    Sides both;
    mutable ProgramStencil stencil;
    EngineOptions engine;
    std::vector<glm::dvec3> places;
};

} // namespace glcast::preload
