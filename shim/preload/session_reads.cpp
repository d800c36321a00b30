// Frames that end where they are read, and drawables that no swap shows (docs/design/architecture.md, "Where
// a frame ends").
#include <algorithm>
#include <utility>

#include "shim/preload/front_buffer.h"
#include "shim/preload/session_state.h"

namespace glcast::preload {
namespace {

/// What the program has drawn since its last frame ended, with the recordings going on: a swap may follow,
/// and end a frame with all of it.
std::vector<FramePart> lend_parts(Session& s, const NativeContext& current) {
    const std::lock_guard lock(s.mutex);
    std::vector<FramePart> lent;
    for (const FramePart& part : s.parts)
        if (!part.context->destroyed) lent.push_back(part);
    for (const auto& [handle, context] : s.contexts) {
        if (!context->recording || (context.get() != &current && context->threads > 0)) continue;
        if (auto frame = record::frame_so_far(*context->shadow))
            lent.push_back({context, context->recorded_drawable, std::move(frame)});
    }
    return lent;
}

/// Grows with each draw that is recorded, of all contexts whose drawing a read by `current` may show.
std::uint64_t drawn_so_far(Session& s, const NativeContext& current) {
    const std::lock_guard lock(s.mutex);
    std::uint64_t draws = s.parts.size();
    for (const auto& [handle, context] : s.contexts)
        if (context.get() == &current || (context->recording && context->threads == 0))
            draws += record::draws_so_far(*context->shadow);
    return draws;
}

/// Of the smallest picture that anybody reads to see it.
constexpr long picture_pixels = 1024;

/// True once for what was drawn: where a picture of it has been read, be it row by row.
bool has_read_a_picture(Session& s, NativeContext& context, long pixels) {
    const std::uint64_t drawn = drawn_so_far(s, context);
    if (drawn == 0) return false;
    if (drawn != context.reads.drawn) context.reads = {drawn, 0};
    const long before = std::exchange(context.reads.pixels, context.reads.pixels + pixels);
    return before < picture_pixels && context.reads.pixels >= picture_pixels;
}

/// The first frame is looked at while its recording goes on, for programs that read before their first swap
/// (to find what lies where, to make small pictures) and show it all then. Who has read twice is taken not to
/// swap at all.
void picture_is_read(Session& s, NativeContext& context, long pixels) {
    if (s.options.signal) s.triggers.look_for_signals(), update_unwanted(s);
    if (!s.wants_frames() || s.holding || record::busy(*context.shadow)) return;
    const std::uintptr_t drawable = thread_state.drawable;
    if (!context.recording) return start_recording(s, context, drawable);
    if (!has_read_a_picture(s, context, pixels)) return;
    ++s.frames;
    const FrameKey window(&context, drawable);
    if (s.pictures_read == 1) count_first_read(s);
    if (!s.wants_frames()) return;
    long number = 0, wish = 0;
    bool is_first = false;
    {
        const std::lock_guard lock(s.mutex);
        is_first = s.pictures_read++ == 0;
        if (is_first) s.first_read = window;
        Ended& ended = s.ended[window];
        number = ended.frames + 1;
        if (!is_first) ++ended.frames;
        wish = std::max(ended.next_wish, s.options.frame);
        s.pace.frame_ended(Clock::now());
    }
    auto parts = is_first ? lend_parts(s, context) : take_parts(s, &context, drawable);
    keep_of_this_display(parts);
    if (s.triggers.waiting() && is_late_enough(s) && number >= wish)
        cast_parts(s, std::move(parts), &context, window, number,
                   is_first ? FrameEnd::first_read : FrameEnd::read);
    else if (!is_first) // its recording goes on
        keep_standing(s, std::move(parts), window, number);
    start_recording(s, context, drawable);
}

bool always() { return true; }

} // namespace

void before_leaving() noexcept {
    if (!thread_state.is_pixmap || !thread_state.context || !thread_state.context->recording) return;
    guarded([](Session& s) { frame_ends_here(s, draws_to_front); });
}

void offscreen_made(std::uintptr_t drawable, bool is_pbuffer) noexcept {
    if (!drawable) return;
    guarded([&](Session& s) {
        const std::lock_guard lock(s.mutex);
        (is_pbuffer ? s.pbuffers : s.pixmaps).insert(drawable);
    });
}

bool reads_may_end_frames() noexcept {
    const Session* s = session_if_any();
    if (!s || !thread_state.context || !thread_state.context->shadow) return false;
    return s->options.read_ends || (!s->has_shown.load(std::memory_order_relaxed) && s->wants_frames());
}

void pixels_are_read(long pixels) noexcept {
    guarded([&](Session& s) {
        s.options.read_ends ? frame_ends_here(s, always) : picture_is_read(s, *thread_state.context, pixels);
    });
}

} // namespace glcast::preload
