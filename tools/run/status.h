// What the shim tells (docs/reference/status-lines.md), and the pipe it comes through.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace glcast::run {

struct Capture {
    long frame = 0;
    std::string file;
    std::string figures = {}; ///< how it was made, for --verbose and --json
};

/// What one process has told of its drawing: a script may start several programs.
struct Drawing {
    std::string api;       ///< "GLX", "EGL" or "OSMesa", empty while no GL was seen
    std::string name;      ///< of its program
    int order = 0;         ///< in which their first contexts came
    long frames = 0;       ///< at least so many have ended without a cast
    std::string waits;     ///< what no frame was taken without: "the key F12 was not pressed"
    std::string seen;      ///< instead of a solid, with what to do
    std::string offscreen; ///< where it draws that is no window
    std::string refused;   ///< why a frame could not be recorded, the last one
};

/// What is known so far.
struct Seen {
    std::map<std::string, Drawing> drawings; ///< by process
    std::string started;                     ///< the process that glcast-run has started
    long casting = 0;                        ///< the frame being cast
    std::string figures;                     ///< of the capture that comes next
    std::vector<Capture> captures;           ///< complete, in the order in which they came
    std::string failed;
    std::string slow;       ///< why the cast will take long
    std::string progress;   ///< of a long cast, how far it is; empty: none is under way
    long unsaid = 0;        ///< lines of the library that the program's stderr did not take
    std::string unsaid_why; ///< the last time
    std::vector<std::string> groups;
    bool listed = false;
    bool looking = false; ///< another window may still show something better

    /// All is there that was asked for, or nothing more will come. `wanted` captures, 0: no limit.
    bool finished(long wanted) const {
        if (looking) return false;
        return listed || (wanted > 0 && static_cast<long>(captures.size()) >= wanted) ||
               (wanted == 1 && !failed.empty());
    }
};

/// Of whose drawing there is most to say: the process with most frames, then the one that was started, then
/// the last.
Drawing principal(const Seen& seen);

/// Takes one line in; kinds that are not known are skipped.
void take_line(const std::string& line, Seen& seen);

/// Why there is no capture, in one line. `ending` says how the wait ended: "the program ended", "after 120
/// s".
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
