// X errors of requests of our own.
#pragma once
#include <atomic>
#include <string>

namespace glcast::preload {

/// While one lives, X errors raised by requests sent since on this display are kept from the program's
/// handler, which may end the program. All others go on to it. Threads may have traps at the same time
/// (piglit's glx-multithread-clearbuffer). Uses the program's libX11; does nothing without it.
class XErrorTrap {
  public:
    explicit XErrorTrap(void* display);
    ~XErrorTrap();
    XErrorTrap(const XErrorTrap&) = delete;
    XErrorTrap& operator=(const XErrorTrap&) = delete;

    /// Waits for the server's answer to everything sent so far.
    bool failed();

    /// Of the handler: whether an error of that request is this trap's, which then has failed.
    bool catches(const void* on, unsigned long request);

  private:
    void* const display;
    unsigned long first_request = 0;
    std::atomic<bool> has_failed{false};
};

/// Whether a window or pixmap exists. True where it cannot be asked.
bool x_drawable_exists(void* display, unsigned long drawable);

/// As in $DISPLAY; empty where it cannot be asked.
std::string x_display_name(void* display);

} // namespace glcast::preload
