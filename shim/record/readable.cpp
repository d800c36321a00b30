#include "shim/record/readable.h"

#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>

namespace glcast::record {

bool is_readable(const void* from, std::size_t bytes) {
    if (bytes == 0) return true;
    constexpr std::size_t batch = 64;
    static const auto page = std::size_t(sysconf(_SC_PAGESIZE));
    const int error_before = errno;
    auto at = reinterpret_cast<std::uintptr_t>(from);
    const std::uintptr_t last = at + bytes - 1;
    bool readable = last >= at;
    while (readable) {
        // One byte of each page, by a call that reports a fault instead of raising one.
        char sink[batch];
        iovec remote[batch];
        std::size_t n = 0;
        for (; n < batch && at <= last; at = (at / page + 1) * page)
            remote[n++] = {reinterpret_cast<void*>(at), 1};
        if (n == 0) break;
        iovec local = {sink, n};
        const ssize_t got = process_vm_readv(getpid(), &local, 1, remote, n, 0);
        readable = got == ssize_t(n) || (got < 0 && errno != EFAULT);
        if (got < 0 && errno != EFAULT) break; // not allowed here: believe the program
    }
    errno = error_before;
    return readable;
}

} // namespace glcast::record
