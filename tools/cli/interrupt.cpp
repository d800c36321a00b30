#include "tools/cli/interrupt.h"

#include <csignal>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "capture/output_file.h"
#include "tools/cli/command.h"

namespace glcast::cli {
namespace {

void end_on(sigset_t awaited) {
    int signal = 0;
    if (sigwait(&awaited, &signal) != 0) return;
    discard_unfinished_files();
    if (isatty(STDERR_FILENO)) (void)!write(STDERR_FILENO, "\r\033[K", 4); // the line of Progress
    say("interrupted");
    _exit(128 + signal);
}

} // namespace

void end_cleanly_on_signals() {
    sigset_t awaited;
    sigemptyset(&awaited);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now {};
        if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&awaited, signal);
    }
    pthread_sigmask(SIG_BLOCK, &awaited, nullptr);
    try {
        std::thread(end_on, awaited).detach();
    } catch (const std::system_error&) { // no memory for a thread: then a signal ends us as it ends anybody
        pthread_sigmask(SIG_UNBLOCK, &awaited, nullptr);
    }
}

} // namespace glcast::cli
