// From a recorded frame to a capture on disk, in the swap that ended the frame.
#pragma once
#include <string>
#include <vector>

#include "shim/preload/census.h"
#include "shim/preload/options.h"
#include "shim/record/record.h"

namespace glcast::preload {

struct FramePart;

enum class CastOutcome { captured, listed, nothing_solid, failed };
struct CastResult {
    CastOutcome outcome;
    std::string message; ///< for people; empty for nothing_solid
    Census held = {};    ///< what the frame held, for nothing_solid
};

/// On a thread where a context of the program's may be current; it and its drawables are so again afterwards.
/// `parts` is not empty.
CastResult cast_frame(const std::vector<FramePart>& parts, long number, const Options& options);

} // namespace glcast::preload
