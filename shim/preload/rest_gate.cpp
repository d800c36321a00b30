#include "shim/preload/rest_gate.h"

#include "shim/record/record.h"

namespace glcast::preload {

constinit std::atomic<bool> detail::gate_is_watched{false};

bool RestGate::close() {
    const std::lock_guard lock(mutex);
    if (ended) return false;
    casting = true;
    if (!detail::gate_is_watched.exchange(true)) ++record::active; // the stubs come by from now on
    return true;
}

void RestGate::open() {
    const std::lock_guard lock(mutex);
    casting = false;
    changed.notify_all();
}

bool RestGate::pass() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [this] { return !casting; });
    if (!detail::gate_is_watched.exchange(false)) return false;
    --record::active;
    return true;
}

void RestGate::reopen() {
    const std::lock_guard lock(mutex);
    ended = false;
}

void RestGate::close_for_good() {
    std::unique_lock lock(mutex);
    ended = true;
    changed.wait(lock, [this] { return !casting; });
}

} // namespace glcast::preload
