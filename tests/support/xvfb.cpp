#include "tests/support/xvfb.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace glcast::test {
namespace {

constexpr int xvfb_start_milliseconds = 20'000;

std::runtime_error system_error(const std::string& what) {
    return std::runtime_error(what + ": " + std::strerror(errno));
}

std::vector<char*> c_strings(const std::vector<std::string>& strings) {
    std::vector<char*> pointers;
    for (const std::string& s : strings) pointers.push_back(const_cast<char*>(s.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

/// One line that another process writes, without its end; empty when none comes in time.
std::string read_line(int file, int milliseconds) {
    std::string line;
    pollfd readable{file, POLLIN, 0};
    char c = 0;
    while (poll(&readable, 1, milliseconds) == 1 && read(file, &c, 1) == 1 && c != '\n') line += c;
    return c == '\n' ? line : std::string();
}

void end_process(pid_t pid) {
    kill(pid, SIGTERM);
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
}

int make_output_file() {
    const int file = memfd_create("output", MFD_CLOEXEC);
    if (file < 0) throw system_error("memfd_create");
    return file;
}

std::string read_all(int file) {
    std::string text;
    char buffer[4096];
    lseek(file, 0, SEEK_SET);
    for (ssize_t got; (got = read(file, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<size_t>(got));
    close(file);
    return text;
}

[[noreturn]] void become(const Command& command, int out, int err) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    for (const auto& [name, value] : command.environment)
        value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
    execvp(command.arguments[0].c_str(), c_strings(command.arguments).data());
    _exit(127);
}

/// True when the process ended in time; it is still to be waited for.
bool wait_for_end(pid_t pid, double seconds) {
    const int handle = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    if (handle < 0) throw system_error("pidfd_open");
    pollfd ended{handle, POLLIN, 0};
    const int result = poll(&ended, 1, static_cast<int>(seconds * 1000));
    close(handle);
    return result == 1;
}

} // namespace

Xvfb::Xvfb() {
    int ends[2];
    if (pipe(ends) != 0) throw system_error("pipe");
    const std::vector<std::string> arguments = {"Xvfb",     "-displayfd", std::to_string(ends[1]),
                                                "-noreset", "-nolisten",  "tcp",
                                                "-screen",  "0",          "1024x768x24"};
    pid = fork();
    if (pid < 0) throw system_error("fork");
    if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        unsetenv("LD_PRELOAD");
        close(ends[0]);
        const int quiet = open("/dev/null", O_RDWR);
        for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(quiet, file);
        execvp("Xvfb", c_strings(arguments).data());
        _exit(127);
    }
    close(ends[1]);
    const std::string number = read_line(ends[0], xvfb_start_milliseconds);
    close(ends[0]);
    if (number.empty()) {
        end_process(pid);
        throw std::runtime_error("Xvfb does not start");
    }
    name = ":" + number;
}

Xvfb::~Xvfb() { end_process(pid); }

Outcome run(const Command& command) {
    const int out = make_output_file(), err = make_output_file();
    const pid_t pid = fork();
    if (pid < 0) throw system_error("fork");
    if (pid == 0) become(command, out, err);
    Outcome outcome;
    outcome.timed_out = !wait_for_end(pid, command.timeout_seconds);
    kill(-pid, SIGKILL); // it, if it is late, and whatever it left behind
    if (outcome.timed_out) kill(pid, SIGKILL);
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = read_all(out);
    outcome.err = read_all(err);
    if (outcome.exit_code == 127) throw std::runtime_error("cannot start " + command.arguments[0]);
    return outcome;
}

TemporaryFolder::TemporaryFolder() {
    path = (std::filesystem::temp_directory_path() / "glcast-test-XXXXXX").string();
    if (!mkdtemp(path.data())) throw system_error("mkdtemp");
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

} // namespace glcast::test
