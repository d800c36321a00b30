#include "shim/preload/own_stack.h"

#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>

#include "shim/preload/sanitizer_stack.h"

namespace glcast::preload {
namespace {

constexpr std::size_t kib = 1024;
constexpr std::size_t sizes[] = {8192 * kib, 2048 * kib, 512 * kib}; ///< the first is what main threads have
constexpr std::size_t enough = 256 * kib;                            ///< a cast takes some 100

constexpr int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT};

bool has_handler(int signal) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0) return false;
    return (action.sa_flags & SA_SIGINFO) != 0 ||
           (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
}

class SignalsHeld {
  public:
    explicit SignalsHeld(HeldSignals which) {
        sigset_t held;
        if (which == HeldSignals::all) {
            sigfillset(&held);
        } else {
            sigemptyset(&held);
            for (int signal = 1; signal <= SIGRTMAX; ++signal)
                if (has_handler(signal)) sigaddset(&held, signal);
        }
        for (const int fault : faults) sigdelset(&held, fault);
        pthread_sigmask(SIG_BLOCK, &held, &before);
    }
    ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;

  private:
    sigset_t before;
};

/// What is on our stack first, so that the program's need not hold it: a ucontext_t is a kilobyte.
struct Job {
    void (*work)(void* with);
    void* with;
    std::exception_ptr thrown;
    ucontext_t program{}, ours{};
    StackSwitch sanitizer;
};

struct Stack {
    char* low = nullptr; ///< the guard page; null: none
    std::size_t size = 0;

    char* high() const { return low + size; }
};

std::size_t page_size() {
    static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return size;
}

Stack map_stack() {
    for (const std::size_t size : sizes) {
        void* low = mmap(nullptr, size, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
        if (low == MAP_FAILED) continue;
        mprotect(low, page_size(), PROT_NONE);
        return {static_cast<char*>(low), size};
    }
    return {};
}

/// One for the jobs that take no time, so that an armed frame maps nothing.
constinit std::atomic<char*> spare{nullptr};

Stack take_stack() {
    if (char* low = spare.exchange(nullptr)) return {low, sizes[0]};
    return map_stack();
}

void give_back(const Stack& stack, HeldSignals held) {
    char* none = nullptr;
    const bool is_touched_little = held == HeldSignals::all;
    if (is_touched_little && stack.size == sizes[0] && spare.compare_exchange_strong(none, stack.low)) return;
    munmap(stack.low, stack.size);
}

/// Left on the program's stack.
std::size_t room_on_this_stack() {
    pthread_attr_t attributes;
    if (pthread_getattr_np(pthread_self(), &attributes) != 0) return 0;
    void* low = nullptr;
    std::size_t size = 0;
    pthread_attr_getstack(&attributes, &low, &size);
    pthread_attr_destroy(&attributes);
    const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
    const auto end = reinterpret_cast<std::uintptr_t>(low);
    return here > end && here - end <= size ? here - end : 0;
}

/// makecontext passes ints.
void run_job(unsigned high, unsigned low) {
    Job& job = *reinterpret_cast<Job*>(static_cast<std::uintptr_t>(std::uint64_t{high} << 32 | low));
    job.sanitizer.arrived();
    try {
        job.work(job.with);
    } catch (...) {
        job.thrown = std::current_exception();
    }
    job.sanitizer.leave_for_good();
    swapcontext(&job.ours, &job.program);
}

constinit thread_local bool is_there = false;

[[gnu::noinline]] std::exception_ptr run_there(const Stack& stack, void (*work)(void* with), void* with) {
    constexpr std::size_t room = (sizeof(Job) + 63) / 64 * 64;
    Job* job = new (stack.high() - room) Job{work, with, nullptr, {}, {}, {}};
    getcontext(&job->ours);
    job->ours.uc_stack.ss_sp = stack.low + page_size();
    job->ours.uc_stack.ss_size = stack.size - page_size() - room;
    const std::uint64_t address = reinterpret_cast<std::uintptr_t>(job);
    makecontext(&job->ours, reinterpret_cast<void (*)()>(run_job), 2, static_cast<unsigned>(address >> 32),
                static_cast<unsigned>(address));
    is_there = true;
    job->sanitizer.leave_for(job->ours.uc_stack.ss_sp, job->ours.uc_stack.ss_size);
    swapcontext(&job->program, &job->ours);
    job->sanitizer.came_back();
    is_there = false;
    const std::exception_ptr thrown = std::move(job->thrown);
    job->~Job();
    return thrown;
}

} // namespace

void call_on_own_stack(void (*work)(void* with), void* with, HeldSignals held) {
    if (is_there) return work(with);
    const SignalsHeld signals(held);
    const Stack stack = take_stack();
    if (!stack.low) {
        if (room_on_this_stack() < enough) throw std::runtime_error("no room for a stack: out of memory");
        return work(with);
    }
    const std::exception_ptr thrown = run_there(stack, work, with);
    give_back(stack, held);
    if (thrown) std::rethrow_exception(thrown);
}

} // namespace glcast::preload
