// A thread of our own that waits for the key, the signal or the time, nudges a program that does not draw,
// and casts what stands in its window. Only started when one of these is asked for.
#pragma once
#include <functional>
#include <string>

#include "shim/preload/options.h"

namespace glcast::preload {

/// What the watcher looks at and tells; all may be called from its thread.
struct Watched {
    std::function<bool()> over;    ///< nothing will be cast any more: the thread ends
    std::function<bool()> waiting; ///< a frame is wanted
    std::function<long()> frames;  ///< that have ended so far
    std::function<void()> fire;    ///< the key was pressed
    std::function<void()> look_for_signals;
    std::function<void()> cast_at_rest; ///< if a frame is wanted and none comes
};

/// `display` as in $DISPLAY. Nothing to stop: it ends with the process.
void start_watcher(const Options& options, const std::string& display, Watched watched);

} // namespace glcast::preload
