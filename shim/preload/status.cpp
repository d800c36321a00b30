#include "shim/preload/status.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>

#include "shim/preload/quiet_write.h"
#include "shim/preload/standard_error.h"
#include "shim/preload/start.h"
#include "shim/preload/wine.h"

namespace glcast::preload {
namespace {

constexpr std::size_t longest_line = PIPE_BUF - 1; ///< so that lines of several processes do not mix

std::string format_line(const char* format, va_list arguments) {
    char text[1024];
    const int length = std::vsnprintf(text, sizeof text, format, arguments);
    return length < 0 ? std::string(format) : std::string(text);
}

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

/// One line with its end: a name with a newline or an escape sequence in it does not become a line or a
/// colour of its own.
std::string make_line(const std::string& text) {
    std::string line;
    for (const char c : text) {
        if (line.size() + 4 >= longest_line) break;
        char escaped[5];
        if (is_control(static_cast<unsigned char>(c))) {
            std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned char>(c));
            line += escaped;
        } else {
            line += c;
        }
    }
    return line + "\n";
}

/// Asked once: the program may change its environment on another thread.
const std::string& status_file() {
    static const auto* const path = [] { // never destroyed: threads may outlive exit()
        const char* const value = std::getenv("GLCAST_STATUS");
        return new std::string(absolute_at_start(value ? value : ""));
    }();
    return *path;
}

/// A pipe or a file: to open something else may do more than open it.
int open_status_file() {
    struct stat status {};
    if (stat(status_file().c_str(), &status) != 0) return -1;
    if (!S_ISFIFO(status.st_mode) && !S_ISREG(status.st_mode)) return -1;
    return above_standard(
        open(status_file().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
}

void say_line(const std::string& text) {
    static std::atomic<long> lost{0};
    if (const char* why = write_to_standard_error(make_line("glcast: " + text)))
        tell("unsaid", std::to_string(++lost) + " " + why);
}

} // namespace

void say(const char* format, ...) {
    const QuietThread quiet;
    va_list arguments;
    va_start(arguments, format);
    const std::string text = format_line(format, arguments);
    va_end(arguments);
    say_line(text);
}

void say_once(const char* format, ...) {
    const QuietThread quiet; // a signal handler that draws must not meet the mutex
    static std::mutex mutex;
    static auto* said = new std::set<std::string>; // never destroyed: threads may outlive exit()
    va_list arguments;
    va_start(arguments, format);
    const std::string text = format_line(format, arguments);
    va_end(arguments);
    const std::lock_guard lock(mutex);
    if (said->insert(text).second) say_line(text);
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
    const QuietThread quiet;
    const int file = open_status_file();
    if (file < 0) return;
    const std::string who = std::string(event) + "@" + std::to_string(getpid());
    write_quietly(file, make_line(who + " " + text), write_once);
    close(file);
}

std::string program_name() { return is_wine() ? windows_program() : program_invocation_short_name; }

} // namespace glcast::preload
