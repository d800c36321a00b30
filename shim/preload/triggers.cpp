#include "shim/preload/triggers.h"

#include <signal.h>

#include <climits>

namespace glcast::preload {
namespace {

std::atomic<long> signals{0}; ///< that nobody has looked at
/// The handler that was there before ours. Replaced, never changed: another thread may just be in ours.
std::atomic<const struct sigaction*> program_action{nullptr};

void call(const struct sigaction& action, int number, siginfo_t* info, void* where) {
    if (action.sa_flags & SA_SIGINFO)
        action.sa_sigaction(number, info, where);
    else if (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN)
        action.sa_handler(number);
}

void count_signal(int number, siginfo_t* info, void* where) {
    signals.fetch_add(1, std::memory_order_relaxed);
    if (const struct sigaction* action = program_action) call(*action, number, info, where);
}

/// Programs set their handlers when they like, so this is asked at every frame's end.
void put_handler(int number) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) != 0) return;
    if ((now.sa_flags & SA_SIGINFO) && now.sa_sigaction == count_signal) return;
    program_action = new struct sigaction(now);
    const bool handled = (now.sa_flags & SA_SIGINFO) || (now.sa_handler != SIG_DFL && now.sa_handler != SIG_IGN);
    struct sigaction ours {};
    ours.sa_sigaction = count_signal;
    ours.sa_mask = now.sa_mask;
    ours.sa_flags = SA_SIGINFO | (handled ? now.sa_flags & ~SA_RESETHAND : SA_RESTART);
    sigaction(number, &ours, nullptr);
}

} // namespace

Triggers::Triggers(const Options& options)
    : signal(options.signal), left(options.captures > 0 ? options.captures : LONG_MAX),
      owed(options.key.empty() && options.signal == 0 ? left.load() : 0) {
    if (!options.armed) give_up();
}

void Triggers::fire() {
    if (!over() && owed < left) ++owed;
}

bool Triggers::taken() {
    --owed;
    return --left <= 0;
}

void Triggers::give_up() { left = owed = 0; }

void Triggers::look_for_signals() {
    if (signal == 0 || over()) return;
    put_handler(signal);
    for (long came = signals.exchange(0); came > 0; --came) fire();
}

} // namespace glcast::preload
