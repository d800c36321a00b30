#include "tools/run/display.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>

#include "tools/run/process.h"

namespace glcast::run {
namespace {

constexpr int start_timeout_ms = 30'000;
constexpr int stop_grace_ms = 5'000;

[[noreturn]] void become_server(int ready_pipe) {
    setpgid(0, 0); // the terminal's Ctrl-C is not for it: the program goes first
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    unblock_signals();
    const int silence = open("/dev/null", O_RDWR);
    for (int standard : {0, 1, 2}) {
        dup2(silence, standard);
    }
    const std::string ready = std::to_string(ready_pipe);
    execlp("Xvfb", "Xvfb", "-displayfd", ready.c_str(), "-noreset", "-nolisten", "tcp", "-screen", "0",
           "1280x1024x24", static_cast<char*>(nullptr));
    _exit(127);
}

/// What the server writes when it is ready: its number and a newline.
std::string read_display_number(int pipe) {
    std::string number;
    for (;;) {
        pollfd waiting{pipe, POLLIN, 0};
        char c = 0;
        if (poll(&waiting, 1, start_timeout_ms) <= 0 || read(pipe, &c, 1) != 1) {
            return {};
        }
        if (c == '\n') {
            return number;
        }
        if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
            number += c;
        }
    }
}

} // namespace

std::string Display::start() {
    int ready[2];
    if (pipe(ready) != 0) {
        return "cannot make a pipe";
    }
    server = fork();
    if (server == 0) {
        close(ready[0]);
        become_server(ready[1]);
    }
    close(ready[1]);
    const std::string number = server > 0 ? read_display_number(ready[0]) : std::string();
    close(ready[0]);
    if (number.empty()) {
        stop();
        return "cannot start an X server: is Xvfb installed (Debian: xvfb)?";
    }
    display = ":" + number;
    return {};
}

void Display::stop() {
    if (server > 0) {
        end_process(server, stop_grace_ms);
        server = -1;
    }
}

} // namespace glcast::run
