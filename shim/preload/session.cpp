#include "shim/preload/session_state.h"

#include <algorithm>

#include "shim/preload/front_buffer.h"
#include "shim/preload/host_thread.h"
#include "shim/preload/own_stack.h"
#include "shim/preload/pretence.h"
#include "shim/preload/real.h"
#include "shim/preload/status.h"
#include "shim/preload/stub.h"
#include "shim/preload/watcher.h"
#include "shim/preload/wine.h"

namespace glcast::preload {
namespace {

/// Parts kept for a swap to come; more are only seen where a program draws and never shows it.
constexpr std::size_t most_parts = 32;

std::atomic<Session*> existing{nullptr};
/// Set while no frame is wanted, and read by every recorded call: threads then drop what they record.
constinit std::atomic<bool> unwanted{false};

/// Of a 32-bit address space the program needs a share too.
std::size_t bytes_for_recording(std::size_t mebibytes) {
    constexpr std::size_t most = sizeof(void*) == 4 ? std::size_t(3) << 29 : SIZE_MAX;
    return std::min(mebibytes, most >> 20) << 20;
}

Session* make_session() {
    auto* fresh = new Session;
    pretending = fresh->seen.told_of_older = fresh->options.pretend && fresh->options.error.empty();
    record::set_memory_limit(bytes_for_recording(fresh->options.memory_mib));
    if (!fresh->options.error.empty()) {
        say("%s (nothing will be captured)", fresh->options.error.c_str());
        tell("failed", fresh->options.error);
        fresh->settled = true;
    }
    return fresh;
}

} // namespace

constinit thread_local ThreadState thread_state{nullptr, 0, false, false, false};

bool is_late_enough(const Session& s) {
    return std::chrono::duration<double>(Clock::now() - s.start.load()).count() >= s.options.after_seconds;
}

void give_up(const char* why) noexcept {
    Session* s = session_if_any();
    if (!s) return;
    s->triggers.give_up();
    update_unwanted(*s);
    if (why && !s->settled.exchange(true)) tell("failed", why);
}

/// Never destroyed: other threads may draw while the process ends.
Session& session() {
    static Session* const made = [] {
        const HostThread program;
        Session* fresh = nullptr;
        on_own_stack(HeldSignals::all, [&] { existing = fresh = make_session(); });
        return fresh;
    }();
    return *made;
}

void update_unwanted(Session& s) {
    bool wanted = false;
    do { // until it is so: two threads may be here, and the one that looked first may write last
        wanted = s.wants_frames();
        unwanted = !wanted;
    } while (wanted != s.wants_frames());
}

namespace {

/// The first context that is current.
void greet(Session& s, const NativeContext& context) {
    if (speaks_alone()) say("hooked %s in %s", context.system->name(), program_name().c_str());
    tell("hooked", std::string(context.system->name()) + " " + program_name());
    s.triggers.look_for_signals();
    if (!s.options.key.empty()) tell("waits", "the key " + s.options.key + " was not pressed");
    if (s.options.signal) tell("waits", "the signal did not come");
    if (!s.keeps_standing() && !s.options.nudge) return;
    start_watcher(s.options, context.system->server(context.display),
                  {.over = [&s] { return s.triggers.over(); },
                   .waiting = [&s] { return s.triggers.waiting() && is_late_enough(s); },
                   .frames = [&s] { return s.frames.load(); },
                   .fire = [&s] { s.triggers.fire(), update_unwanted(s); },
                   .look_for_signals = [&s] { s.triggers.look_for_signals(), update_unwanted(s); },
                   .cast_at_rest = [&s] { cast_at_rest(s); }});
}

void announce(Session& s, const NativeContext& context) {
    Clock::time_point never{};
    s.start.compare_exchange_strong(never, Clock::now()); // before any other thread asks how late it is
    if (!s.hooked.exchange(true)) on_own_stack(HeldSignals::all, [&] { greet(s, context); });
}

NativeContext* find_context(Session& s, void* handle) {
    const auto at = s.contexts.find(handle);
    return at == s.contexts.end() ? nullptr : at->second.get();
}

void forget_if_unused(Session& s, NativeContext* context) {
    if (!context->destroyed || context->threads > 0) return;
    std::erase_if(s.ended, [&](const auto& entry) { return entry.first.first == context; });
    s.contexts.erase(context->handle);
}

void refuse(Session& s, std::string why) {
    if (why.starts_with("a core profile") && !s.options.pretend)
        why += is_wine() ? "; where that is Wine's Direct3D, --direct3d lets it draw by fixed functions"
                         : "; --pretend 1.5 keeps such contexts from it";
    s.seen.refused = why;
    say_once("a frame cannot be recorded: %s (the next one is tried)", why.c_str());
    tell("refused", why);
}

/// Ends a context's recording; what it holds becomes a part of the frame that has not ended. The mutex is
/// held, and the context is current on this thread or on none.
void close_recording(Session& s, NativeContext& context) {
    if (!context.recording) return;
    context.recording = false;
    std::string why;
    auto draws = static_cast<long>(record::draws_so_far(*context.shadow));
    auto frame = record::end_frame(*context.shadow, &why);
    if (!s.wants_frames() || context.destroyed) return;
    if (!frame) return refuse(s, why);
    const auto owner = s.contexts.find(context.handle);
    if (owner == s.contexts.end()) return;
    if (s.parts.size() == most_parts) s.parts.erase(s.parts.begin());
    for (const auto& [what, times] : record::not_understood(*frame))
        if (what.starts_with("a draw under")) draws -= times;
    s.parts.push_back({owner->second, context.recorded_drawable, std::move(frame), draws});
}

/// A drawable that is never swapped (a pbuffer, or a window under a context that draws to framebuffer
/// objects) takes part in the frames of those that are.
Ended frames_of(const Session& s, const NativeContext& context, std::uintptr_t drawable) {
    if (const auto at = s.ended.find({&context, drawable}); at != s.ended.end()) return at->second;
    const bool swapped = s.swapped.contains(drawable);
    Ended most;
    for (const auto& [key, ended] : s.ended)
        if (ended.frames > most.frames && (!swapped || key.second == drawable)) most = ended;
    return most;
}

/// Whether a frame that ends now is cast.
bool is_time(const Session& s) { return s.triggers.waiting() && is_late_enough(s); }

bool is_due(Session& s, const NativeContext& context, std::uintptr_t drawable) {
    if (!s.wants_frames() || !context.shadow) return false;
    const std::lock_guard lock(s.mutex);
    if (context.destroyed || (!is_time(s) && !s.pace.records_next())) return false;
    if (!s.has_shown) return true; // what a read may end, its number is not known before
    const Ended ended = frames_of(s, context, drawable);
    return ended.frames + 1 >= std::max(ended.next_wish, s.options.frame);
}

} // namespace

/// Record what follows, if it may be the frame that is waited for.
void start_recording(Session& s, NativeContext& context, std::uintptr_t drawable) {
    if (context.recording && context.recorded_drawable == drawable && s.wants_frames()) return;
    {
        const std::lock_guard lock(s.mutex);
        close_recording(s, context);
    }
    if (!is_due(s, context, drawable)) return;
    if (const char* why = record::busy(*context.shadow)) {
        const std::lock_guard lock(s.mutex);
        return refuse(s, why);
    }
    on_own_stack(HeldSignals::all,
                 [&] { record::begin_frame(*context.shadow); }); // it asks GL for all its state
    const std::lock_guard lock(s.mutex);                         // other threads look at what is recorded
    context.recording = true;
    context.recorded_drawable = drawable;
    context.reads = {};
}

/// What was drawn since the last frame ended and shows with this drawable: its own parts, and those of
/// drawables that are never swapped. `context`, where not null, is current on this thread.
std::vector<FramePart> take_parts(Session& s, NativeContext* context, std::uintptr_t drawable) {
    const std::lock_guard lock(s.mutex);
    const auto shows = [&](std::uintptr_t other) { return other == drawable || !s.swapped.contains(other); };
    if (context && context->recorded_drawable == drawable) close_recording(s, *context);
    if (context) context->end_is_due = false;
    for (const auto& [handle, other] : s.contexts) {
        if (other.get() == context || !other->recording || !shows(other->recorded_drawable)) continue;
        if (other->threads == 0)
            close_recording(s, *other);
        else if (other->recorded_drawable != drawable)
            other->end_is_due = true;
    }
    std::vector<FramePart> taken;
    std::erase_if(s.parts, [&](FramePart& part) {
        if (!shows(part.drawable)) return false;
        if (!part.context->destroyed) taken.push_back(std::move(part));
        return true;
    });
    return taken;
}

/// Another connection may be closed by now (piglit's glx-multithread-clearbuffer), and shares nothing with
/// ours.
void keep_of_this_display(std::vector<FramePart>& parts) {
    if (!thread_state.context) return;
    std::erase_if(
        parts, [](const FramePart& part) { return part.context->display != thread_state.context->display; });
}

namespace {

/// Count the frame that ends here, and cast it if it was recorded. `context` is null where none of desktop GL
/// is current with the drawable.
void end_frame(Session& s, NativeContext* context, std::uintptr_t drawable) {
    ++s.frames;
    if (!s.has_shown.exchange(true) && s.offscreen)
        tell("offscreen", ""); // Qt has a pbuffer beside its windows
    forget_front();
    s.triggers.look_for_signals();
    update_unwanted(s);
    const FrameKey window(context, drawable);
    long number = 0;
    {
        const std::lock_guard lock(s.mutex);
        s.swapped.insert(drawable);
        number = ++s.ended[window].frames;
        s.pace.frame_ended(Clock::now());
    }
    if (!s.wants_frames()) return;
    auto parts = take_parts(s, context, drawable);
    keep_of_this_display(parts);
    if (!is_time(s)) return keep_standing(s, std::move(parts), window, number);
    if (number < s.options.frame) parts.clear();
    const bool expected = context && number >= s.options.frame;
    if (!parts.empty() || expected)
        cast_parts(s, std::move(parts), thread_state.context, window, number, FrameEnd::shown);
}

/// A context that draws on a thread of its own to framebuffer objects: its part of a frame that has ended
/// elsewhere.
void end_late_part(Session& s, NativeContext& context) {
    std::vector<FramePart> parts;
    FrameKey window;
    long number = 0;
    {
        const std::lock_guard lock(s.mutex);
        close_recording(s, context);
        std::erase_if(s.parts, [&](FramePart& part) {
            if (part.context.get() != &context) return false;
            parts.push_back(std::move(part));
            return true;
        });
        for (const auto& [key, ended] : s.ended)
            if (ended.frames > number) window = key, number = ended.frames;
    }
    if (!is_time(s))
        keep_standing(s, std::move(parts), window, number);
    else if (!parts.empty())
        cast_parts(s, std::move(parts), &context, window, number, FrameEnd::shown);
    start_recording(s, context, thread_state.drawable);
}

/// Told of a program that ends no frame.
void note_offscreen(Session& s) {
    const char* const where = thread_state.is_pbuffer      ? "a pbuffer"
                              : thread_state.is_pixmap     ? "memory or a pixmap"
                              : thread_state.drawable == 0 ? "framebuffer objects alone"
                                                           : nullptr;
    if (where && !s.has_shown && !s.offscreen.exchange(where)) tell("offscreen", where);
}

bool always() { return true; }

} // namespace

/// A frame's end that is no swap; the next one begins right behind it.
void frame_ends_here(Session& s, bool (*really)()) {
    NativeContext* const context = thread_state.context;
    if (s.options.signal) s.triggers.look_for_signals(), update_unwanted(s);
    if (!s.wants_frames() || !context || !context->shadow) return;
    if (record::busy(*context->shadow)) return;
    if (thread_state.drawable != 0 && !thread_state.is_pbuffer && really()) {
        end_frame(s, context, thread_state.drawable);
        start_recording(s, *context, thread_state.drawable);
    } else if (context->end_is_due.exchange(false)) {
        end_late_part(s, *context);
    }
}

Session* session_if_any() { return existing.load(std::memory_order_relaxed); }

thread_local int Outermost::depth = 0;

const GlTable& recording_table() {
    if (!thread_state.known) [[unlikely]] {
        record::set_current(nullptr, real_table());
        thread_state.known = true;
    }
    if (calls_wait_at_gate()) [[unlikely]]
        pass_gate(session());
    if (unwanted.load(std::memory_order_relaxed) && thread_state.context && thread_state.context->recording)
        [[unlikely]] {
        Session& s = session();
        const std::lock_guard lock(s.mutex);
        close_recording(s, *thread_state.context);
    }
    return record::table();
}

bool shadows_calls() { return session().options.armed; }

void lists_made_elsewhere(GLuint first, GLsizei count) noexcept {
    guarded([&](Session&) {
        if (thread_state.context && thread_state.context->shadow)
            record::note_opaque_lists(*thread_state.context->shadow, first, count);
    });
}

void context_made(const WindowSystem& system, void* display, void* handle, void* share,
                  std::function<void*()> make_sibling) noexcept {
    if (!handle) return;
    guarded([&](Session& s) {
        auto context = std::make_shared<NativeContext>();
        context->system = &system;
        context->display = display;
        context->handle = handle;
        std::shared_ptr<record::Context> shared;
        {
            const std::lock_guard lock(s.mutex);
            if (const NativeContext* other = find_context(s, share)) shared = other->shadow;
        }
        if (make_sibling) context->shadow = record::make_context(real_table(), shared);
        context->make_sibling = std::move(make_sibling);
        const std::lock_guard lock(s.mutex);
        s.contexts[handle] = std::move(context);
    });
}

bool context_destroyed(void* display, void* handle) noexcept {
    bool is_free = true;
    guarded([&](Session& s) {
        std::shared_ptr<NativeContext> context;
        {
            const std::lock_guard lock(s.mutex);
            const auto at = s.contexts.find(handle);
            if (at == s.contexts.end()) return;
            context = at->second;
            context->destroyed = true;
            is_free = !context->in_cast || context->display != display;
            if (context->threads == 0) close_recording(s, *context);
            std::erase_if(s.parts, [&](const FramePart& part) { return part.context == context; });
            forget_if_unused(s, context.get());
        }
        if (!is_free) return; // its sibling is the cast's too
        if (void* sibling = context->sibling.exchange(nullptr))
            context->system->destroy(context->display, sibling);
    });
    return is_free;
}

void made_current(const Binding& binding) noexcept {
    guarded([&](Session& s) {
        NativeContext* const before = thread_state.context;
        NativeContext* now = nullptr;
        {
            const std::lock_guard lock(s.mutex);
            now = binding.context ? find_context(s, binding.context) : nullptr;
            if (now) ++now->threads;
            if (before) {
                --before->threads;
                if (before != now) forget_if_unused(s, before);
            }
        }
        if (now != before || binding.draw != thread_state.drawable) forget_front();
        {
            const std::lock_guard lock(s.mutex);
            thread_state = {now, binding.draw, true, s.pbuffers.contains(binding.draw),
                            s.pixmaps.contains(binding.draw)};
        }
        record::set_current(now ? now->shadow.get() : nullptr, real_table());
        if (!now) return;
        announce(s, *now);
        if (now->shadow) {
            const std::lock_guard lock(s.mutex);
            s.windows.drawn_to(binding.draw, now->system->window_of(binding.draw));
        }
        if (now->shadow) note_offscreen(s);
        now->end_is_due = false;
        if (now->shadow) start_recording(s, *now, binding.draw);
    });
}

void surface_made(std::uintptr_t drawable, std::uint32_t window) noexcept {
    if (!drawable) return;
    guarded([&](Session& s) {
        const std::lock_guard lock(s.mutex);
        s.windows.surface_made(drawable, window);
    });
}

void before_swap(std::uintptr_t drawable) noexcept {
    guarded([&](Session& s) {
        NativeContext* const current = thread_state.drawable == drawable ? thread_state.context : nullptr;
        if (current && !current->shadow) {
            const std::lock_guard lock(s.mutex);
            ++s.seen.foreign_frames;
        }
        end_frame(s, current, drawable);
    });
}

void after_swap(std::uintptr_t drawable) noexcept {
    guarded([&](Session& s) {
        NativeContext* const context = thread_state.context;
        if (context && context->shadow && thread_state.drawable == drawable)
            start_recording(s, *context, drawable);
    });
}

void flushed() noexcept {
    guarded([](Session& s) { frame_ends_here(s, s.options.read_ends ? always : draws_to_front); });
}

} // namespace glcast::preload
