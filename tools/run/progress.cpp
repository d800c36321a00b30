#include "tools/run/progress.h"

#include <unistd.h>

#include <iostream>

namespace glcast::run {
namespace {

constexpr const char* erase_line = "\r\x1b[K";

}

ProgressLine::ProgressLine() : is_terminal(isatty(STDERR_FILENO) == 1) {}

void ProgressLine::clear() {
    if (!shown.empty()) {
        std::cerr << erase_line << std::flush;
    }
    shown.clear();
}

void ProgressLine::show(const Seen& seen) {
    if (!has_warned && !seen.slow.empty()) {
        has_warned = true;
        clear();
        std::cerr << "glcast-run: " << seen.slow << '\n';
    }
    if (!is_terminal || seen.progress == shown) {
        return;
    }
    clear();
    shown = seen.progress;
    if (!shown.empty()) {
        std::cerr << erase_line << "glcast-run: " << shown << std::flush;
    }
}

} // namespace glcast::run
