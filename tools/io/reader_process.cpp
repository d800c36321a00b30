#include "tools/io/reader_process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/io/mesh_format.h"

namespace glcast::format {
namespace {

using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true; // its shadow takes terabytes of address space
#else
constexpr bool sanitized = false;
#endif

constexpr rlim_t spare_memory = 256u << 20, memory_for_a_byte = 64;

rlim_t processor_seconds(std::size_t input) { return 5 + (input >> 20); }

/// Address space in use.
rlim_t taken() {
    unsigned long pages = 0;
    if (FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return rlim_t(pages) * rlim_t(sysconf(_SC_PAGESIZE));
}

void limit(int what, rlim_t most) {
    rlimit now{};
    if (getrlimit(static_cast<__rlimit_resource_t>(what), &now) != 0) return;
    now.rlim_cur = now.rlim_max == RLIM_INFINITY ? most : std::min(most, now.rlim_max);
    setrlimit(static_cast<__rlimit_resource_t>(what), &now);
}

void confine(std::size_t input, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1); // it went before the call above
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
        std::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    if (const int quiet = open("/dev/null", O_RDWR); quiet >= 0) // readers talk to the user
        dup2(quiet, STDIN_FILENO), dup2(quiet, STDOUT_FILENO), dup2(quiet, STDERR_FILENO), close(quiet);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_CPU, processor_seconds(input));
    if (sanitized) return;
    limit(RLIMIT_AS, taken() + spare_memory + memory_for_a_byte * rlim_t(input));
    limit(RLIMIT_NOFILE, 0); // opens nothing
}

bool send(int to, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = write(to, bytes.data(), bytes.size());
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

constexpr char good = '+', bad = '-';

[[noreturn]] void child(int to, const std::function<std::string()>& read) {
    std::string answer(1, good);
    try {
        answer += read();
    } catch (const std::bad_alloc&) {
        answer = "-it asks for more memory than its size explains";
    } catch (const std::exception& e) {
        answer = bad + std::string(e.what());
    }
    _exit(send(to, answer) ? 0 : 1);
}

/// Until the child has no more to say; false when the time is up.
bool receive(int from, std::string& answer, Clock::time_point until) {
    std::string piece(1u << 16, '\0');
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
        if (left <= 0) return false;
        pollfd waiting{from, POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::min<long long>(left, 1'000'000)));
        if (ready < 0 && errno != EINTR) return false;
        if (ready <= 0) continue;
        const ssize_t got = ::read(from, piece.data(), piece.size());
        if (got == 0) return true;
        if (got < 0 && errno != EINTR) return false;
        if (got > 0) answer.append(piece, 0, static_cast<std::size_t>(got));
    }
}

/// Closes it and waits for the child, whatever happens.
struct Child {
    pid_t process;
    int from;
    bool ended = false;

    int end() {
        int status = 0;
        ended = true;
        while (waitpid(process, &status, 0) < 0 && errno == EINTR) {}
        return status;
    }
    ~Child() {
        if (!ended) kill(process, SIGKILL), end();
        close(from);
    }
};

} // namespace

std::string read_apart(std::size_t input, const std::function<std::string()>& read) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) refuse(std::string("no pipe to a reader: ") + std::strerror(errno));
    const pid_t parent = getpid(), process = fork();
    if (process == 0) {
        close(ends[0]);
        confine(input, parent);
        child(ends[1], read);
    }
    const int why = errno;
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        refuse(std::string("no process for a reader: ") + std::strerror(why));
    }
    Child reader{process, ends[0]};
    std::string answer;
    const std::chrono::seconds patience(5 * processor_seconds(input));
    const bool done = receive(reader.from, answer, Clock::now() + patience);
    if (!done) refuse("the file takes too long to read");
    const int status = reader.end();
    if (!answer.empty() && answer[0] == bad) refuse(answer.substr(1));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) refuse("the file takes too long to read");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty())
        refuse("the file is damaged: its reader crashed");
    answer.erase(0, 1);
    return answer;
}

} // namespace glcast::format
