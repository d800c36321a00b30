#include "shim/preload/standard_error.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "shim/preload/quiet_write.h"

namespace glcast::preload {
namespace {

enum class Kind {
    terminal,
    pipe,
    file,
    device,  ///< /dev/null, or another that is no terminal: nobody reads there
    nothing, ///< closed, a socket, or not from the program's start
};

/// What tells one open file from another. The time of birth tells a file from one that got its inode when it
/// was deleted.
struct Identity {
    Kind kind = Kind::nothing;
    dev_t device = 0, special = 0;
    ino_t inode = 0;
    std::int64_t born = 0;
    std::uint32_t born_nanoseconds = 0;
    bool operator==(const Identity&) const = default;
};

Kind kind_of(int descriptor, const struct stat& status) {
    if (S_ISFIFO(status.st_mode)) return Kind::pipe;
    if (S_ISREG(status.st_mode)) return Kind::file;
    if (S_ISCHR(status.st_mode)) return isatty(descriptor) == 1 ? Kind::terminal : Kind::device;
    return Kind::nothing;
}

Identity identify(int descriptor) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) return {};
    Identity found{kind_of(descriptor, status), status.st_dev, status.st_rdev, status.st_ino, 0, 0};
    struct statx more {};
    if (found.kind == Kind::file &&
        syscall(SYS_statx, descriptor, "", AT_EMPTY_PATH, STATX_BTIME, &more) == 0 &&
        (more.stx_mask & STATX_BTIME) != 0) {
        found.born = more.stx_btime.tv_sec;
        found.born_nanoseconds = more.stx_btime.tv_nsec;
    }
    return found;
}

/// Trivial, and never destroyed: other threads may speak while the process ends.
constinit Identity at_start;

/// A descriptor that exec passed on is open for writing and has no FD_CLOEXEC; one that has was opened by a
/// library since.
[[gnu::constructor]] void remember_standard_error() noexcept {
    const int saved = errno;
    const int flags = fcntl(STDERR_FILENO, F_GETFD), mode = fcntl(STDERR_FILENO, F_GETFL);
    const bool is_passed_on = flags >= 0 && (flags & FD_CLOEXEC) == 0;
    if (is_passed_on && mode >= 0 && (mode & O_ACCMODE) != O_RDONLY) at_start = identify(STDERR_FILENO);
    errno = saved;
}

/// An own descriptor, closed with it.
class Descriptor {
  public:
    explicit Descriptor(int number) : number(above_standard(number)) {}
    ~Descriptor() {
        if (number >= 0) close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    explicit operator bool() const { return number >= 0; }
    operator int() const { return number; }

  private:
    const int number;
};

/// O_NONBLOCK belongs to the open file description, which the program shares with whoever gave it its stderr.
/// So it is opened anew, non-blocking for us alone.
constexpr int anew = O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
constexpr const char* by_number = "/proc/self/fd/2";

constexpr const char* cannot_be_opened = "it cannot be opened a second time, and to write might wait";
constexpr const char* is_another = "the program has closed or replaced it";

/// The number of the terminal itself, whatever it was opened as.
unsigned terminal_number(int descriptor) {
    unsigned number = 0;
    return ioctl(descriptor, TIOCGDEV, &number) == 0 ? number : 0;
}

/// After su the terminal is another user's: as the controlling terminal it still opens.
const char* write_to_terminal(std::string_view line) {
    if (const Descriptor own(open(by_number, anew)); own)
        return identify(own) == at_start ? write_quietly(own, line, write_once) : is_another;
    const Descriptor controlling(open("/dev/tty", anew));
    const unsigned number = terminal_number(STDERR_FILENO);
    if (controlling && number != 0 && terminal_number(controlling) == number)
        return write_quietly(controlling, line, write_once);
    return cannot_be_opened;
}

/// Where a pipe cannot be opened anew (no /proc, or another user's after setuid). From Linux 6.4 a single
/// write may be non-blocking; before, vmsplice is, and takes the page as it is.
ssize_t write_without_waiting(int pipe, std::string_view text) {
    const iovec part{const_cast<char*>(text.data()), text.size()};
    const ssize_t written = syscall(SYS_pwritev2, pipe, &part, 1UL, -1L, -1L, RWF_NOWAIT);
    if (written >= 0 || (errno != EOPNOTSUPP && errno != ENOSYS)) return written;
    const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    void* copy = mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (copy == MAP_FAILED) return -1;
    std::memcpy(copy, text.data(), text.size());
    const iovec whole{copy, text.size()};
    const ssize_t given = vmsplice(pipe, &whole, 1, SPLICE_F_NONBLOCK);
    const int error = errno;
    munmap(copy, page); // the pipe keeps the page itself until it is read
    errno = error;
    return given;
}

const char* write_to_pipe(std::string_view line) {
    if (const Descriptor own(open(by_number, anew)); own)
        return identify(own) == at_start ? write_quietly(own, line, write_once) : is_another;
    if (errno == ENXIO) return "nobody reads it any more";
    const Descriptor copy(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
    if (!copy) return cannot_be_opened;
    return identify(copy) == at_start ? write_quietly(copy, line, write_without_waiting) : is_another;
}

/// Through the program's own descriptor: its position moves on behind our line, and record locks of its own
/// (fcntl) would go when a second descriptor of the file is closed. Files do not wait for readers.
const char* write_to_file(std::string_view line) { return write_quietly(STDERR_FILENO, line, write_once); }

} // namespace

const char* write_to_standard_error(std::string_view line) {
    const QuietThread quiet;
    if (at_start.kind == Kind::device) return nullptr;
    if (at_start.kind == Kind::nothing)
        return "the program was started without one that is a terminal, a pipe or a file";
    if (identify(STDERR_FILENO) != at_start) return is_another;
    switch (at_start.kind) {
    case Kind::terminal:
        return write_to_terminal(line);
    case Kind::pipe:
        return write_to_pipe(line);
    default:
        return write_to_file(line);
    }
}

} // namespace glcast::preload
