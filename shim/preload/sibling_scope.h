// Second contexts beside the program's, for as long as a frame is cast.
#pragma once
#include <cstdint>
#include <set>
#include <stdexcept>

#include "shim/preload/session.h"
#include "shim/preload/status.h"

namespace glcast::preload {

/// Contexts of ours current with the program's drawables, and the program's own again at the end.
///
/// A sibling that has drawn does not outlive its frame: a driver may let an object that has lost its name
/// meanwhile point at a context that is gone (Mesa's sampler views). One that has not is kept for the next
/// frame, if it holds nothing of the program's.
///
/// At rest, on a thread of ours, nothing of the program's is current, and nothing is said to an X server:
/// they were made before, and are put away by the program's thread when it calls GL again (session_rest.cpp).
class SiblingScope {
  public:
    /// `first`: whose window system tells what is current.
    SiblingScope(const NativeContext& first, bool is_at_rest)
        : system(*first.system), at_rest(is_at_rest), program(at_rest ? Binding{} : first.system->current()) {
        if (!program.context) program.display = first.display;
        if (program.context && !system.can_return_to(program))
            throw std::runtime_error("the program has destroyed its drawable");
    }
    ~SiblingScope() {
        const bool back = at_rest ? system.bind_alone(program.display, nullptr) : system.bind(program);
        if (!back) say_once("the program's context could not be made current again");
        if (are_kept) return;
        if (at_rest)
            for (NativeContext* context : had) context->sibling_is_spent = true;
        else
            destroy();
    }
    SiblingScope(const SiblingScope&) = delete;
    SiblingScope& operator=(const SiblingScope&) = delete;

    /// A sibling of `part`'s context. Its own drawable may not fit the one that is current, which may not fit
    /// its configuration; framebuffer objects need none.
    void enter(const FramePart& part) {
        NativeContext& context = *part.context;
        if (entered == &context) return;
        entered = nullptr;
        if (at_rest) return enter_alone(context);
        Binding binding{context.display, program.draw, program.read, sibling_of(context)};
        const bool same_display = program.context && program.display == context.display;
        bool bound = same_display && context.system->bind(binding);
        for (const std::uintptr_t drawable : {part.drawable, std::uintptr_t(0)}) {
            if (bound) break;
            binding.draw = binding.read = drawable;
            bound = context.system->can_return_to(binding) && context.system->bind(binding);
        }
        if (!bound) throw std::runtime_error("the second context cannot be made current");
        entered = &context;
    }

    /// They have drawn nothing, and hold nothing.
    void keep() { are_kept = true; }

  private:
    void enter_alone(NativeContext& context) {
        if (!context.sibling || !context.system->bind_alone(context.display, context.sibling))
            throw std::runtime_error("no second context is there for a program at rest");
        had.insert(&context);
        entered = &context;
    }

    void destroy() {
        for (NativeContext* context : had)
            if (void* sibling = context->sibling.exchange(nullptr))
                context->system->destroy(context->display, sibling);
    }

    void* sibling_of(NativeContext& context) {
        if (!context.sibling) context.sibling = context.make_sibling();
        if (!context.sibling) throw std::runtime_error("no second context can be made beside the program's");
        had.insert(&context);
        return context.sibling;
    }

    const WindowSystem& system;
    const bool at_rest;
    Binding program;
    std::set<NativeContext*> had;
    bool are_kept = false;
    const NativeContext* entered = nullptr;
};

} // namespace glcast::preload
