// A frame on second contexts beside the program's: what it draws, group by group, into tables of ours.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "capture/engine.h"
#include "shim/preload/choice.h"
#include "shim/preload/patience.h"
#include "shim/preload/scene_shapes.h"
#include "shim/preload/sibling_scope.h"

namespace glcast::preload {

class FrameReplay {
  public:
    /// All must outlive it. `of` is not empty. `at_rest`: as in CastWindow.
    FrameReplay(const std::vector<FramePart>& of, const Options& options, Patience& patience, bool at_rest);

    /// Asked of GL itself: glvnd has the entry points in any case.
    bool can_draw();

    /// Finds the groups of each part, with a replay that draws nothing.
    void analyse();
    /// The groups of all parts, each place once.
    std::vector<Candidate> candidates() const;

    /// Makes a second context current in which all that the group draws is there.
    void enter_for(const Candidate& candidate);

    /// The parts that draw something of the group.
    std::vector<ScenePart> parts_of(const Candidate& candidate);

    /// Draws what is wanted of a group, which must live as long.
    DrawFunction drawing(const Candidate& candidate, const Wanted& wanted) const;

    /// What was called in those parts and not recorded, with how often.
    std::map<std::string, long> not_understood(const Candidate& candidate) const;

    const std::vector<Scene>& all_scenes() const { return scenes; }
    const std::vector<FramePart>& all_parts() const { return parts; }

    /// Deletes the textures that replays have made, which lie in the program's share group. Where nothing was
    /// found and nothing drawn, the second contexts are kept for the next frame.
    void end(bool found_nothing) noexcept;

    const GlTable& gl;
    Patience& patience;

  private:
    const std::vector<FramePart>& parts;
    const Options& options;
    SiblingScope siblings;
    std::vector<Scene> scenes;
    mutable bool has_drawn = false;
};

} // namespace glcast::preload
