// The program stands still while a picture at rest is cast, as it does when a frame of its own is: its
// threads wait where they next call GL.
#pragma once
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace glcast::preload {

namespace detail {
extern constinit std::atomic<bool> gate_is_watched;
}
/// Asked before each call that is recorded.
inline bool calls_wait_at_gate() { return detail::gate_is_watched.load(std::memory_order_relaxed); }

class RestGate {
  public:
    /// By the thread that casts. False where the process is ending. All calls of GL come to pass() from now
    /// on.
    bool close();
    void open();
    /// By a thread of the program's. True for the first after a cast: it is to put away what the cast has
    /// used.
    bool pass();
    /// Waits for the cast that is on; none begins afterwards, until it is opened again.
    void close_for_good();
    void reopen();

  private:
    std::mutex mutex; ///< guards what follows
    std::condition_variable changed;
    bool casting = false, ended = false;
};

} // namespace glcast::preload
