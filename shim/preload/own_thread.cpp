#include "shim/preload/own_thread.h"

#include <pthread.h>
#include <signal.h>

#include <memory>

namespace glcast::preload {
namespace {

void* run_work(void* work) {
    const std::unique_ptr<std::function<void()>> owned(static_cast<std::function<void()>*>(work));
    (*owned)();
    return nullptr;
}

} // namespace

bool start_own_thread(std::function<void()> work) {
    auto owned = std::make_unique<std::function<void()>>(std::move(work));
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    pthread_t thread;
    const bool started = pthread_create(&thread, nullptr, run_work, owned.get()) == 0;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (!started) return false;
    owned.release();
    pthread_detach(thread);
    return true;
}

} // namespace glcast::preload
