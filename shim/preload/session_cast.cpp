// The frames of a session that have ended: which are cast, and what is told of the others.
#include <malloc.h>
#include <signal.h>

#include <cstdlib>
#include <thread>

#include "shim/preload/cast.h"
#include "shim/preload/own_stack.h"
#include "shim/preload/own_thread.h"
#include "shim/preload/session_state.h"
#include "shim/preload/start.h"
#include "shim/preload/status.h"
#include "shim/preload/wine.h"

namespace glcast::preload {
namespace {

/// Say now and then what is seen instead of a solid: a program may be killed at any time.
void frame_without_cast(Session& s, const Census& held) {
    long frames = 0;
    std::string text;
    {
        const std::lock_guard lock(s.mutex);
        s.seen += held;
        frames = ++s.seen.frames;
        const unsigned kinds = s.seen.kinds();
        if ((frames & (frames - 1)) != 0 && kinds == s.told_kinds) return;
        s.told_kinds = kinds;
        text = explain(s.seen);
    }
    tell("frames", std::to_string(frames));
    tell("seen", text);
}

void end_program() {
    if (speaks_alone()) say("ending the program, as asked");
    kill(getpid(), SIGTERM);
}

/// How long other windows may take to show something better.
constexpr std::chrono::milliseconds patience{1500};
constexpr std::chrono::milliseconds look_again{20};

bool chooses_a_window(const Options& options) {
    return options.window.empty() && (options.list || (options.captures == 1 && options.group == 0));
}

bool takes_one(const Options& options) { return options.list || options.captures == 1; }

/// What is held is the last word. From any thread.
void settle(Session& s) {
    if (!s.holding.exchange(false)) return;
    s.triggers.give_up();
    update_unwanted(s);
    tell("settled", "");
    if (s.options.quit) end_program();
}

void settle_in_time(Session& s) {
    std::this_thread::sleep_for(patience);
    while (s.casting.exchange(true)) std::this_thread::sleep_for(look_again); // and none begins meanwhile
    settle(s);
    s.casting = false;
}

/// The windows that are not drawn again must not keep people waiting.
void hold(Session& s) {
    if (s.holding.exchange(true)) return;
    s.settled = true;
    if (!start_own_thread([&s] { settle_in_time(s); })) settle(s);
}

/// A frame that was asked for is captured, listed, or lost for good.
void finish(Session& s, FrameKey window, long number, const CastResult& result) {
    s.settled = true;
    const bool last = s.triggers.taken() || result.outcome == CastOutcome::listed;
    if (result.outcome == CastOutcome::listed) s.triggers.give_up();
    update_unwanted(s);
    {
        const std::lock_guard lock(s.mutex);
        s.ended[window].next_wish = number + s.options.every;
    }
    if (s.told_looks) tell("settled", "");
    if (result.outcome == CastOutcome::failed) {
        if (speaks_alone()) say_once("%s", result.message.c_str());
        tell("failed", result.message);
    } else if (speaks_alone()) {
        say("%s", result.message.c_str());
    }
    if (last && result.outcome != CastOutcome::failed && s.options.quit) end_program();
}

void look_at_windows(Session& s, const NativeContext& context) {
    std::vector<std::uint32_t> names;
    {
        const std::lock_guard lock(s.mutex);
        names = s.windows.names();
    }
    const WindowAnswers answers = s.inquiry.ask(context.system->server(context.display), std::move(names));
    const std::lock_guard lock(s.mutex);
    s.windows.learn(answers);
}

/// Nothing where no frame of this window is wanted.
std::optional<CastWindow> take_turn(Session& s, const NativeContext& context, std::uintptr_t drawable,
                                    FrameEnd end) {
    const std::string& wanted = s.options.window;
    bool alone = false;
    {
        const std::lock_guard lock(s.mutex);
        if (s.holding && !s.read_is_held && s.windows.is_done(drawable)) return std::nullopt;
        alone = s.windows.count() <= 1;
    }
    const bool chooses = !alone && chooses_a_window(s.options);
    if (chooses || s.options.list || !wanted.empty()) look_at_windows(s, context);
    std::unique_lock lock(s.mutex);
    if (wanted.empty() || s.windows.is_wanted(drawable, wanted)) {
        s.seen.other_windows.clear();
        const bool may_follow = end == FrameEnd::first_read || end == FrameEnd::read
                                    ? takes_one(s.options)
                                    : chooses_a_window(s.options) && s.windows.others_may_follow(drawable);
        if (may_follow && !s.told_looks.exchange(true)) tell("looks", s.windows.list());
        return CastWindow{s.windows.describe(drawable),
                          s.holding && !s.read_is_held ? s.windows.held() : std::nullopt,
                          s.holding || (s.read_is_open && end == FrameEnd::shown), s.inquiry.unanswered()};
    }
    Census other;
    other.other_windows =
        "no window that was drawn to is --window " + wanted + ", there are: " + s.windows.list();
    lock.unlock();
    frame_without_cast(s, other);
    return std::nullopt;
}

/// A frame that a read has ended is held: a swap may soon show what is better. False: it is to be taken as
/// any.
bool holds_a_read(Session& s, const CastResult& result, FrameEnd end) {
    const bool shown = result.outcome == CastOutcome::captured || result.outcome == CastOutcome::listed;
    const bool is_only = takes_one(s.options);
    if (!shown || (!is_only && end != FrameEnd::first_read)) return false;
    if (speaks_alone()) say("%s, ended by a read: nothing was swapped", result.message.c_str());
    (is_only ? s.read_is_held : s.read_is_open) = true;
    s.settled = true;
    if (is_only) hold(s);
    return true;
}

/// What comes of a frame where the program has several windows. False: it is to be taken as if there were
/// one.
bool among_windows(Session& s, std::uintptr_t drawable, const CastResult& result) {
    const bool shown = result.outcome == CastOutcome::captured || result.outcome == CastOutcome::listed;
    bool more = false;
    {
        const std::lock_guard lock(s.mutex);
        s.windows.hold(drawable, result.rating);
        more = s.holding ? s.windows.any_may_follow() : s.windows.others_may_follow(drawable);
    }
    if (s.holding) {
        if (shown && speaks_alone()) say("%s", result.message.c_str());
        if (shown) s.read_is_held = false;
        if (!more && !s.read_is_held) settle(s);
        return true;
    }
    if (!shown || !more || !chooses_a_window(s.options)) return false;
    if (speaks_alone()) say("%s", result.message.c_str());
    hold(s);
    return true;
}

const char* plural(long count) { return count == 1 ? "" : "s"; }

bool is_captured_by_a_child() {
    const char* out = std::getenv("GLCAST_OUT");
    return out && written_since_start(absolute_at_start(out));
}

/// Without glcast-run, which tells it itself, somebody has to say why there is no capture.
[[gnu::destructor]] void report_at_exit() noexcept {
    const auto is_set = [](const char* name) { return std::getenv(name) && *std::getenv(name); };
    if (!(is_set("GLCAST_OUT") || is_set("GLCAST_LIST"))) return;
    Session* s = session_if_any();
    const std::string program = program_name();
    if (!s || (!s->hooked && !s->settled)) {
        if (!has_status_file() && is_meant_program() && !is_wine_helper() && !is_captured_by_a_child())
            say("no GL seen in %s: nothing captured", program.c_str());
        return;
    }
    if (!s->is_ours() || s->settled) return;
    const std::lock_guard lock(s->mutex);
    const long frames = s->frames, empty = s->seen.frames;
    const std::string why = explain(s->seen);
    if (has_status_file()) {
        tell("frames", std::to_string(empty));
        if (empty > 0) tell("seen", why);
        return;
    }
    if (const char* where = s->offscreen; where && frames == 0)
        return say("%s draws into %s, and neither swaps nor reads what it draws: nothing captured",
                   program.c_str(), where);
    if (frames == 0) return say("%s ended no frame: nothing captured", program.c_str());
    if (empty == 0)
        return say("%s ended after %ld frame%s, before the one asked for: nothing captured", program.c_str(),
                   frames, plural(frames));
    say("%ld frame%s, none with solid geometry: nothing captured (%s)", empty, plural(empty), why.c_str());
}

/// The contexts of a cast: the one that is current on this thread, which it leaves for a while, and those of
/// the parts, of which it makes siblings. Where the program destroys one meanwhile, that is done when the
/// cast is over.
class HeldContexts {
  public:
    /// Parts whose context is gone go.
    HeldContexts(Session& session, std::vector<FramePart>& parts, const NativeContext* current) : s(session) {
        const std::lock_guard lock(s.mutex);
        // To leave a context that the program has destroyed would end it for good (piglit's
        // glx-destroycontext-3).
        if (current && current->destroyed) parts.clear();
        std::erase_if(parts, [](const FramePart& part) { return part.context->destroyed; });
        if (parts.empty()) return;
        held.reserve(parts.size() + 1);
        for (const FramePart& part : parts) hold(part.context);
        if (const auto at = current ? s.contexts.find(current->handle) : s.contexts.end();
            at != s.contexts.end())
            hold(at->second);
    }
    ~HeldContexts() {
        for (const auto& context : held)
            if (is_destroyed(*context)) destroy(*context);
    }
    HeldContexts(const HeldContexts&) = delete;
    HeldContexts& operator=(const HeldContexts&) = delete;

