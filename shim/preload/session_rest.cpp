// A program that draws nothing new: what stands in its window is kept, and cast on a thread of our own when a
// frame is wanted (docs/architecture.md, "A program at rest").
#include <cstdlib>
#include <set>

#include "shim/preload/session_state.h"

namespace glcast::preload {
namespace {

/// Of what may be recorded: the next frame needs room beside it.
constexpr std::size_t share_of_memory = 2;

std::size_t most_bytes(const Session& s) { return (s.options.memory_mib << 20) / share_of_memory; }

void display_closes(void* display) {
    Session& s = session();
    if (!s.is_ours()) return;
    {
        const std::lock_guard lock(s.mutex);
        s.standing.forget_display(display);
    }
    pass_gate(s);
}

/// Another connection may be closed by now.
bool is_of_this_display(const NativeContext& context) {
    return !thread_state.context || thread_state.context->display == context.display;
}

void destroy_spent_siblings(Session& s) {
    std::vector<std::pair<std::shared_ptr<NativeContext>, void*>> spent;
    {
        const std::lock_guard lock(s.mutex);
        for (const auto& [handle, context] : s.contexts)
            if (context->sibling_is_spent.exchange(false))
                if (void* sibling = context->sibling.exchange(nullptr)) spent.emplace_back(context, sibling);
    }
    for (const auto& [context, sibling] : spent) context->system->destroy(context->display, sibling);
}

/// While it lives, the program's threads wait where they call GL, and where they end the process.
class ProgramStands {
  public:
    explicit ProgramStands(Session& session) : s(session), stands(s.gate.close()) {
        if (stands && std::atexit(wait_at_exit) != 0) s.gate.open(), stands = false;
    }
    ~ProgramStands() {
        if (stands) s.gate.open();
    }
    ProgramStands(const ProgramStands&) = delete;
    ProgramStands& operator=(const ProgramStands&) = delete;
    explicit operator bool() const { return stands; }

  private:
    static void wait_at_exit() {
        if (Session* s = session_if_any(); s && s->is_ours()) s->gate.close_for_good();
    }
    Session& s;
    bool stands;
};

bool is_at_rest(Session& s) {
    if (!s.triggers.waiting() || !is_late_enough(s) || s.holding || s.casting) return false;
    const std::lock_guard lock(s.mutex);
    return !s.standing.empty() && s.pace.is_still(Clock::now());
}

} // namespace

void pass_gate(Session& s) noexcept {
    if (!s.is_ours()) return;
    const HostThread program;
    try {
        if (s.gate.pass()) destroy_spent_siblings(s);
    } catch (const std::exception& error) {
        say_once("%s", error.what());
    }
}

void keep_standing(Session& s, std::vector<FramePart> parts, FrameKey window, long number) {
    if (!s.keeps_standing() || s.triggers.over()) return;
    if (parts.empty()) {
        const std::lock_guard lock(s.mutex);
        return s.standing.forget(window.second);
    }
    StandingPicture picture = make_standing_picture(std::move(parts), window, number);
    {
        const std::lock_guard lock(s.mutex);
        s.standing.show(std::move(picture), most_bytes(s));
    }
    make_ready_for_rest(s);
}

void make_ready_for_rest(Session& s) {
    std::set<std::shared_ptr<NativeContext>> contexts;
    {
        const std::lock_guard lock(s.mutex);
        for (const StandingPicture& picture : s.standing.all())
            for (const FramePart& part : picture.parts)
                if (!part.context->destroyed && is_of_this_display(*part.context)) contexts.insert(part.context);
    }
    for (const auto& context : contexts) {
        context->system->watch_display(context->display, display_closes);
        if (!context->sibling) context->sibling = context->make_sibling();
    }
}

void cast_at_rest(Session& s) {
    if (!s.is_ours() || !is_at_rest(s)) return;
    const ProgramStands stands(s);
    if (stands) cast_standing(s, nullptr, FrameEnd::at_rest);
}

} // namespace glcast::preload
