#include "shim/record/lists.h"

#include <algorithm>
#include <cmath>

#include "shim/record/arrays.h"
#include "shim/record/packets.h"
#include "shim/record/state.h"

namespace glcast::record {

namespace {

void change_list(Context& context, GLuint name, const List& list) {
    ShareGroup& group = *context.group;
    const std::lock_guard lock(group.mutex);
    if (list)
        group.lists[name] = list;
    else
        group.lists.erase(name);
    if (group.recording) group.changes.push_back({name, list});
}

List find_list(Context& context, GLuint name) {
    const std::lock_guard lock(context.group->mutex);
    const auto found = context.group->lists.find(name);
    return found == context.group->lists.end() ? nullptr : found->second;
}

/// Element i of the array of glCallLists, as Mesa and the specification read it.
bool list_number(GLenum type, const void* lists, GLsizei i, GLuint& number) {
    const auto* bytes = static_cast<const GLubyte*>(lists);
    const auto element = [&]<class T>(T) {
        T value;
        std::memcpy(&value, bytes + std::size_t(i) * sizeof value, sizeof value);
        return value;
    };
    const auto big_endian = [&](std::size_t n) {
        GLuint value = 0;
        for (std::size_t k = 0; k < n; ++k) value = value * 256 + bytes[std::size_t(i) * n + k];
        return value;
    };
    switch (type) {
    case GL_BYTE:
        number = GLuint(element(GLbyte()));
        return true;
    case GL_UNSIGNED_BYTE:
        number = element(GLubyte());
        return true;
    case GL_SHORT:
        number = GLuint(element(GLshort()));
        return true;
    case GL_UNSIGNED_SHORT:
        number = element(GLushort());
        return true;
    case GL_INT:
        number = GLuint(element(GLint()));
        return true;
    case GL_UNSIGNED_INT:
        number = element(GLuint());
        return true;
    case GL_FLOAT:
        number = GLuint(GLint(std::floor(element(GLfloat()))));
        return true;
    case GL_2_BYTES:
        number = big_endian(2);
        return true;
    case GL_3_BYTES:
        number = big_endian(3);
        return true;
    case GL_4_BYTES:
        number = big_endian(4);
        return true;
    default:
        return false;
    }
}

/// What a call to a list that is known now does to the context's shadow.
void follow_list(Context& context, GLuint name) {
    const List list = find_list(context, name);
    if (!list) return;
    if (list->opaque && context.executes()) context.count("a display list whose contents are unknown");
    if (context.compilation) {
        context.compilation->stream->draws |= list->draws;
        context.compilation->stream->sets_program |= list->sets_program;
    }
    if (list->draws && list->sets_program && context.executes()) context.count("a draw under a GLSL program");
    if (list->draws && !list->sets_program) count_if_not_played(context);
    if (list->begin_state == Stream::BeginState::unchanged) return;
    if (context.compilation) context.compilation->stream->begin_state = list->begin_state;
    if (context.executes()) context.in_begin = list->begin_state == Stream::BeginState::inside;
}

void note_popped(Context& context) {
    note_popped_matrix(context);
    note_popped_attributes(context);
}

void write_numbers(Stream& stream, const std::vector<GLuint>& numbers) {
    Writer writer(stream.append(Op(GlCall::CallLists), 4 + 4 * numbers.size()));
    writer.put(std::uint32_t(numbers.size())).put_bytes(numbers.data(), 4 * numbers.size());
}

std::uint32_t add_redefinition(Frame& frame, const List& list) {
    frame.redefinitions.push_back(list);
    return std::uint32_t(frame.redefinitions.size() - 1);
}

void write_change(Recording& recording, const ListChange& change) {
    Frame& frame = *recording.frame;
    const ExtraOp op = change.list ? ExtraOp::define_list : ExtraOp::delete_list;
    Writer writer(frame.calls.append(Op(op), 8));
    writer.put(change.name).put(change.list ? add_redefinition(frame, change.list) : 0u);
}

} // namespace

void note_list_changes(Context& context) {
    Recording* recording = context.recording.get();
    if (!recording || !recording->given_up.empty()) return;
    try {
        const std::lock_guard lock(context.group->mutex);
        const std::vector<ListChange>& changes = context.group->changes;
        for (; recording->seen_changes < changes.size(); ++recording->seen_changes)
            write_change(*recording, changes[recording->seen_changes]);
    } catch (const std::exception&) {
        context.give_up_frame("out of memory");
    }
}

void note_opaque_lists(Context& context, GLuint first, GLsizei count) {
    auto list = std::make_shared<Stream>();
    list->opaque = true;
    for (GLsizei i = 0; i < count; ++i) change_list(context, first + GLuint(i), list);
}

} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY NewList(GLuint list, GLenum mode) {
    this_thread.real->NewList(list, mode);
    Context* context = this_thread.context;
    if (!context || context->compilation || context->in_begin) return;
    // Asked, because the call may have failed. Inside glBegin both raise the same error, so nobody can tell.
    GLint open = 0, how = 0;
    context->real.GetIntegerv(GL_LIST_INDEX, &open);
    if (open == 0 || GLuint(open) != list) return;
    context->real.GetIntegerv(GL_LIST_MODE, &how);
    try {
        context->compilation.reset(new Compilation{list, how == GL_COMPILE_AND_EXECUTE});
    } catch (const std::exception&) {
        return note_opaque_lists(*context, list, 1);
    }
    context->get_limits();
    context->start_listening();
}

