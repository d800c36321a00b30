// Deep work on a stack of our own, in a thread of the program's that may have 32 KiB of it.
//
// The stack is switched, not the thread: the current context (a thread-local of glvnd and of every driver),
// locks of Xlib that the program holds, and errno belong to the thread. Why, and what was considered:
// docs/measured/transparency.md.
#pragma once
#include <memory>
#include <type_traits>

namespace glcast::preload {

/// What the program's signal handlers wait for. They must not run on a stack that they do not know: a
/// collector that scans the stacks of stopped threads would scan ours, and a handler that leaves by longjmp
/// would leave a cast half done. Signals that are faults (SIGSEGV and its kin) are never held back.
enum class HeldSignals {
    all,    ///< for work that takes no time
    handled ///< those with a handler: SIGINT and SIGTERM still end a program that has none
};

void call_on_own_stack(void (*work)(void* with), void* with, HeldSignals held);

/// Runs `work` on a stack of 8 MiB with a guard page, of which the memory goes back afterwards. Where the
/// address space has no room for it on a smaller one, and where there is none for that on the program's, if
/// that has room. An exception comes out on the program's stack. Throws std::runtime_error when there is no
/// room anywhere. In work that runs there already: a plain call.
template <class Work> void on_own_stack(HeldSignals held, Work&& work) {
    using Function = std::remove_reference_t<Work>;
    call_on_own_stack([](void* with) { (*static_cast<Function*>(with))(); },
                      const_cast<void*>(static_cast<const void*>(std::addressof(work))), held);
}

} // namespace glcast::preload
