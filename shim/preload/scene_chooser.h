// Which group of a frame's draws is cast, and what is told where none is.
#pragma once
#include <string>
#include <vector>

#include "shim/preload/census.h"
#include "shim/preload/choice.h"
#include "shim/preload/frame_replay.h"
#include "shim/preload/windows.h"

namespace glcast::preload {

class SceneChooser {
  public:
    /// Looks at the frame: analyses it, draws small pictures of its groups and ranks them.
    SceneChooser(FrameReplay& replay, const Options& options);

    /// Best first.
    const std::vector<Candidate>& groups() const { return candidates; }
    bool is_empty() const { return candidates.empty(); }
    /// Is there one that may be cast when nobody asks for it by number?
    bool has_scene() const { return !candidates.empty() && is_scene(candidates.front()); }
    /// The group that is asked for by number, or the best; null where there is none of that number.
    const Candidate* chosen() const;

    Rating rating(const Candidate& candidate) const;
    /// What the frame held, to tell why nothing of it was cast.
    Census held() const;
    /// In one line that --group cannot be followed, and what there is.
    std::string groups_instead() const;

    /// Numbers the groups and tells of each. `window`: its name, where there are others.
    void tell_groups(const std::string& window);

  private:
    Thumbnail picture_of(const Candidate& candidate);

    FrameReplay& replay;
    const Options& options;
    std::vector<Candidate> candidates;
};

} // namespace glcast::preload
