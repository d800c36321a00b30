// Threads of our own in somebody else's process.
#pragma once
#include <functional>

namespace glcast::preload {

/// Runs `work`, which must not throw, on a thread of its own that nobody joins. The program's signals are not
/// for that thread. False where none can be made: `work` is not run.
bool start_own_thread(std::function<void()> work);

} // namespace glcast::preload
