// Recorder and replayer of fixed-function GL. Knows nothing of preloading, GLX or EGL: it sits between
// anything that calls a GlTable and the real one, so it is tested through OSMesa.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::record {

/// What contexts share: display lists and buffer shadows.
struct ShareGroup;
/// The shadow of one GL context: what cannot be read back later (client arrays, Begin/End and list mode, map
/// ranges).
struct Context;

/// A new context's shadow. `real` must outlive it. `shared_with` may be null.
std::shared_ptr<Context> make_context(const GlTable& real, const std::shared_ptr<Context>& shared_with);

/// Are their lists, textures and buffers the same?
bool share_objects(const Context& a, const Context& b);

/// Make it this thread's; null for none. While none is set, table() passes straight through to `fallback`.
void set_current(Context* context, const GlTable& fallback);

/// Entry points that record, and call the real ones of this thread's context exactly once with the same
/// arguments. Everything that a program can see (errors, results, state) is the real one's.
const GlTable& table();

/// More than 0 while any context records a frame or compiles a list: then the stubs of all calls must go
/// through table(). At 0 only the calls of `always_shadowed(call)` must. This is the one branch of the idle
/// cost.
extern std::atomic<std::uint32_t> active;
bool always_shadowed(GlCall call);

/// The most bytes that all frames and lists may take together: calls, copies of buffers and of textures, and
/// the textures that replays make of these; more than that is as if memory had run out. For the whole
/// process.
void set_memory_limit(std::size_t bytes);

/// Up to 8 MiB of what was recorded before is kept for the next frame: goes back to the system.
void give_back_spare_memory();

/// Why a frame cannot be recorded from here: null when it can, else "inside glBegin", "a display list is
/// open", ...
const char* busy(const Context& context);

/// A recorded frame: a prologue that sets the whole state which the frame started from, the calls of the
/// frame with the client memory they read, and the display lists as they stood (late-bound names,
/// redefinitions in the frame included).
struct Frame;

/// The context must be current on this thread and not busy. Queries the state (never leaving an error or a
/// change).
void begin_frame(Context& context);
/// Ends the recording. Null when it had to be given up (out of memory), with the reason in `why`.
std::shared_ptr<const Frame> end_frame(Context& context, std::string* why = nullptr);
/// What is recorded so far, for a look at it before the context's next call; the recording goes on. Null as
/// above.
std::shared_ptr<const Frame> frame_so_far(Context& context);
/// Draws and calls of lists in it; 0 where nothing is recorded.
std::uint64_t draws_so_far(const Context& context);

/// What was called in the frame but not recorded, by entry point or reason -> how often.
const std::map<std::string, long>& not_understood(const Frame& frame);
std::size_t frame_bytes(const Frame& frame);

/// Lists `first`, `first` + 1, ... were given contents by other means than GL calls (glXUseXFont): they are
/// skipped and counted.
void note_opaque_lists(Context& context, GLuint first, GLsizei count);

/// Deletes the copies of textures that replays of the frame have made, in a context that shares objects with
/// the program's. Nothing may be replayed after.
bool has_copies(const Frame& frame);
void delete_copies(const Frame& frame, const GlTable& gl);

/// Lets go of the program's objects that a context of ours, which may live on, still holds after replays of
/// the frame: of textures in its bindings and on its stack of attributes. These would come back at the next
/// replay, to which the program may have changed them, and contexts share what comes back: parameters of
/// textures.
void let_go(const Frame& frame, const GlTable& gl);

/// A draw as it is played, with glDrawArrays or glDrawElements.
struct DrawParts {
    GLenum mode;
    bool is_known; ///< where its vertices lie, whose w is 1
    bool is_whole; ///< no vertex is left over that makes no primitive
    /// Elements (vertices or indices), counted from the draw's first; whole primitives that may be drawn for
    /// themselves, in order. Of strips, the last two are those that the next part begins with.
    struct Part {
        std::uint32_t first, count;
    };
    std::vector<Part> parts; ///< one, where it is drawn as a whole
};

/// Before the first replay: what is drawn between glBegin and glEnd becomes arrays, where the same comes of
/// that to the bit, so that replays need not make each call again. Memory counts as a recording; what does
/// not fit stays as it is.
void prepare(const Frame& frame);

/// While replay() calls glDrawArrays or glDrawElements of a prepared frame, on this thread: what is drawn.
/// Null: nothing is known of it.
const DrawParts* parts_of_draw();
/// x, y and z of the vertices of a part of it, in the program's own coordinates.
void read_positions(const DrawParts::Part& part, std::vector<float>& xyz);

/// Play prologue, frame and expanded lists into `gl`, in a context that shares objects with the program's.
/// Calls that only have side effects on shared objects (uploads, deletes) and reads are not played. Matrix
/// and attribute stacks of the context are emptied first, so it can be called again and again. `gl` may be an
/// override table.
/// `before_calls` is called between the prologue and the program's own calls.
void replay(const Frame& frame, const GlTable& gl, const std::function<void()>& before_calls = {});

} // namespace glcast::record
