#include "shim/preload/session.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <climits>
#include <cstdlib>
#include <mutex>
#include <unordered_map>

#include "shim/preload/cast.h"
#include "shim/preload/real.h"
#include "shim/preload/status.h"
#include "shim/preload/stub.h"

namespace glcast::preload {
namespace {

using Clock = std::chrono::steady_clock;

/// All that changes in the life of a process, but for what belongs to a thread.
struct Session {
    const Options options = read_options();
    const pid_t pid = getpid(); ///< a forked child has the parent's session and must leave it alone
    std::mutex mutex;           ///< guards `contexts` and the counts in them; never held over a GL or X call
    std::unordered_map<void*, std::unique_ptr<NativeContext>> contexts;
    std::atomic<bool> waiting{
        options.armed}; ///< for a frame to cast; false when all were cast, or none can be
    std::atomic<long> captures_left{options.captures > 0 ? options.captures : LONG_MAX};
    std::atomic<bool> casting{false};
    std::atomic<bool> hooked{false};
    std::atomic<bool> settled{false}; ///< captured, listed or failed: nothing more to say at exit
    std::atomic<long> frames{0}, empty_frames{0};
    Clock::time_point start{}; ///< of GL: when the first context was made current

    bool is_ours() const { return getpid() == pid; }
};

std::atomic<Session*> existing{nullptr};
/// Set when `waiting` ends, and read by every recorded call: threads then drop what they record.
constinit std::atomic<bool> stopped{false};

/// Never destroyed: other threads may draw while the process ends.
Session& session() {
    static Session* const made = [] {
        auto* fresh = new Session;
        if (!fresh->options.error.empty()) {
            say("%s (nothing will be captured)", fresh->options.error.c_str());
            tell("failed", fresh->options.error);
            fresh->settled = true;
        }
        existing = fresh;
        return fresh;
    }();
    return *made;
}

/// What is current on this thread. Trivial, so that it needs no destructor in foreign threads.
struct ThreadState {
    NativeContext* context;
    std::uintptr_t drawable;
    bool known; ///< to the recorder
};
constinit thread_local ThreadState thread_state{nullptr, 0, false};

void stop_waiting(Session& s) {
    s.waiting = false;
    stopped = true;
}

/// The one place where exceptions end: the shim gives up, the program goes on.
template <class Work> void guarded(Work&& work) noexcept {
    try {
        if (session().options.armed && session().is_ours()) work(session());
    } catch (const std::exception& error) {
        say_once("gave up: %s", error.what());
        if (Session* s = existing) {
            stop_waiting(*s);
            if (!s->settled.exchange(true)) tell("failed", error.what());
        }
    } catch (...) {
        if (Session* s = existing) stop_waiting(*s);
    }
}

void announce(Session& s, const WindowSystem& system) {
    if (s.hooked.exchange(true)) return;
    s.start = Clock::now();
    say("hooked %s in %s", system.name(), program_name().c_str());
    tell("hooked", system.name());
}

NativeContext* find_context(Session& s, void* handle) {
    const auto at = s.contexts.find(handle);
    return at == s.contexts.end() ? nullptr : at->second.get();
}

void forget_if_unused(Session& s, NativeContext* context) {
    if (context->destroyed && context->threads == 0) s.contexts.erase(context->handle);
}

void stop_recording(NativeContext& context) {
    if (!context.recording) return;
    context.recording = false;
    record::end_frame(*context.shadow);
}

bool is_due(Session& s, const NativeContext& context, std::uintptr_t drawable) {
    if (!s.waiting || !context.shadow || drawable == 0) return false;
    const auto seconds = std::chrono::duration<double>(Clock::now() - s.start).count();
    if (seconds < s.options.after_seconds) return false;
    const std::lock_guard lock(s.mutex);
    if (context.destroyed) return false;
    const auto at = context.frames.find(drawable);
    const auto frames = at == context.frames.end() ? NativeContext::Frames() : at->second;
    return frames.ended + 1 >= std::max(frames.next_wish, s.options.frame);
}

/// Record what follows, if it may be the frame that is waited for.
void start_recording(Session& s, NativeContext& context, std::uintptr_t drawable) {
    if (context.recording && context.recorded_drawable == drawable && s.waiting) return;
    stop_recording(context);
    if (!is_due(s, context, drawable)) return;
    if (const char* why = record::busy(*context.shadow)) {
        say_once("a frame cannot be recorded: %s (the next one is tried)", why);
        tell("refused", why);
        return;
    }
    record::begin_frame(*context.shadow);
    context.recording = true;
    context.recorded_drawable = drawable;
}

void frame_without_cast(Session& s) {
    const long frames = ++s.empty_frames;
    if ((frames & (frames - 1)) == 0) tell("frames", std::to_string(frames));
}

void end_program() {
    say("ending the program, as asked");
    kill(getpid(), SIGTERM);
}

/// A frame that was asked for is captured, listed, or lost for good.
void finish(Session& s, NativeContext& context, long number, const CastResult& result) {
    s.settled = true;
    const bool last = --s.captures_left <= 0 || result.outcome == CastOutcome::listed;
    if (last) stop_waiting(s);
    {
        const std::lock_guard lock(s.mutex);
        context.frames[context.recorded_drawable].next_wish = number + s.options.every;
    }
    if (context.sibling) context.system->destroy(context.display, context.sibling);
    context.sibling = nullptr;
    if (result.outcome == CastOutcome::failed) {
        say_once("%s", result.message.c_str());
        tell("failed", result.message);
    } else {
        say("%s", result.message.c_str());
    }
    if (last && result.outcome != CastOutcome::failed && s.options.quit) end_program();
}

void cast_recorded_frame(Session& s, NativeContext& context, long number) {
    context.recording = false;
    std::string why;
    const auto frame = record::end_frame(*context.shadow, &why);
    if (!frame) {
        say_once("a frame cannot be recorded: %s (the next one is tried)", why.c_str());
        tell("refused", why);
        return frame_without_cast(s);
    }
    if (!s.waiting || s.casting.exchange(true)) return; // another thread casts
    const CastResult result = cast_frame(context, *frame, number, s.options);
    s.casting = false;
    if (result.outcome == CastOutcome::nothing_solid) return frame_without_cast(s);
    finish(s, context, number, result);
}

bool is_destroyed(Session& s, const NativeContext& context) {
    const std::lock_guard lock(s.mutex);
    return context.destroyed;
}

/// Count the frame that ends here, and cast it if it was recorded.
void end_frame(Session& s, NativeContext& context, std::uintptr_t drawable) {
    ++s.frames;
    long number = 0;
    {
        const std::lock_guard lock(s.mutex);
        number = ++context.frames[drawable].ended;
    }
    if (!context.recording) return;
    // To leave a context that the program has destroyed would end it for good (piglit's glx-destroycontext-3).
    if (is_destroyed(s, context)) return stop_recording(context);
    cast_recorded_frame(s, context, number);
}

bool draws_to_front() {
    GLint buffer = GL_BACK;
    real_table().GetIntegerv(GL_DRAW_BUFFER, &buffer);
    return buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_FRONT_RIGHT ||
           buffer == GL_FRONT_AND_BACK;
}

const char* plural(long count) { return count == 1 ? "" : "s"; }

/// Without glcast-run, which tells it itself, somebody has to say why there is no capture.
[[gnu::destructor]] void report_at_exit() noexcept {
    const auto is_set = [](const char* name) { return std::getenv(name) && *std::getenv(name); };
    if (has_status_file() || !(is_set("GLCAST_OUT") || is_set("GLCAST_LIST"))) return;
    const Session* s = existing;
    const std::string program = program_name();
    if (!s || (!s->hooked && !s->settled)) return say("no GL seen in %s: nothing captured", program.c_str());
    if (!s->is_ours() || s->settled) return;
    const long frames = s->frames, empty = s->empty_frames;
    if (frames == 0) return say("%s ended no frame: nothing captured", program.c_str());
    if (empty == 0)
        return say("%s ended after %ld frame%s, before the one asked for: nothing captured", program.c_str(),
                   frames, plural(frames));
    say("%ld frame%s, none with solid geometry: nothing captured", frames, plural(frames));
}

} // namespace

thread_local int Outermost::depth = 0;

const GlTable& recording_table() {
    if (!thread_state.known) [[unlikely]] {
        record::set_current(nullptr, real_table());
        thread_state.known = true;
    }
    if (stopped.load(std::memory_order_relaxed) && thread_state.context) [[unlikely]]
        stop_recording(*thread_state.context);
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
        auto context = std::make_unique<NativeContext>();
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

void context_destroyed(void* handle) noexcept {
    guarded([&](Session& s) {
        const WindowSystem* system = nullptr;
        void *display = nullptr, *sibling = nullptr;
        {
            const std::lock_guard lock(s.mutex);
            NativeContext* context = find_context(s, handle);
            if (!context) return;
            system = context->system, display = context->display;
            std::swap(sibling, context->sibling);
            context->destroyed = true;
            forget_if_unused(s, context);
        }
        if (sibling) system->destroy(display, sibling);
    });
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
        thread_state = {now, binding.draw, true};
        record::set_current(now ? now->shadow.get() : nullptr, real_table());
        if (!now || !now->shadow) return;
        announce(s, *now->system);
        start_recording(s, *now, binding.draw);
    });
}

