#include "shim/record/state.h"

#include "shim/record/arrays.h"
#include "shim/record/packets.h"
#include "shim/record/snapshot.h"

namespace glcast::record {

void note_popped_matrix(Context& context) {
    if (!context.recording || !context.can_query() || !context.executes()) return;
    Recording& recording = *context.recording;
    if (!recording.has_unread_matrices) return;
    const GlTable& gl = context.real;
    const auto mode = GLenum(get_int(gl, GL_MATRIX_MODE));
    const int unit =
        mode == GL_TEXTURE && context.get_limits().has(13) ? get_int(gl, GL_ACTIVE_TEXTURE) - GL_TEXTURE0 : 0;
    const int stack = stack_number(mode, std::min(unit, max_texture_units - 1));
    if (stack < 0 || recording.lowest[stack] < 2) return;
    const StackNames names = stack_names(stack);
    const int depth = get_int(gl, names.depth, 1);
    if (depth >= recording.lowest[stack] || depth < 1) return;
    recording.lowest[stack] = depth;
    gl.GetFloatv(names.matrix, recording.frame->stacks[stack][std::size_t(depth) - 1].m);
}

bool note_popped_attributes(Context& context) {
    // While a list is open the state cannot be read: binding textures for it would go into the list.
    if (!context.recording || context.compilation || context.in_begin) return false;
    Recording& recording = *context.recording;
    if (recording.attrib_depth == 0) return false;
    const int depth = get_int(context.real, GL_ATTRIB_STACK_DEPTH);
    if (depth >= recording.attrib_depth) return false;
    recording.attrib_depth = depth;
    context.emit(false, [&](Stream& stream) { write_state(context, stream, false); });
    return true;
}

namespace {

/// Capabilities that are client state, or are dealt with where arrays are read.
bool is_client_capability(GLenum capability) {
    return (capability >= GL_VERTEX_ARRAY && capability <= GL_EDGE_FLAG_ARRAY) ||
           capability == GL_FOG_COORD_ARRAY || capability == GL_SECONDARY_COLOR_ARRAY ||
           capability == GL_PRIMITIVE_RESTART || capability == GL_PRIMITIVE_RESTART_FIXED_INDEX ||
           capability == GL_PRIMITIVE_RESTART_NV;
}

/// The reason not to play draws that a capability is, if it is one.
unsigned program_capability(GLenum capability) {
    if (capability == GL_VERTEX_PROGRAM_ARB) return Player::vertex_program;
    if (capability == GL_FRAGMENT_PROGRAM_ARB || capability == GL_FRAGMENT_PROGRAM_NV ||
        capability == GL_FRAGMENT_SHADER_ATI || capability == GL_REGISTER_COMBINERS_NV)
        return Player::fragment_program;
    return 0;
}

void set_begin(Context& context, bool inside) {
    if (context.compilation)
        context.compilation->stream->begin_state =
            inside ? Stream::BeginState::inside : Stream::BeginState::outside;
    if (context.executes()) context.in_begin = inside;
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY Begin(GLenum mode) {
    Context* context = listening_context();
    if (context && mode <= GL_TRIANGLE_STRIP_ADJACENCY && !context->in_begin) {
        if (context->can_query())
            prepare_arrays(*context); // glArrayElement comes where nothing can be queried
        count_if_not_played(*context);
        context->note_draw();
        context->emit(true, [&](Stream& stream) { packets::Begin::write(stream, mode); });
        set_begin(*context, true);
    }
    this_thread.real->Begin(mode);
}

void APIENTRY End() {
    if (Context* context = listening_context()) {
        context->emit(true, [&](Stream& stream) { packets::End::write(stream); });
        set_begin(*context, false);
    }
    this_thread.real->End();
}

void APIENTRY Rectdv(const GLdouble* a, const GLdouble* b) {
    if (Context* context = listening_context()) {
        context->note_draw();
        context->emit(true, [&](Stream& stream) { packets::Rectd::write(stream, a[0], a[1], b[0], b[1]); });
    }
    this_thread.real->Rectdv(a, b);
}
void APIENTRY Rectfv(const GLfloat* a, const GLfloat* b) {
    if (Context* context = listening_context()) {
        context->note_draw();
        context->emit(true, [&](Stream& stream) { packets::Rectf::write(stream, a[0], a[1], b[0], b[1]); });
    }
    this_thread.real->Rectfv(a, b);
}
void APIENTRY Rectiv(const GLint* a, const GLint* b) {
    if (Context* context = listening_context()) {
        context->note_draw();
        context->emit(true, [&](Stream& stream) { packets::Recti::write(stream, a[0], a[1], b[0], b[1]); });
    }
    this_thread.real->Rectiv(a, b);
}
void APIENTRY Rectsv(const GLshort* a, const GLshort* b) {
    if (Context* context = listening_context()) {
        context->note_draw();
        context->emit(true, [&](Stream& stream) { packets::Rects::write(stream, a[0], a[1], b[0], b[1]); });
    }
    this_thread.real->Rectsv(a, b);
}

void APIENTRY Enable(GLenum capability) {
    if (Context* context = listening_context()) {
        if (is_client_capability(capability))
            context->arrays_dirty = true;
        else
            context->emit(true, [&](Stream& stream) { packets::Enable::write(stream, capability); });
    }
    this_thread.real->Enable(capability);
}

void APIENTRY Disable(GLenum capability) {
    if (Context* context = listening_context()) {
        if (is_client_capability(capability))
            context->arrays_dirty = true;
        else
            context->emit(true, [&](Stream& stream) { packets::Disable::write(stream, capability); });
    }
    this_thread.real->Disable(capability);
}

void play_Enable(Player& player, const Packet& packet) {
    const unsigned program = program_capability(Reader(packet).get<GLenum>());
    if (program)
        player.set_skip(Player::Skip(program), true);
    else
        packets::Enable::play(player, packet);
}

void play_Disable(Player& player, const Packet& packet) {
    const unsigned program = program_capability(Reader(packet).get<GLenum>());
    if (program)
        player.set_skip(Player::Skip(program), false);
    else
        packets::Disable::play(player, packet);
}

void APIENTRY PopMatrix() {
    Context* context = listening_context();
    if (context) context->emit(true, [&](Stream& stream) { packets::PopMatrix::write(stream); });
    this_thread.real->PopMatrix();
    if (context) note_popped_matrix(*context);
}

void APIENTRY PopAttrib() {
    Context* context = listening_context();
    this_thread.real->PopAttrib();
    if (context && !note_popped_attributes(*context))
        context->emit(true, [&](Stream& stream) { packets::PopAttrib::write(stream); });
}

void play_PushAttrib(Player& player, const Packet& packet) {
    player.push_attrib(Reader(packet).get<GLbitfield>());
    packets::PushAttrib::play(player, packet);
}

void play_PopAttrib(Player& player, const Packet& packet) {
    player.pop_attrib();
    packets::PopAttrib::play(player, packet);
    player.textures.refresh(); // it may have brought back one that has changed since
    player.defaults.attributes_were_popped();
}

GLint APIENTRY RenderMode(GLenum mode) {
    if (Context* context = listening_context())
        context->emit(false, [&](Stream& stream) { packets::RenderMode::write(stream, mode); });
    return this_thread.real->RenderMode(mode);
}

void play_RenderMode(Player& player, const Packet& packet) {
    player.set_skip(Player::selecting, Reader(packet).get<GLenum>() != GL_RENDER);
}

void APIENTRY UseProgram(GLuint program) {
    if (Context* context = listening_context()) {
        if (context->compilation && program != 0) context->compilation->stream->sets_program = true;
        context->emit(true, [&](Stream& stream) { packets::UseProgram::write(stream, program); });
    }
    this_thread.real->UseProgram(program);
}

void play_UseProgram(Player& player, const Packet& packet) {
    player.set_skip(Player::glsl, Reader(packet).get<GLuint>() != 0);
}

void APIENTRY BindProgramPipeline(GLuint pipeline) {
    if (Context* context = listening_context())
        context->emit(false, [&](Stream& stream) { packets::BindProgramPipeline::write(stream, pipeline); });
    this_thread.real->BindProgramPipeline(pipeline);
}

void play_BindProgramPipeline(Player& player, const Packet& packet) {
    player.set_skip(Player::pipeline, Reader(packet).get<GLuint>() != 0);
}

} // namespace glcast::record::custom
