#include "shim/preload/quiet_write.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace glcast::preload {
namespace {

/// What write(2) raises on the thread that calls it, beside the error that it returns.
struct Raised {
    int error, signal;
    mode_t kind; ///< of what it is written to
};
constexpr Raised raised[] = {{EPIPE, SIGPIPE, S_IFIFO}, {EFBIG, SIGXFSZ, S_IFREG}};

/// One that waits already would swallow ours, and to take ours off would take the program's.
bool waits_already(int descriptor) {
    struct stat status {};
    sigset_t pending;
    sigemptyset(&pending);
    if (fstat(descriptor, &status) != 0 || sigpending(&pending) != 0) return true;
    for (const Raised& one : raised)
        if ((status.st_mode & S_IFMT) == one.kind && sigismember(&pending, one.signal) == 1) return true;
    return false;
}

/// It is pending on this thread, which the kernel asks before the process; so none that was sent to the
/// process goes.
void take_off(int error) {
    for (const Raised& one : raised) {
        if (one.error != error) continue;
        sigset_t set;
        sigemptyset(&set);
        sigaddset(&set, one.signal);
        const timespec now{0, 0};
        sigtimedwait(&set, nullptr, &now);
    }
}

const char* explain(int error) {
    switch (error) {
    case EAGAIN:
        return "it is full, or stopped";
    case EPIPE:
        return "nobody reads it any more";
    case EFBIG:
        return "it may not grow (RLIMIT_FSIZE)";
    case ENOSPC:
        return "no space is left for it";
    default:
        return "it takes no more";
    }
}

} // namespace

QuietThread::QuietThread() : error(errno) {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state);
}

QuietThread::~QuietThread() {
    pthread_setcancelstate(cancel_state, nullptr);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    errno = error;
}

const char* write_quietly(int descriptor, std::string_view text,
                          ssize_t (*how)(int descriptor, std::string_view text)) {
    if (waits_already(descriptor)) return "a SIGPIPE or SIGXFSZ of the program's own waits";
    const ssize_t written = how(descriptor, text);
    if (written == static_cast<ssize_t>(text.size())) return nullptr;
    const int why = written < 0 ? errno : EAGAIN;
    take_off(why);
    return explain(why);
}

ssize_t write_once(int descriptor, std::string_view text) {
    return write(descriptor, text.data(), text.size());
}

int above_standard(int descriptor) {
    if (descriptor < 0 || descriptor > STDERR_FILENO) return descriptor;
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(descriptor);
    return moved;
}

} // namespace glcast::preload
