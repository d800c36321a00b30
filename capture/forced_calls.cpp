#include "capture/forced_calls.h"

#include "capture/forced_caps.h"
#include "capture/forced_table.h"

namespace glcast::forced {

namespace {

ForcedTable& self() { return ForcedTable::current(); }
const GlTable& real() { return self().real; }
ForcedState& state() { return self().state; }
ForcedState::Values& program() { return self().state.program; }

void note_cap(GLenum cap, bool on) {
    switch (cap) {
    case GL_LIGHTING:
        program().lighting = on, state().apply_lighting();
        break;
    case GL_COLOR_MATERIAL:
        program().colour_material = on, state().apply_colour_material();
        break;
    case GL_ALPHA_TEST:
        program().alpha_test = on, state().apply_alpha();
        break;
    case GL_BLEND:
        program().blend = on, state().apply_alpha();
        break;
    }
}

/// True when the call is to be made as it is.
bool kept_cap(GLenum cap, bool on) {
    const CapPolicy policy = cap_policy(cap, self().kind);
    if (policy == CapPolicy::track) note_cap(cap, on);
    return policy == CapPolicy::keep;
}

bool kept_light_model(GLenum name) { return name == GL_LIGHT_MODEL_TWO_SIDE; }

} // namespace

void APIENTRY enable(GLenum cap) {
    if (kept_cap(cap, true)) real().Enable(cap);
}
void APIENTRY disable(GLenum cap) {
    if (kept_cap(cap, false)) real().Disable(cap);
}
void APIENTRY enable_indexed(GLenum cap, GLuint index) {
    if (kept_cap(cap, true)) real().Enablei(cap, index);
}
void APIENTRY disable_indexed(GLenum cap, GLuint index) {
    if (kept_cap(cap, false)) real().Disablei(cap, index);
}

void APIENTRY push_attrib(GLbitfield mask) {
    state().push(mask);
    real().PushAttrib(mask);
}
void APIENTRY pop_attrib() {
    real().PopAttrib();
    state().pop();
}
void APIENTRY matrix_mode(GLenum mode) {
    program().matrix_mode = mode;
    real().MatrixMode(mode);
}

void APIENTRY material_f(GLenum face, GLenum name, GLfloat value) {
    if (const GLenum mapped = mapped_material(name)) real().Materialf(face, mapped, value);
}
void APIENTRY material_fv(GLenum face, GLenum name, const GLfloat* values) {
    if (const GLenum mapped = mapped_material(name)) real().Materialfv(face, mapped, values);
}
void APIENTRY material_i(GLenum face, GLenum name, GLint value) {
    if (const GLenum mapped = mapped_material(name)) real().Materiali(face, mapped, value);
}
void APIENTRY material_iv(GLenum face, GLenum name, const GLint* values) {
    if (const GLenum mapped = mapped_material(name)) real().Materialiv(face, mapped, values);
}
void APIENTRY colour_material(GLenum face, GLenum mode) {
    program().colour_material_face = face;
    program().colour_material_mode = mode;
    state().apply_colour_material();
}
void APIENTRY light_model_f(GLenum name, GLfloat value) {
    if (kept_light_model(name)) real().LightModelf(name, value);
}
void APIENTRY light_model_fv(GLenum name, const GLfloat* values) {
    if (kept_light_model(name)) real().LightModelfv(name, values);
}
void APIENTRY light_model_i(GLenum name, GLint value) {
    if (kept_light_model(name)) real().LightModeli(name, value);
}
void APIENTRY light_model_iv(GLenum name, const GLint* values) {
    if (kept_light_model(name)) real().LightModeliv(name, values);
}

void APIENTRY front_face(GLenum mode) { real().FrontFace(self().mirrored ? mirrored_winding(mode) : mode); }

void APIENTRY alpha_func(GLenum function, GLclampf reference) {
    program().alpha_function = function;
    program().alpha_reference = reference;
    state().apply_alpha();
}
void APIENTRY blend_func(GLenum source, GLenum destination) {
    program().blend_source = source;
    program().blend_destination = destination;
    state().apply_alpha();
}
void APIENTRY blend_func_separate(GLenum source, GLenum destination, GLenum, GLenum) {
    blend_func(source, destination);
}
void APIENTRY colour_mask(GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha) {
    program().mask_shows = red || green || blue || alpha;
    state().apply_alpha();
}
void APIENTRY draw_buffer(GLenum buffer) {
    program().buffer_shows = buffer != GL_NONE;
    state().apply_alpha();
}
void APIENTRY draw_buffers(GLsizei count, const GLenum* buffers) {
    bool shows = false;
    for (GLsizei i = 0; i < count; ++i) shows |= buffers[i] != GL_NONE;
    program().buffer_shows = shows;
    state().apply_alpha();
}

/// Peel passes: our own stays in use, and what another would draw is not drawn.
void APIENTRY use_program(GLuint program_name) {
    program().own_program = program_name != 0;
    state().saw_own_program |= program_name != 0;
    state().apply_alpha();
}
void APIENTRY use_program_object(GLhandleARB program_name) { use_program(program_name != 0); }

/// Peel passes: our shader reads a rectangle texture.
void APIENTRY bind_texture(GLenum target, GLuint texture) {
    if (target != GL_TEXTURE_RECTANGLE) real().BindTexture(target, texture);
}

/// Selection and feedback draw nothing. GL writes the hits to a buffer of ours: the program has had its own
/// already.
GLint APIENTRY render_mode(GLenum mode) {
    static thread_local GLuint hits[64];
    if (mode == GL_RENDER) return real().RenderMode(GL_RENDER);
    real().SelectBuffer(static_cast<GLsizei>(std::size(hits)), hits);
    return real().RenderMode(GL_SELECT);
}

} // namespace glcast::forced
