// For tests that run programs: an X server of their own, and a child process with a time-out.
#pragma once
#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

namespace glcast::test {

/// A headless X server (Debian: xvfb), 1024x768, 24 bit. Ended with the object, or with the test. Throws
/// std::runtime_error when none comes up within 20 seconds.
class Xvfb {
  public:
    Xvfb();
    ~Xvfb();
    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;

    const std::string& display() const { return name; } ///< ":7"

  private:
    pid_t pid = -1;
    std::string name;
};

struct Command {
    std::vector<std::string> arguments; ///< program first, found in PATH
    std::vector<std::pair<std::string, std::string>>
        environment;             ///< set beside our own; "" takes a variable away
    double timeout_seconds = 60; ///< then it and its children are killed
};

struct Outcome {
    int exit_code = -1; ///< -1 when a signal ended it
    int signal = 0;
    bool timed_out = false;
    std::string out, err; ///< all of stdout and of stderr
};

/// Runs to the end. Throws std::runtime_error when it cannot be started.
Outcome run(const Command& command);

/// A folder of its own below the system's temporary one, gone with the object.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& file) const { return path + "/" + file; }
    const std::string& string() const { return path; }

  private:
    std::string path;
};

} // namespace glcast::test
