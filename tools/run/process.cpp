#include "tools/run/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace glcast::run {
namespace {

sigset_t taken_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (int number : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) {
        sigaddset(&set, number);
    }
    return set;
}

/// Blocks until a child changes state or the time is over. SIGCHLD is blocked (take_signals), so none is
/// missed.
void wait_for_child_event(int timeout_ms) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGCHLD);
    const timespec limit{timeout_ms / 1000, timeout_ms % 1000 * 1'000'000L};
    sigtimedwait(&set, nullptr, &limit);
}

int remaining_ms(std::chrono::steady_clock::time_point deadline) {
    using namespace std::chrono;
    return static_cast<int>(
        std::max<long long>(0, ceil<milliseconds>(deadline - steady_clock::now()).count()));
}

pid_t parent_of(const std::filesystem::path& process_folder) {
    std::ifstream file(process_folder / "stat");
    std::string text;
    std::getline(file, text);
    const auto name_end = text.rfind(')'); // the name may hold anything
    return name_end == std::string::npos ? -1 : static_cast<pid_t>(std::atoi(text.c_str() + name_end + 4));
}

std::vector<char*> c_strings(const std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (const std::string& word : words) {
        pointers.push_back(const_cast<char*>(word.c_str()));
    }
    pointers.push_back(nullptr);
    return pointers;
}

/// Children of ours other than `spared`: what the program started and orphaned, in whatever session.
std::vector<pid_t> adopted(const std::map<pid_t, std::optional<int>>& spared) {
    std::vector<pid_t> found;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", gone)) {
        const pid_t pid = std::atoi(entry.path().filename().c_str());
        if (pid > 0 && spared.count(pid) == 0 && parent_of(entry.path()) == getpid()) {
            found.push_back(pid);
        }
    }
    return found;
}

} // namespace

int take_signals() {
    const sigset_t set = taken_signals();
    sigprocmask(SIG_BLOCK, &set, nullptr);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    return signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

void unblock_signals() {
    const sigset_t set = taken_signals();
    sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

void end_process(pid_t pid, int grace_ms) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(grace_ms);
    kill(pid, SIGTERM);
    for (int left = grace_ms; left > 0; left = remaining_ms(deadline)) {
        const pid_t ended = waitpid(pid, nullptr, WNOHANG);
        if (ended == pid || (ended < 0 && errno == ECHILD)) {
            return;
        }
        wait_for_child_event(left);
    }
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
}

Answer ask(const std::vector<std::string>& command) {
    const int errors = memfd_create("errors", MFD_CLOEXEC);
    const pid_t pid = fork();
    if (pid == 0) {
        unblock_signals();
        const int silence = open("/dev/null", O_RDWR);
        dup2(silence, 0);
        dup2(silence, 1);
        dup2(errors >= 0 ? errors : silence, 2);
        execv(command[0].c_str(), c_strings(command).data());
        _exit(127);
    }
    Answer answer;
    int status = 0;
    if (pid > 0 && waitpid(pid, &status, 0) == pid) {
        answer.status = exit_status(status);
    }
    if (errors >= 0) {
        answer.errors = take_text(errors);
    }
    return answer;
}

std::string take_text(int file) {
    std::string text;
    char buffer[4096];
    lseek(file, 0, SEEK_SET);
    for (ssize_t got; (got = read(file, buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<std::size_t>(got));
    }
    close(file);
    return text;
}

pid_t start_command(const std::vector<std::string>& command, int output) {
    const pid_t pid = fork();
    if (pid == 0) {
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        unblock_signals();
        dup2(open("/dev/null", O_RDONLY), 0);
        if (output >= 0) {
            dup2(output, 1);
        }
        execv(command[0].c_str(), c_strings(command).data());
        _exit(127);
    }
    return pid;
}

int exit_status(int wait_status) {
    return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

std::string Program::start(const std::string& file, const std::vector<std::string>& arguments,
                           const Environment& changes, int output) {
    int trouble[2];
    if (pipe2(trouble, O_CLOEXEC) != 0) {
        return "cannot make a pipe";
    }
    leader = fork();
    if (leader == 0) {
        setsid();
        unblock_signals();
        for (const auto& [name, value] : changes) {
            value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
        }
        if (output >= 0) {
            dup2(output, 1);
        }
        execv(file.c_str(), c_strings(arguments).data());
        const int error = errno;
        [[maybe_unused]] const auto told = write(trouble[1], &error, sizeof error);
        _exit(127);
    }
    close(trouble[1]);
    int error = 0; // the pipe closes without a word when exec went well
    const bool failed = leader < 0 || read(trouble[0], &error, sizeof error) == sizeof error;
    close(trouble[0]);
    return failed ? "cannot run " + file + ": " + std::strerror(error != 0 ? error : errno) : std::string();
}

void Program::reap() {
    int ended_status = 0;
    for (pid_t ended; (ended = waitpid(-1, &ended_status, WNOHANG)) > 0;) {
        if (ended == leader) {
            status = ended_status;
        } else if (const auto ours = spared.find(ended); ours != spared.end()) {
            ours->second = ended_status;
        }
    }
}

std::optional<int> Program::take_ended(pid_t pid) {
    const auto ours = spared.find(pid);
    if (ours == spared.end() || !ours->second) {
        return std::nullopt;
    }
    const int ended = *ours->second;
    spared.erase(ours);
    return ended;
}

std::vector<std::filesystem::path> Program::running() const {
    std::vector<std::filesystem::path> files;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", gone)) {
        const pid_t pid = std::atoi(entry.path().filename().c_str());
        if (pid <= 0 || getpgid(pid) != leader) {
            continue;
        }
        std::error_code hidden;
        std::filesystem::path file = std::filesystem::read_symlink(entry.path() / "exe", hidden);
        if (hidden) {
            std::string called;
            std::getline(std::ifstream(entry.path() / "cmdline"), called, '\0');
            file = called;
        }
        if (file.is_absolute() && std::find(files.begin(), files.end(), file) == files.end()) {
            files.push_back(file);
        }
    }
    return files;
}

bool Program::alive() const { return leader > 0 && kill(-leader, 0) == 0; }

void Program::signal(int number) const {
    if (leader > 0) {
        kill(-leader, number);
    }
}

void Program::kill_strays() {
    for (auto strays = adopted(spared); !strays.empty(); strays = adopted(spared)) {
        for (pid_t pid : strays) {
            kill(pid, SIGKILL);
        }
        wait_for_child_event(100);
        reap();
    }
}

void Program::end(int grace_ms) {
    if (leader <= 0) {
        return;
    }
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(grace_ms);
    signal(SIGTERM);
    signal(SIGCONT); // a stopped process takes no SIGTERM
    for (reap(); alive(); reap()) {
        const int left = remaining_ms(deadline);
        if (left == 0) {
            signal(SIGKILL);
        }
        wait_for_child_event(left == 0 ? 100 : left);
    }
    if (end_strays) {
        kill_strays();
    }
    leader = -1;
}

} // namespace glcast::run