  private:
    Session& s;
    std::vector<std::shared_ptr<NativeContext>> held;

    void hold(const std::shared_ptr<NativeContext>& context) {
        if (context->in_cast) return;
        held.push_back(context);
        context->in_cast = true;
    }
    bool is_destroyed(NativeContext& context) {
        const std::lock_guard lock(s.mutex);
        context.in_cast = false;
        return context.destroyed;
    }
    static void destroy(NativeContext& context) {
        if (void* sibling = context.sibling.exchange(nullptr))
            context.system->destroy(context.display, sibling);
        context.system->destroy(context.display, context.handle);
    }
};

bool is_read(FrameEnd end) { return end == FrameEnd::first_read || end == FrameEnd::read; }

enum class Looked {
    passed,  ///< it was not looked at
    nothing, ///< solid is in it
    done     ///< it was drawn, and cast if nothing went wrong
};

Looked cast_or_pass(Session& s, std::vector<FramePart>& parts, const NativeContext* current, FrameKey window,
                    long number, FrameEnd end, long unseen = 0) {
    if (s.casting.exchange(true)) return Looked::passed; // another thread casts
    struct Over {
        std::atomic<bool>& casting;
        ~Over() { casting = false; }
    } const over{s.casting};
    if (!s.triggers.waiting()) return Looked::passed; // it has cast the last that was wanted
    const HeldContexts held(s, parts, current);
    if (parts.empty()) return Looked::passed;
    auto turn = take_turn(s, *parts.front().context, window.second, end);
    if (!turn) return Looked::passed;
    turn->at_rest = end == FrameEnd::at_rest;
    turn->unseen = unseen;
    const CastResult result = cast_frame(parts, number, s.options, *turn, s.listed);
    const bool nothing = result.outcome == CastOutcome::nothing_solid;
    if (end == FrameEnd::shown && s.read_is_open.exchange(false) && nothing) s.triggers.taken(); // it stays
    if (is_read(end) ? !holds_a_read(s, result, end) : !among_windows(s, window.second, result))
        nothing ? frame_without_cast(s, result.held) : finish(s, window, number, result);
    return nothing ? Looked::nothing : Looked::done;
}

void give_back_memory() {
    record::give_back_spare_memory();
    malloc_trim(0); // images, and the driver's textures, would stay in the program's heap
}

} // namespace

void count_first_read(Session& s) {
    const bool is_cast = s.read_is_open.exchange(false);
    {
        const std::lock_guard lock(s.mutex);
        Ended& ended = s.ended[s.first_read];
        ++ended.frames;
        if (is_cast) ended.next_wish = ended.frames + s.options.every;
    }
    if (is_cast) s.triggers.taken();
    update_unwanted(s);
}

bool is_asked_for(Session& s, const StandingPicture& picture) {
    if (picture.number < s.options.frame) return false;
    if (!s.options.key.empty() || s.options.signal != 0) return true;
    const std::lock_guard lock(s.mutex);
    const auto ended = s.ended.find(picture.window);
    return ended == s.ended.end() || picture.number >= ended->second.next_wish;
}

bool cast_standing(Session& s, const NativeContext* current, FrameEnd end) {
    std::vector<StandingPicture> pictures;
    {
        const std::lock_guard lock(s.mutex);
        pictures = s.standing.all();
    }
    bool any = false;
    for (StandingPicture& picture : pictures) {
        if (!s.triggers.waiting() || !is_asked_for(s, picture)) continue;
        if (end == FrameEnd::at_rest && picture.unseen > 0) continue; // it is another that stands there
        keep_of_this_display(picture.parts);
        Looked looked = Looked::passed;
        on_own_stack(HeldSignals::handled, [&] {
            looked =
                cast_or_pass(s, picture.parts, current, picture.window, picture.number, end, picture.unseen);
        });
        if (looked == Looked::nothing) {
            const std::lock_guard lock(s.mutex);
            s.standing.forget_frame(picture.window, picture.number);
        }
        any |= looked == Looked::done;
        if (any && !s.holding) break; // other windows may show more
    }
    if (any) give_back_memory();
    return any;
}

void cast_parts(Session& s, std::vector<FramePart> parts, const NativeContext* current, FrameKey window,
                long number, FrameEnd end) {
    if (parts.empty()) {
        frame_without_cast(s, {});
    } else {
        if (end != FrameEnd::first_read) keep_standing(s, parts, window, number);
        Looked looked = Looked::passed;
        on_own_stack(HeldSignals::handled,
                     [&] { looked = cast_or_pass(s, parts, current, window, number, end); });
        parts.clear();
        if (looked == Looked::done) {
            give_back_memory();
            return make_ready_for_rest(s);
        }
        const std::lock_guard lock(s.mutex);
        if (looked == Looked::nothing) s.standing.forget_frame(window, number);
    }
    if (!s.holding && cast_standing(s, current, end)) make_ready_for_rest(s);
}

} // namespace glcast::preload
