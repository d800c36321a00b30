#include "tests/real/command.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>

namespace glcast::test {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::vector<std::pair<std::string, std::string>>& environment, int out,
                         int err) {
    setsid();
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(out, 1);
    dup2(err, 2);
    for (const auto& [name, value] : environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    std::vector<char*> argv;
    for (const std::string& word : command) {
        argv.push_back(const_cast<char*>(word.c_str()));
    }
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(127);
}

/// Reads both pipes until both are closed by everyone; false at the deadline.
bool read_both(int out, int err, CommandResult& result, Clock::time_point deadline) {
    pollfd pipes[] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
    std::string* texts[] = {&result.out, &result.err};
    while (pipes[0].fd >= 0 || pipes[1].fd >= 0) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0 || poll(pipes, 2, static_cast<int>(left)) <= 0) {
            return false;
        }
        for (int i = 0; i < 2; ++i) {
            char buffer[4096];
            const ssize_t got =
                pipes[i].fd >= 0 && pipes[i].revents != 0 ? read(pipes[i].fd, buffer, sizeof buffer) : -1;
            if (got > 0) {
                texts[i]->append(buffer, static_cast<std::size_t>(got));
            } else if (got == 0) {
                pipes[i].fd = -1;
            }
        }
    }
    return true;
}

} // namespace

CommandResult run_command(const std::vector<std::string>& command, double limit_seconds,
                          const std::vector<std::pair<std::string, std::string>>& environment) {
    CommandResult result;
    int out[2], err[2];
    if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) {
        return result;
    }
    const pid_t child = fork();
    if (child == 0) {
        become(command, environment, out[1], err[1]);
    }
    close(out[1]);
    close(err[1]);
    const auto limit =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_seconds));
    result.timed_out = !read_both(out[0], err[0], result, Clock::now() + limit);
    if (result.timed_out) {
        kill(-child, SIGTERM); // glcast-run then ends its program and its X server
        pollfd leaving[] = {{out[0], POLLIN, 0}};
        while (poll(leaving, 1, 6000) > 0 && (leaving[0].revents & POLLHUP) == 0) {
            char rest[4096];
            if (read(out[0], rest, sizeof rest) <= 0) {
                break;
            }
        }
        kill(-child, SIGKILL);
    }
    close(out[0]);
    close(err[0]);
    int status = 0;
    waitpid(child, &status, 0);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return result;
}

} // namespace glcast::test
