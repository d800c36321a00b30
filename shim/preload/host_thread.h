// A thread of the program's that works for us for a while, and must not notice.
#pragma once
#include <fenv.h>

namespace glcast::preload {

/// While it lives, this thread has the floating-point environment that programs begin with (nothing trapped,
/// round to nearest, denormals kept, x87 in extended precision), and is not cancelled. Afterwards the
/// program's own is back, with its flags, and its errno.
class HostThread {
  public:
    HostThread();
    ~HostThread();
    HostThread(const HostThread&) = delete;
    HostThread& operator=(const HostThread&) = delete;

  private:
    fenv_t arithmetic;
    int cancel_state = 0, error = 0;
};

} // namespace glcast::preload
