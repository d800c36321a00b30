// When frames are to be cast: from the start, at a key, at a signal; how many in all.
#pragma once
#include <atomic>

#include "shim/preload/options.h"

namespace glcast::preload {

class Triggers {
  public:
    explicit Triggers(const Options& options);

    /// A frame is owed: the next with solid geometry is to be cast.
    bool waiting() const { return owed > 0 && left > 0; }
    /// Nothing will be cast any more.
    bool over() const { return left.load(std::memory_order_relaxed) <= 0; }
    /// One frame more is wanted. From any thread.
    void fire();
    /// One frame that was owed is cast, or lost for good. True when it was the last of all.
    bool taken();
    void give_up();

    /// Signals that came since the last look count as triggers. Also puts our handler in place, before whatever
    /// handler the program has set meanwhile, which it calls.
    void look_for_signals();

  private:
    const int signal;
    std::atomic<long> left, owed;
};

} // namespace glcast::preload
