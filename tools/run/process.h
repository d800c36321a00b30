// Starting and ending processes by id, without sleeping.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
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

/// What a command of ours said, and how it ended: its exit status, 128 + the signal that ended it, 127 when
/// it could not be started.
struct Answer {
    int status = 127;
    std::string errors; ///< its standard error
};
Answer ask(const std::vector<std::string>& command);

/// Starts a command of ours: in a group of its own, so that Ctrl-C on the terminal comes to us alone; it ends
/// with us; nothing to read; standard output into `output`, where that is a descriptor. Returns its process
/// id, -1 on failure.
pid_t start_command(const std::vector<std::string>& command, int output = -1);

/// All of a file of ours in memory, from its beginning; it is closed.
std::string take_text(int file);

/// As a shell tells it.
int exit_status(int wait_status);

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

    /// Returns one clear line when it cannot be started. `output`: where its standard output goes; -1: where
    /// ours does.
    std::string start(const std::string& file, const std::vector<std::string>& arguments,
                      const Environment& changes, int output = -1);
    /// Waits for children that have ended, without blocking.
    void reap();
    void spare(pid_t pid) { spared[pid]; } ///< a child of ours that is not the program's
    /// The wait status of a spared child that reap() has met, once.
    std::optional<int> take_ended(pid_t pid);
    pid_t id() const { return leader; } ///< of the first process
    bool alive() const;                 ///< any process of its group, also when the first one has gone
    void signal(int number) const;      ///< to the whole group
    /// Files that processes of its group run now, each once; of those that we may not look into, as they were
    /// called.
    std::vector<std::filesystem::path> running() const;
    /// SIGTERM to the group, SIGKILL to what is left after the grace. Safe to call again.
    void end(int grace_ms);

    int wait_status() const { return status; } ///< of the first process; -1 while it runs

  private:
    void kill_strays();

    bool end_strays;
    pid_t leader = -1;
    std::map<pid_t, std::optional<int>> spared; ///< with the wait status of those that have ended
    int status = -1;
};

} // namespace glcast::run
