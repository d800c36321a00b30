// From a recorded frame to a capture on disk, in the swap that ended the frame.
#pragma once
#include <string>

#include "shim/preload/options.h"
#include "shim/record/record.h"

namespace glcast::preload {

struct NativeContext;

enum class CastOutcome { captured, listed, nothing_solid, failed };
struct CastResult {
    CastOutcome outcome;
    std::string message; ///< for people; empty for nothing_solid
};

/// On the thread where the program's context is current; that context and its drawables are so again
/// afterwards.
CastResult cast_frame(NativeContext& context, const record::Frame& frame, long number,
                      const Options& options);

} // namespace glcast::preload
