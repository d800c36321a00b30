// A program that draws nothing new: what stands in its window is kept, and cast on a thread of our own when a
// frame is wanted (docs/design/architecture.md, "A program at rest").
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "shim/preload/real.h"
#include "shim/preload/session_state.h"

extern "C" void* __dso_handle;

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

void wait_at_exit() {
    if (Session* s = session_if_any(); s && s->is_ours()) s->gate.close_for_good();
}

constinit thread_local bool waits_at_exit [[gnu::tls_model("initial-exec")]] = false;

/// A driver that is in use on our thread must not be taken down by exit(). The first that exit() calls is
/// what thread-local objects of its thread ask for. What atexit() keeps comes later, and what Mesa and LLVM
/// registered with that while they drew, before ours. Where the thread ends and not the process, the gate
/// opens again with the next frame.
void wait_when_this_thread_exits() {
    using Register = int(void (*)(void*), void*, void*);
    static const auto at_thread_exit = // glibc 2.18
        reinterpret_cast<Register*>(real_dlsym()(RTLD_DEFAULT, "__cxa_thread_atexit_impl"));
    if (waits_at_exit || !at_thread_exit) return;
    waits_at_exit = true;
    at_thread_exit([](void*) { wait_at_exit(); }, nullptr, &__dso_handle);
}

/// The main thread, which most often ends the process, need not be one that draws.
[[gnu::constructor]] void watch_main_thread() noexcept {
    for (const char* const name : {"GLCAST_AFTER", "GLCAST_KEY", "GLCAST_SIGNAL"})
        if (std::getenv(name)) return wait_when_this_thread_exits();
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
    Session& s;
    bool stands;
};

/// What stands in the windows, where one is wanted and nothing new comes.
std::vector<StandingPicture> stands_at_rest(Session& s) {
    if (!s.triggers.waiting() || !is_late_enough(s) || s.holding || s.casting) return {};
    const std::lock_guard lock(s.mutex);
    return s.pace.is_still(Clock::now()) ? s.standing.all() : std::vector<StandingPicture>();
}

/// That nothing can be cast before the next frame.
void tell_once(Session& s, const std::string& why) {
    if (std::exchange(s.has_told_of_rest, true)) return;
    const std::string text =
        "the program draws nothing new, and " + why + ": its next frame is cast (--nudge makes it draw)";
    if (speaks_alone()) say("%s", text.c_str());
    tell("waits", text);
}

std::vector<StandingPicture> castable_at_rest(Session& s) {
    auto pictures = stands_at_rest(s);
    const auto unseen =
        std::erase_if(pictures, [](const StandingPicture& picture) { return picture.unseen > 0; });
    if (unseen > 0 && pictures.empty())
        tell_once(s, "its last frames came too fast to be recorded before they were asked for");
    std::erase_if(pictures, [&](const StandingPicture& picture) { return !is_asked_for(s, picture); });
    return pictures;
}

/// On our own thread with no drawable, which not every driver has.
bool can_be_current(const std::vector<StandingPicture>& pictures) {
    std::set<NativeContext*> contexts;
    for (const StandingPicture& picture : pictures)
        for (const FramePart& part : picture.parts) contexts.insert(part.context.get());
    bool all = true;
    for (NativeContext* context : contexts) {
        all &= context->sibling && context->system->bind_alone(context->display, context->sibling);
        context->system->bind_alone(context->display, nullptr);
    }
    return all;
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
        return s.standing.show_unseen(window.second);
    }
    wait_when_this_thread_exits();
    s.gate.reopen();
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
                if (!part.context->destroyed && is_of_this_display(*part.context))
                    contexts.insert(part.context);
    }
    for (const auto& context : contexts) {
        context->system->watch_display(context->display, display_closes);
        if (!context->sibling) context->sibling = context->make_sibling();
    }
}

void cast_at_rest(Session& s) {
    if (!s.is_ours() || s.needs_program_thread || castable_at_rest(s).empty()) return;
    const ProgramStands stands(s);
    if (!stands) return;
    // Asked again: until the gate was closed the program may have closed its connection.
    if (can_be_current(castable_at_rest(s))) {
        cast_standing(s, nullptr, FrameEnd::at_rest);
    } else {
        s.needs_program_thread = true;
        tell_once(s, "this driver casts only on its thread");
    }
}

} // namespace glcast::preload
