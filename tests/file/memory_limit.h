// A limit on the memory of a test that reads damaged files.
#pragma once
#include <sys/resource.h>

namespace glcast::test {

/// Shadow memory is larger than any limit.
constexpr bool with_sanitizer =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    true;
#else
    false;
#endif

/// An allocation beyond a gigabyte fails, which readers must never need for small files.
class MemoryLimit {
  public:
    MemoryLimit() {
        getrlimit(RLIMIT_AS, &before);
        rlimit small = before;
        small.rlim_cur = 1u << 30;
        if (!with_sanitizer) setrlimit(RLIMIT_AS, &small);
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &before); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

  private:
    rlimit before{};
};

} // namespace glcast::test
