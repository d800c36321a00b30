// What the shim tells (shim/preload/status.h has the lines), and the pipe it comes through.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace glcast::run {

/// What is known of the program's drawing so far.
struct Seen {
    std::string hooked;          ///< "GLX program" or "EGL program", empty while no GL was seen
    std::set<long> gl_processes; ///< the processes that said so
    std::string capture;         ///< path of the complete capture
    std::string failed;          ///< why there will be none
    std::string at_exit;         ///< what a process with GL had seen when it ended
    std::vector<std::string> groups;
    std::string listed; ///< of which frame all groups are told

    bool finished() const { return !capture.empty() || !listed.empty() || !failed.empty(); }
};

/// Takes one line in, "PID EVENT TEXT"; events that are not known are skipped.
void take_line(const std::string& line, Seen& seen);

/// Why there is no capture, in one line. `ending` says how the wait ended: "the program ended", "gave up
/// after 120 s".
std::string describe_failure(const Seen& seen, const std::string& ending);

/// A named pipe in a folder of its own, both gone with it. The folder also holds what else a run needs.
class StatusPipe {
  public:
    StatusPipe();
    ~StatusPipe();
    StatusPipe(const StatusPipe&) = delete;
    StatusPipe& operator=(const StatusPipe&) = delete;

    bool ok() const { return descriptor >= 0; }
    int file_descriptor() const { return descriptor; }
    std::filesystem::path path() const { return folder / "status"; }
    const std::filesystem::path& scratch() const { return folder; }
    void read_into(Seen& seen); ///< all lines there are, without blocking

  private:
    std::filesystem::path folder;
    int descriptor = -1;
    std::string unfinished;
};

} // namespace glcast::run
