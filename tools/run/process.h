// Starting and ending processes by id, without sleeping.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace glcast::run {

/// SIGINT, SIGTERM, SIGHUP and SIGCHLD come through the returned descriptor instead of handlers. Once, at
/// start.
int take_signals();
void unblock_signals(); ///< in a child, before exec

/// SIGTERM, then SIGKILL after the grace; waits until `pid`, a child of ours, has gone and been reaped.
void end_process(pid_t pid, int grace_ms);

using Environment = std::vector<std::pair<std::string, std::string>>; ///< empty value: unset

/// The program with whatever it starts: a session and process group of its own, and orphans come to us. What
/// left the group (a daemon, like the D-Bus that desktop programs start) does not keep the program alive;
/// `end_strays` says whether such processes end with it.
class Program {
  public:
    explicit Program(bool end_strays) : end_strays(end_strays) {}
    ~Program() { end(0); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// Returns one clear line when it cannot be started.
    std::string start(const std::string& file, const std::vector<std::string>& arguments,
                      const Environment& changes);
    /// Waits for children that have ended, without blocking.
    void reap();
    void spare(pid_t pid) { spared = pid; } ///< a child of ours that is not the program's
    bool alive() const;                     ///< any process of its group, also when the first one has gone
    void signal(int number) const;          ///< to the whole group
    /// Files that processes of its group run now, each once; of those that we may not look into, as they were called.
    std::vector<std::filesystem::path> running() const;
    /// SIGTERM to the group, SIGKILL to what is left after the grace. Safe to call again.
    void end(int grace_ms);

    int wait_status() const { return status; } ///< of the first process; -1 while it runs

  private:
    void kill_strays();

    bool end_strays;
    pid_t leader = -1;
    pid_t spared = -1;
    int status = -1;
};

} // namespace glcast::run
