// Begins and ends the recording of a frame.
#include "shim/record/lists.h"
#include "shim/record/packets.h"
#include "shim/record/snapshot.h"
#include "shim/record/textures.h"

namespace glcast::record {

namespace {

constexpr GLenum query_targets[] = {GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED, GL_PRIMITIVES_GENERATED,
                                    GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, GL_TIME_ELAPSED};

bool query_is_active(const GlTable& gl, const Limits& limits) {
    for (const GLenum target : query_targets) {
        const int since = target == GL_SAMPLES_PASSED ? 15 : 33;
        GLint name = 0;
        if (limits.has(since)) gl.GetQueryiv(target, GL_CURRENT_QUERY, &name);
        if (name) return true;
    }
    return false;
}

void start_recording(Context& context) {
    auto recording = std::make_unique<Recording>();
    write_state(context, recording->frame->prologue, true);
    read_matrices(context, *recording);
    note_bound_textures(*recording);
    {
        const std::lock_guard lock(context.group->mutex);
        recording->frame->lists = context.group->lists;
        recording->seen_changes = context.group->changes.size();
        ++context.group->recording;
        context.recording = std::move(recording);
    }
    copy_nameless_textures(context);
}

void name_counts(Recording& recording) {
    for (std::size_t i = 0; i < gl_call_count; ++i)
        if (recording.counts[i])
            recording.frame->not_understood[gl_call_names[i]] += std::exchange(recording.counts[i], 0);
}

} // namespace

const char* busy(const Context& shadow) {
    auto& context = const_cast<Context&>(shadow); // reads its limits once
    if (context.in_begin) return "inside glBegin";
    if (context.compilation) return "a display list is open";
    const Limits& limits = context.get_limits();
    if (limits.es) return "an OpenGL ES context";
    if (!limits.compatibility) return "a core profile context: only fixed-function GL is recorded";
    const GLint mode = get_int(context.real, GL_RENDER_MODE, GL_RENDER);
    if (mode == GL_SELECT) return "in selection mode";
    if (mode == GL_FEEDBACK) return "in feedback mode";
    if (query_is_active(context.real, limits)) return "a query is active";
    if (limits.has(40, "GL_ARB_transform_feedback2") && get_int(context.real, GL_TRANSFORM_FEEDBACK_ACTIVE))
        return "transform feedback is active";
    return nullptr;
}

void begin_frame(Context& context) {
    if (context.recording) return;
    context.start_listening();
    try {
        start_recording(context);
    } catch (const std::exception&) {
        context.stop_listening();
    }
}

std::shared_ptr<const Frame> end_frame(Context& context, std::string* why) {
    if (!context.recording) {
        if (why) *why = "out of memory"; // begin_frame could not begin
        return nullptr;
    }
    const std::unique_ptr<Recording> recording = std::move(context.recording);
    {
        const std::lock_guard lock(context.group->mutex);
        if (--context.group->recording == 0) context.group->changes.clear();
    }
    context.stop_listening();
    if (!recording->given_up.empty()) {
        if (why) *why = recording->given_up;
        return nullptr;
    }
    name_counts(*recording);
    recording->frame->prepared = nullptr; // by a look at a part of it (frame_so_far)
    return recording->frame;
}

std::shared_ptr<const Frame> frame_so_far(Context& context) {
    if (!context.recording || !context.recording->given_up.empty()) return nullptr;
    name_counts(*context.recording);
    context.recording->frame->prepared = nullptr; // for what was recorded then
    return context.recording->frame;
}

std::uint64_t draws_so_far(const Context& context) {
    return context.recording ? context.recording->draws : 0;
}

const std::map<std::string, long>& not_understood(const Frame& frame) { return frame.not_understood; }

std::size_t frame_bytes(const Frame& frame) {
    std::size_t sum = sizeof frame + frame.prologue.allocated_bytes() + frame.calls.allocated_bytes();
    for (const Blob& blob : frame.blobs) sum += blob->size();
    for (const TextureCopy& copy : frame.textures) sum += copy.contents.allocated_bytes();
    for (const auto& [name, list] : frame.lists) sum += list->allocated_bytes();
    for (const List& list : frame.redefinitions) sum += list->allocated_bytes();
    return sum;
}

} // namespace glcast::record
