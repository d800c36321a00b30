#include "shim/preload/host_thread.h"

#include <pthread.h>

#include <cerrno>

namespace glcast::preload {

HostThread::HostThread() : error(errno) {
    fegetenv(&arithmetic);
    fesetenv(FE_DFL_ENV); // not feholdexcept: that leaves rounding and flush-to-zero as they are
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state);
}

HostThread::~HostThread() {
    pthread_setcancelstate(cancel_state, nullptr);
    fesetenv(&arithmetic);
    errno = error;
}

} // namespace glcast::preload
