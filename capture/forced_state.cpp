#include "capture/forced_state.h"

namespace glcast {

GLenum mapped_material(GLenum name) {
    switch (name) {
    case GL_DIFFUSE:
    case GL_AMBIENT_AND_DIFFUSE:
        return GL_AMBIENT_AND_DIFFUSE;
    case GL_EMISSION:
        return GL_EMISSION;
    default:
        return GL_NONE;
    }
}

namespace {

void set_cap(const GlTable& gl, GLenum cap, bool on) { on ? gl.Enable(cap) : gl.Disable(cap); }

/// Tracked values that PopAttrib brings back, by the bits of the mask.
void restore(ForcedState::Values& now, const ForcedState::Values& old, GLbitfield mask) {
    if (mask & (GL_ENABLE_BIT | GL_LIGHTING_BIT)) {
        now.lighting = old.lighting;
        now.colour_material = old.colour_material;
    }
    if (mask & (GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT)) {
        now.blend = old.blend;
        now.alpha_test = old.alpha_test;
    }
    if (mask & GL_LIGHTING_BIT) {
        now.colour_material_face = old.colour_material_face;
        now.colour_material_mode = old.colour_material_mode;
    }
    if (mask & GL_COLOR_BUFFER_BIT) {
        now.alpha_function = old.alpha_function;
        now.alpha_reference = old.alpha_reference;
        now.blend_source = old.blend_source;
        now.blend_destination = old.blend_destination;
        now.mask_shows = old.mask_shows;
        now.buffer_shows = old.buffer_shows;
    }
    if (mask & GL_TRANSFORM_BIT) now.matrix_mode = old.matrix_mode;
}

} // namespace

ForcedState::ForcedState(const GlTable& real, PassKind kind) : real(real), kind(kind) {
    GLint limit = 0;
    real.GetIntegerv(GL_MAX_ATTRIB_STACK_DEPTH, &limit);
    if (limit > 0) stack_limit = static_cast<std::size_t>(limit);
    stack.reserve(stack_limit);
}

void ForcedState::push(GLbitfield mask) {
    if (stack.size() < stack_limit) stack.push_back({mask, program}); // else GL refuses it too
}

void ForcedState::pop() {
    if (stack.empty()) return;
    restore(program, stack.back().values, stack.back().mask);
    stack.pop_back();
    apply();
}

void ForcedState::apply_alpha() const {
    const bool shown = program.mask_shows && program.buffer_shows && !program.own_program;
    const bool replaces = program.blend_source == GL_ONE && program.blend_destination == GL_ZERO;
    // The normal pass has equal depth to go by; what a peel pass finds is tested by the colour pass after it.
    const bool keeps_test = kind == PassKind::colour;
    if (!shown) {
        real.AlphaFunc(GL_NEVER, 0);
        real.Enable(GL_ALPHA_TEST);
    } else if (keeps_test && program.alpha_test) {
        real.AlphaFunc(program.alpha_function, program.alpha_reference);
        real.Enable(GL_ALPHA_TEST);
    } else if (keeps_test && program.blend && !replaces) {
        real.AlphaFunc(GL_GEQUAL, 0.5f);
        real.Enable(GL_ALPHA_TEST);
    } else {
        real.Disable(GL_ALPHA_TEST);
    }
}

void ForcedState::apply_colour_material() const {
    if (kind != PassKind::colour) return;
    const GLenum mode = mapped_material(program.colour_material_mode);
    const bool on = program.colour_material && mode != GL_NONE;
    if (on) real.ColorMaterial(program.colour_material_face, mode);
    set_cap(real, GL_COLOR_MATERIAL, on);
}

void ForcedState::apply_lighting() const {
    if (kind != PassKind::normal) return;
    static constexpr GLfloat lit[] = {1, 1, 1, lit_alpha}, unlit[] = {0, 0, 0, unlit_alpha};
    real.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, program.lighting ? lit : unlit);
}

void ForcedState::apply() const {
    apply_alpha();
    apply_colour_material();
    apply_lighting();
}

} // namespace glcast
