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
    FragmentState& fragments = program().fragments;
    switch (cap) {
    case GL_LIGHTING:
        fragments.lighting = on, state().apply_lighting(), state().apply_order();
        break;
    case GL_COLOR_MATERIAL:
        program().colour_material = on, state().apply_colour_material();
        break;
    case GL_ALPHA_TEST:
        program().alpha_test = on, state().apply_alpha();
        break;
    case GL_BLEND:
        fragments.blend = on, state().apply_fragments();
        break;
    case GL_COLOR_LOGIC_OP:
        fragments.logic_op = on, state().apply_fragments();
        break;
    case GL_DEPTH_TEST:
        fragments.depth_test = on, state().apply_order();
        break;
    case GL_POLYGON_OFFSET_FILL:
        program().offset.enabled = on, state().apply_fragments();
        break;
    case GL_STENCIL_TEST:
        fragments.stencil_test = on, state().apply_order();
        break;
    }
}

/// True when the call is to be made as it is.
bool kept_cap(GLenum cap, bool on) {
    note_cap(cap, on);
    if (cap == GL_CULL_FACE && state().culls()) return true;
    return cap_policy(cap, self().kind) == CapPolicy::keep;
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
    blend_func_separate(source, destination, source, destination);
}
void APIENTRY blend_func_separate(GLenum source, GLenum destination, GLenum source_alpha,
                                  GLenum destination_alpha) {
    FragmentState& fragments = program().fragments;
    fragments.source = source, fragments.destination = destination;
    fragments.source_alpha = source_alpha, fragments.destination_alpha = destination_alpha;
    state().apply_fragments();
}
void APIENTRY blend_func_indexed(GLuint buffer, GLenum source, GLenum destination) {
    if (buffer == 0) blend_func(source, destination);
}
void APIENTRY blend_colour(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha) {
    real().BlendColor(red, green, blue, alpha);
    float* constant = program().fragments.constant;
    constant[0] = red, constant[1] = green, constant[2] = blue, constant[3] = alpha;
    state().apply_alpha();
}
void APIENTRY logic_op(GLenum operation) {
    program().fragments.logic_operation = operation;
    state().apply_alpha();
}
void APIENTRY blend_equation(GLenum equation) { blend_equation_separate(equation, equation); }
void APIENTRY blend_equation_separate(GLenum equation, GLenum equation_alpha) {
    program().fragments.equation = equation;
    program().fragments.equation_alpha = equation_alpha;
    state().apply_fragments();
}
void APIENTRY depth_func(GLenum function) {
    program().fragments.depth_function = function;
    state().apply_order();
    state().apply_offset();
}
void APIENTRY depth_mask(GLboolean on) {
    program().fragments.depth_mask = on;
    state().apply_order();
}
void APIENTRY polygon_offset(GLfloat factor, GLfloat units) {
    program().offset.factor = factor, program().offset.units = units;
    state().apply_fragments();
}
/// Its bias is depth, 0..1.
void APIENTRY polygon_offset_ext(GLfloat factor, GLfloat bias) {
    polygon_offset(factor, bias * units_of_depth);
}
void APIENTRY polygon_offset_clamp(GLfloat factor, GLfloat units, GLfloat) { polygon_offset(factor, units); }
void APIENTRY depth_range(GLdouble near, GLdouble far) {
    program().offset.near = near, program().offset.far = far;
    state().apply_fragments();
}
void APIENTRY depth_range_f(GLfloat near, GLfloat far) { depth_range(near, far); }
void APIENTRY stencil_func(GLenum function, GLint, GLuint) {
    program().fragments.stencil_function = function;
    state().apply_order();
}
void APIENTRY stencil_func_separate(GLenum face, GLenum function, GLint reference, GLuint mask) {
    if (face != GL_BACK) stencil_func(function, reference, mask);
}
void APIENTRY clear(GLbitfield buffers) { state().cleared(buffers); }
void APIENTRY clear_color(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha) {
    float* clear = program().fragments.clear;
    clear[0] = red, clear[1] = green, clear[2] = blue, clear[3] = alpha;
    state().apply_alpha();
}
void APIENTRY colour_mask(GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha) {
    program().colour_mask = {red, green, blue, alpha};
    state().apply_fragments();
}
void APIENTRY draw_buffer(GLenum buffer) {
    program().buffer_shows = buffer != GL_NONE;
    state().apply_fragments();
}
void APIENTRY draw_buffers(GLsizei count, const GLenum* buffers) {
    bool shows = false;
    for (GLsizei i = 0; i < count; ++i) shows |= buffers[i] != GL_NONE;
    program().buffer_shows = shows;
    state().apply_fragments();
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
