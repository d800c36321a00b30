#include "shim/preload/status.h"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>

namespace glcast::preload {
namespace {

std::string format_line(const char* format, va_list arguments) {
    char text[1024];
    const int length = std::vsnprintf(text, sizeof text, format, arguments);
    return length < 0 ? std::string(format) : std::string(text);
}

/// In one write, so that lines of several processes do not mix. errno stays the program's.
void write_line(int file, const std::string& line) {
    const int saved = errno;
    const std::string whole = line + "\n";
    [[maybe_unused]] const ssize_t written = write(file, whole.data(), whole.size());
    errno = saved;
}

/// Asked once: the program may change its environment on another thread.
const std::string& status_file() {
    static const auto* const path = [] { // never destroyed: threads may outlive exit()
        const char* const value = std::getenv("GLCAST_STATUS");
        return new std::string(value ? value : "");
    }();
    return *path;
}

} // namespace

void say(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_line(STDERR_FILENO, "glcast: " + format_line(format, arguments));
    va_end(arguments);
}

void say_once(const char* format, ...) {
    static std::mutex mutex;
    static auto* said = new std::set<std::string>; // never destroyed: threads may outlive exit()
    va_list arguments;
    va_start(arguments, format);
    const std::string line = format_line(format, arguments);
    va_end(arguments);
    const std::lock_guard lock(mutex);
    if (said->insert(line).second) write_line(STDERR_FILENO, "glcast: " + line);
}

bool has_status_file() { return !status_file().empty(); }

bool speaks_alone() {
    static const bool verbose = [] { // asked once, as above
        const char* const value = std::getenv("GLCAST_VERBOSE");
        return value && *value;
    }();
    return verbose || !has_status_file();
}

void tell(const char* event, const std::string& text) {
    if (!has_status_file()) return;
    const int saved = errno;
    // Not blocking: a pipe whose reader has gone must not stop the program.
    const int file = open(status_file().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NONBLOCK);
    if (file >= 0) {
        write_line(file, std::string(event) + " " + text);
        close(file);
    }
    errno = saved;
}

std::string program_name() { return program_invocation_short_name; }

} // namespace glcast::preload
