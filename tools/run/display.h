// An X server of our own, for a program that should not meet the user's screen.
#pragma once
#include <sys/types.h>

#include <string>

namespace glcast::run {

class Display {
  public:
    Display() = default;
    ~Display() { stop(); }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// Starts Xvfb on a free display and waits until it takes clients. Returns one clear line on failure.
    std::string start();
    /// Ends it by its process id and waits for it. Also safe when it was never started.
    void stop();

    const std::string& name() const { return display; } ///< ":1", for DISPLAY
    pid_t pid() const { return server; }

  private:
    pid_t server = -1;
    std::string display;
};

} // namespace glcast::run
