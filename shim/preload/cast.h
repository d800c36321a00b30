// From a recorded frame to a capture on disk, in the swap that ended the frame.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shim/preload/census.h"
#include "shim/preload/options.h"
#include "shim/preload/windows.h"
#include "shim/record/record.h"

namespace glcast::preload {

struct FramePart;

enum class CastOutcome { captured, listed, nothing_solid, not_better, failed };
struct CastResult {
    CastOutcome outcome;
    std::string message;                         ///< for people; empty for nothing_solid
    Census held = {};                            ///< what the frame held, for nothing_solid
    std::optional<Rating> rating = std::nullopt; ///< of captured and listed
};

inline CastResult failure(const std::string& why) {
    return {CastOutcome::failed, "nothing captured: " + why};
}

/// The window in which a frame has ended, among others.
struct CastWindow {
    std::string name;              ///< as people are told; empty where there is no other
    std::optional<Rating> to_beat; ///< what another window's cast is worth, which this one would replace
    bool replaces = false;         ///< what is captured so far
    long unanswered = 0;           ///< questions about windows that the X server left open
    long unseen = 0;      ///< frames that came after it and were not recorded, before one without a solid
    bool at_rest = false; ///< on a thread of ours, with second contexts that are there already
};

/// On a thread where a context of the program's may be current; it and its drawables are so again afterwards.
/// `parts` is not empty. The groups of the frame are added to `listed` when they are listed.
CastResult cast_frame(const std::vector<FramePart>& parts, long number, const Options& options,
                      const CastWindow& window, std::vector<Candidate>& listed);

} // namespace glcast::preload