void APIENTRY EndList() {
    this_thread.real->EndList();
    Context* context = this_thread.context;
    if (!context || !context->compilation) return;
    const std::unique_ptr<Compilation> done = std::move(context->compilation);
    done->stream->shrink();
    try {
        change_list(*context, done->name, done->stream);
    } catch (const std::exception&) {
        context->give_up_frame("out of memory");
    }
    context->stop_listening();
    if (context->recording && done->executes) note_popped(*context);
}

void APIENTRY DeleteLists(GLuint list, GLsizei range) {
    this_thread.real->DeleteLists(list, range);
    Context* context = this_thread.context;
    if (!context || context->in_begin || range <= 0) return;
    // A program may delete far more names than it ever used: walk through whichever is shorter.
    std::vector<GLuint> gone;
    {
        const std::lock_guard lock(context->group->mutex);
        const auto& lists = context->group->lists;
        if (std::size_t(range) <= lists.size()) {
            for (GLsizei i = 0; i < range; ++i)
                if (lists.contains(list + GLuint(i))) gone.push_back(list + GLuint(i));
        } else {
            for (const auto& [name, contents] : lists)
                if (name - list < GLuint(range)) gone.push_back(name);
        }
    }
    for (const GLuint name : gone) change_list(*context, name, nullptr);
}

void APIENTRY CallList(GLuint list) {
    if (Context* context = listening_context()) {
        note_list_changes(*context);
        context->note_list_call();
        context->emit(true, [&](Stream& stream) { packets::CallList::write(stream, list); });
        follow_list(*context, list);
    }
    this_thread.real->CallList(list);
    if (Context* context = listening_context()) note_popped(*context);
}

void APIENTRY CallLists(GLsizei n, GLenum type, const void* lists) {
    if (Context* context = listening_context(); context && n > 0 && lists) {
        note_list_changes(*context);
        context->note_list_call();
        try {
            std::vector<GLuint> numbers(static_cast<std::size_t>(n));
            bool known = true;
            for (GLsizei i = 0; i < n && known; ++i)
                known = list_number(type, lists, i, numbers[std::size_t(i)]);
            if (known) {
                context->emit(true, [&](Stream& stream) { write_numbers(stream, numbers); });
                const GLuint base = context->can_query() ? GLuint(get_int(context->real, GL_LIST_BASE)) : 0;
                for (const GLuint number : numbers) follow_list(*context, base + number);
            }
        } catch (const std::exception&) {
            context->give_up_frame("out of memory");
        }
    }
    this_thread.real->CallLists(n, type, lists);
    if (Context* context = listening_context()) note_popped(*context);
}

void play_CallList(Player& player, const Packet& packet) { player.call_list(Reader(packet).get<GLuint>()); }

void play_CallLists(Player& player, const Packet& packet) {
    Reader reader(packet);
    const auto count = reader.get<std::uint32_t>();
    // The base is read once: a list in the row that changes it changes the next glCallLists (Mesa does so
    // too).
    const GLuint base = player.state.list_base;
    for (std::uint32_t i = 0; i < count; ++i) player.call_list(base + reader.get<GLuint>());
}

void play_ListBase(Player& player, const Packet& packet) {
    player.state.list_base = Reader(packet).get<GLuint>();
    packets::ListBase::play(player, packet);
}

void play_define_list(Player& player, const Packet& packet) {
    Reader reader(packet);
    const auto name = reader.get<GLuint>();
    player.set_list(name, player.frame.redefinitions[reader.get<std::uint32_t>()].get());
}

void play_delete_list(Player& player, const Packet& packet) {
    player.set_list(Reader(packet).get<GLuint>(), nullptr);
}

} // namespace glcast::record::custom