void before_swap(std::uintptr_t drawable) noexcept {
    guarded([&](Session& s) {
        NativeContext* const context = thread_state.context;
        if (!context || !context->shadow || thread_state.drawable != drawable) return;
        end_frame(s, *context, drawable);
    });
}

void after_swap(std::uintptr_t drawable) noexcept {
    guarded([&](Session& s) {
        NativeContext* const context = thread_state.context;
        if (context && context->shadow && thread_state.drawable == drawable)
            start_recording(s, *context, drawable);
    });
}

bool always() { return true; }

/// A frame's end that is no swap; the next one begins right behind it.
void frame_ends_here(Session& s, bool (*really)()) {
    NativeContext* const context = thread_state.context;
    if (!s.waiting || !context || !context->shadow || thread_state.drawable == 0) return;
    if (record::busy(*context->shadow) || !really()) return;
    end_frame(s, *context, thread_state.drawable);
    start_recording(s, *context, thread_state.drawable);
}

void flushed() noexcept {
    guarded([](Session& s) { frame_ends_here(s, s.options.read_ends ? always : draws_to_front); });
}

void about_to_read() noexcept {
    if (!existing.load(std::memory_order_relaxed) || !session().options.read_ends) return;
    guarded([](Session& s) { frame_ends_here(s, always); });
}

} // namespace glcast::preload
