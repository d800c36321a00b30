// What the parts of a session share (session.h).
#pragma once
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <unordered_map>
#include <utility>

#include "shim/preload/census.h"
#include "shim/preload/host_thread.h"
#include "shim/preload/rest_gate.h"
#include "shim/preload/session.h"
#include "shim/preload/standing.h"
#include "shim/preload/status.h"
#include "shim/preload/triggers.h"
#include "shim/preload/windows.h"

namespace glcast::preload {

using Clock = std::chrono::steady_clock;

struct Ended {
    long frames = 0;
    long next_wish = 1; ///< the first that may be cast
};
/// All that changes in the life of a process, but for what belongs to a thread.
struct Session {
    const Options options = read_options();
    const pid_t pid = getpid(); ///< a forked child has the parent's session and must leave it alone
    Triggers triggers{options};
    std::mutex mutex; ///< guards what follows; never held over a GL or X call
    std::unordered_map<void*, std::shared_ptr<NativeContext>> contexts;
    std::map<FrameKey, Ended> ended;
    std::set<std::uintptr_t> swapped; ///< drawables
    std::vector<FramePart> parts;     ///< of the frame that has not ended yet
    Pace pace;
    StandingPictures standing;
    std::set<std::uintptr_t> pbuffers, pixmaps;
    long pictures_read = 0; ///< frames that a read has ended
    FrameKey first_read;    ///< where the first of these was, which counts when the second comes
    Census seen;
    unsigned told_kinds = 0;
    Windows windows;
    WindowInquiry inquiry;         ///< of who sets `casting`
    std::vector<Candidate> listed; ///< of the windows that were looked at so far

    std::atomic<bool> casting{false}, hooked{false};
    std::atomic<bool> settled{false};    ///< captured, listed or failed: nothing more to say at exit
    std::atomic<bool> told_looks{false}; ///< other windows may still show something better
    std::atomic<bool> holding{false};    ///< something is captured or listed, and not yet the last word
    std::atomic<bool> read_is_held{
        false}; ///< of a frame that a read has ended: whatever a swap shows is better
    std::atomic<bool> read_is_open{false}; ///< the same, where several captures are wanted: not counted yet
    std::atomic<bool> has_shown{false};    ///< a frame has ended by a swap, or by a flush of the front buffer
    std::atomic<const char*> offscreen{nullptr}; ///< where it draws that is no window
    std::atomic<long> frames{0};
    std::atomic<Clock::time_point> start{}; ///< of GL: when the first context was made current
    RestGate gate;
    bool has_told_of_rest = false, needs_program_thread = false; ///< of our own thread

    /// The picture that stands in the window is wanted as well as the next frame.
    bool keeps_standing() const {
        return options.after_seconds > 0 || !options.key.empty() || options.signal != 0;
    }
    /// One is to be cast, or to be kept until it is.
    bool wants_frames() const { return triggers.waiting() || (keeps_standing() && !triggers.over()); }

    bool is_ours() const { return getpid() == pid; }
};

/// Never destroyed: other threads may draw while the process ends.
Session& session();
/// Null before anything of GL was seen.
Session* session_if_any();

/// What is current on this thread. Trivial, so that it needs no destructor in foreign threads.
struct ThreadState {
    NativeContext* context;
    std::uintptr_t drawable;
    bool known;                 ///< to the recorder
    bool is_pbuffer, is_pixmap; ///< the drawable
};
extern thread_local ThreadState thread_state [[gnu::tls_model("initial-exec")]];

/// For good: nothing will be captured. `why`, where not null, is told once.
void give_up(const char* why) noexcept;

/// The program's thread waits until no picture at rest is cast.
void pass_gate(Session& s) noexcept;

/// The one place where exceptions end: the shim gives up, the program goes on.
template <class Work> void guarded(Work&& work) noexcept {
    try {
        Session& s = session();
        if (!s.options.armed || !s.is_ours()) return;
        if (calls_wait_at_gate()) pass_gate(s);
        const HostThread program;
        work(s);
    } catch (const std::exception& error) {
        say_once("gave up: %s", error.what());
        give_up(error.what());
    } catch (...) {
        give_up(nullptr);
    }
}

/// --after SECONDS are over.
bool is_late_enough(const Session& s);
/// Record what follows, if it may be the frame that is waited for.
void start_recording(Session& s, NativeContext& context, std::uintptr_t drawable);
/// What was drawn since the last frame ended and shows with this drawable: its own parts, and those of
/// drawables that are never swapped. `context`, where not null, is current on this thread.
std::vector<FramePart> take_parts(Session& s, NativeContext* context, std::uintptr_t drawable);
/// Another connection may be closed by now (piglit's glx-multithread-clearbuffer), and shares nothing with
/// ours.
void keep_of_this_display(std::vector<FramePart>& parts);
/// A frame's end that is no swap; the next one begins right behind it.
void frame_ends_here(Session& s, bool (*really)());

/// Whether frames are recorded follows from the triggers.
void update_unwanted(Session& s);

/// A whole frame ended in `window` that is not cast now: it stands there, until another does. Empty: it was
/// not recorded.
void keep_standing(Session& s, std::vector<FramePart> parts, FrameKey window, long number);
/// What our own thread needs to cast what stands, which it cannot ask an X server for.
void make_ready_for_rest(Session& s);
/// From our own thread, now and then: casts what stands in a program that draws nothing new.
void cast_at_rest(Session& s);

/// `at_rest`: long ago, by a swap; it is cast on a thread of our own.
enum class FrameEnd { shown, first_read, read, at_rest };

/// The frame that the first read has ended counts, for no swap came.
void count_first_read(Session& s);
/// A frame that ended in `window`, the number-th there: cast it, or note what it holds instead. `parts` may
/// be empty. `current`, where not null, is current on this thread.
void cast_parts(Session& s, std::vector<FramePart> parts, const NativeContext* current, FrameKey window,
                long number, FrameEnd end);
/// A key or a signal asks for what stands there, be it the second time; else each frame is cast once.
bool is_asked_for(Session& s, const StandingPicture& picture);
/// Casts what stands, the last first, until nothing more is wanted. Whether anything came of it.
bool cast_standing(Session& s, const NativeContext* current, FrameEnd end);

} // namespace glcast::preload
