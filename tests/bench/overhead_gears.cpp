#include "tests/bench/overhead_gears.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

extern char** environ;

namespace glcast::test {
namespace {

/// A child and what it prints.
struct Child {
    pid_t pid = -1;
    int out = -1;
    ~Child() {
        if (out >= 0) close(out);
        if (pid <= 0) return;
        kill(pid, SIGKILL);
        waitpid(pid, nullptr, 0);
    }
};

void start(Child& child, const std::vector<std::pair<std::string, std::string>>& environment) {
    std::vector<std::string> variables;
    for (char** at = environ; *at; ++at) variables.emplace_back(*at);
    for (const auto& [name, value] : environment) {
        std::erase_if(variables, [&](const std::string& v) { return v.starts_with(name + "="); });
        variables.push_back(name + "=" + value);
    }
    std::vector<char*> pointers;
    for (std::string& variable : variables) pointers.push_back(variable.data());
    pointers.push_back(nullptr);
    int pipe_ends[2];
    if (pipe2(pipe_ends, O_CLOEXEC) != 0) return;
    child.out = pipe_ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], 1);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    std::string program = "glxgears";
    char* arguments[] = {program.data(), nullptr};
    if (posix_spawnp(&child.pid, program.c_str(), &actions, nullptr, arguments, pointers.data()) != 0)
        child.pid = -1;
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
}

/// The next line; empty when none comes within ten seconds.
std::string next_line(int from) {
    std::string line;
    for (;;) {
        pollfd wait{from, POLLIN, 0};
        char c;
        if (poll(&wait, 1, 10'000) != 1 || read(from, &c, 1) != 1) return {};
        if (c == '\n') return line;
        line += c;
    }
}

double processor_seconds(pid_t pid) {
    clockid_t clock;
    timespec now{};
    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &now) != 0) return 0;
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// "4816 frames in 5.0 seconds = 963.198 FPS"; false for other lines.
bool is_count(const std::string& line, double& frames, double& per_second) {
    double seconds = 0;
    return std::sscanf(line.c_str(), "%lf frames in %lf seconds = %lf FPS", &frames, &seconds, &per_second) ==
           3;
}

double at_share(std::vector<double> sorted, double share) {
    return sorted.empty() ? 0 : sorted[std::size_t(share * double(sorted.size() - 1) + 0.5)];
}

} // namespace

GearsFrame measure_gears(const std::vector<std::pair<std::string, std::string>>& environment) {
    Child child;
    start(child, environment);
    if (child.pid <= 0) return {};
    double before = -1, frames = 0, per_second = 0;
    for (std::string line; !(line = next_line(child.out)).empty();) {
        if (!is_count(line, frames, per_second)) continue;
        const double now = processor_seconds(child.pid);
        if (before >= 0 && frames > 0) return {1 / per_second, (now - before) / frames};
        before = now;
    }
    return {};
}

Ratio ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < std::min(a.size(), b.size()); ++round)
        if (a[round] > 0 && b[round] > 0) ratios.push_back(b[round] / a[round]);
    std::sort(ratios.begin(), ratios.end());
    return {at_share(ratios, 0.5), at_share(ratios, 0.25), at_share(ratios, 0.75)};
}

} // namespace glcast::test
