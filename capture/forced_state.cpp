#include "capture/forced_state.h"

#include <algorithm>
#include <iterator>

#include "capture/solidity.h"

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

constexpr int unknown_shift = -1000;

GLenum nearer_or_equal(const PassFacts& pass) { return pass.viewer_at_plus ? GL_GEQUAL : GL_LEQUAL; }

void set_cap(const GlTable& gl, GLenum cap, bool on) { on ? gl.Enable(cap) : gl.Disable(cap); }

void restore_colour_buffer(ForcedState::Values& now, const ForcedState::Values& old) {
    now.alpha_function = old.alpha_function;
    now.alpha_reference = old.alpha_reference;
    now.fragments.source = old.fragments.source;
    now.fragments.destination = old.fragments.destination;
    now.fragments.source_alpha = old.fragments.source_alpha;
    now.fragments.destination_alpha = old.fragments.destination_alpha;
    now.fragments.equation = old.fragments.equation;
    now.fragments.equation_alpha = old.fragments.equation_alpha;
    now.colour_mask = old.colour_mask;
    now.buffer_shows = old.buffer_shows;
    now.fragments.logic_operation = old.fragments.logic_operation;
    std::copy(std::begin(old.fragments.constant), std::end(old.fragments.constant), now.fragments.constant);
    std::copy(std::begin(old.fragments.clear), std::end(old.fragments.clear), now.fragments.clear);
}

/// Tracked values that PopAttrib brings back, by the bits of the mask.
void restore(ForcedState::Values& now, const ForcedState::Values& old, GLbitfield mask) {
    FragmentState& fragments = now.fragments;
    const FragmentState& old_fragments = old.fragments;
    if (mask & (GL_ENABLE_BIT | GL_LIGHTING_BIT)) {
        fragments.lighting = old_fragments.lighting;
        now.colour_material = old.colour_material;
    }
    if (mask & (GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT)) {
        fragments.blend = old_fragments.blend;
        fragments.logic_op = old_fragments.logic_op;
        now.alpha_test = old.alpha_test;
    }
    if (mask & (GL_ENABLE_BIT | GL_DEPTH_BUFFER_BIT)) fragments.depth_test = old_fragments.depth_test;
    if (mask & (GL_ENABLE_BIT | GL_STENCIL_BUFFER_BIT)) fragments.stencil_test = old_fragments.stencil_test;
    if (mask & GL_LIGHTING_BIT) {
        now.colour_material_face = old.colour_material_face;
        now.colour_material_mode = old.colour_material_mode;
    }
    if (mask & GL_DEPTH_BUFFER_BIT) {
        fragments.depth_function = old_fragments.depth_function;
        fragments.depth_mask = old_fragments.depth_mask;
    }
    if (mask & (GL_ENABLE_BIT | GL_POLYGON_BIT)) now.offset.enabled = old.offset.enabled;
    if (mask & GL_POLYGON_BIT) now.offset.factor = old.offset.factor, now.offset.units = old.offset.units;
    if (mask & GL_VIEWPORT_BIT) now.offset.near = old.offset.near, now.offset.far = old.offset.far;
    if (mask & GL_STENCIL_BUFFER_BIT) fragments.stencil_function = old_fragments.stencil_function;
    if (mask & GL_COLOR_BUFFER_BIT) restore_colour_buffer(now, old);
    if (mask & GL_TRANSFORM_BIT) now.matrix_mode = old.matrix_mode;
}

} // namespace

ForcedState::ForcedState(const GlTable& real, const PassFacts& pass)
    : real(real), pass(pass), kind(pass.kind), depth(pass.depth) {
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
    shifted = unknown_shift;
    apply();
}

/// Any colour at all; alpha alone is seen by nobody, but by what blends with it.
bool ForcedState::shows() const {
    const auto& mask = program.colour_mask;
    const bool colour = mask.red || mask.green || mask.blue || (kind == PassKind::blend && mask.alpha);
    return colour && program.buffer_shows && !program.own_program;
}

namespace {

/// Of the program's alpha test and that of its blending the stricter, where one test can tell; else the
/// program's.
void set_alpha_test(const GlTable& gl, const ForcedState::Values& program, Solidity solid) {
    const bool high = solid == Solidity::by_high_alpha, low = solid == Solidity::by_low_alpha;
    GLenum function = high ? GL_GEQUAL : GL_LEQUAL;
    GLclampf reference = 0.5f;
    const GLenum own = program.alpha_function;
    const bool own_is_high = own == GL_GREATER || own == GL_GEQUAL,
               own_is_low = own == GL_LESS || own == GL_LEQUAL;
    const bool own_is_stricter = (high && own_is_high && program.alpha_reference >= reference) ||
                                 (low && own_is_low && program.alpha_reference <= reference);
    const bool is_other = !(high && own_is_high) && !(low && own_is_low);
    if (program.alpha_test && own != GL_ALWAYS && (is_other || own_is_stricter))
        function = own, reference = program.alpha_reference;
    gl.AlphaFunc(function, reference);
    gl.Enable(GL_ALPHA_TEST);
}

} // namespace

void ForcedState::apply_alpha() const {
    // The normal pass has equal depth to go by; what a peel pass finds is tested by the colour pass after it.
    const bool finds_depth = kind == PassKind::colour || kind == PassKind::peel;
    const Solidity solid = finds_depth ? solidity(program.fragments) : Solidity::always;
    const bool by_alpha = solid == Solidity::by_high_alpha || solid == Solidity::by_low_alpha;
    if (kind != PassKind::stencil && (!shows() || solid == Solidity::never)) {
        real.AlphaFunc(GL_NEVER, 0);
        real.Enable(GL_ALPHA_TEST);
    } else if (kind == PassKind::colour && by_alpha) {
        set_alpha_test(real, program, solid);
    } else if (kind != PassKind::normal && kind != PassKind::peel && program.alpha_test) {
        real.AlphaFunc(program.alpha_function, program.alpha_reference);
        real.Enable(GL_ALPHA_TEST);
    } else {
        real.Disable(GL_ALPHA_TEST);
    }
}

/// Colours where the depth is still to be found: what replaces may come over its equals, what blends is mixed
/// in later.
void ForcedState::order_by_depth() const {
    const bool over = !program.fragments.blends() && !coincidence(program.fragments).yields;
    real.DepthFunc(!over ? depth : depth == GL_GREATER ? GL_GEQUAL : GL_LEQUAL);
}

/// The same where it is known: the stencil buffer counts what was drawn there, as far as it is in the way of
/// what comes after it.
void ForcedState::order_by_stencil() const {
    if (kind == PassKind::blend) real.DepthFunc(mixes_over_others() ? nearer_or_equal(pass) : depth);
    if (mixes_over_others()) {
        return apply_stencil({.tests = true});
    }
    const Coincidence rule = coincidence(program.fragments);
    const bool writes_depth = program.fragments.depth_test && program.fragments.depth_mask;
    bool over = !rule.yields, counts = true;
    if (kind == PassKind::colour)
        over = over && !program.fragments.blends();
    else if (kind == PassKind::blend)
        counts = writes_depth;
    else // a normal: of the first that has one
        over = false, counts = program.fragments.lighting;
    apply_stencil(
        {.tests = true, .uncounted_only = !over, .shown = counts ? GLenum(GL_INCR) : GLenum(GL_KEEP)});
}

void ForcedState::apply_order() {
    if (kind == PassKind::peel || kind == PassKind::stencil) return;
    saw_blending |= program.fragments.blends() && shows();
    if (depth == GL_EQUAL)
        order_by_stencil();
    else if (kind == PassKind::colour)
        order_by_depth();
    if (kind == PassKind::colour) set_first_colour(real, program.fragments);
    if (kind != PassKind::blend) return;
    set_mixing(real, program.fragments, coincidence(program.fragments).mixing);
    const auto& mask = program.colour_mask;
    real.ColorMask(mask.red, mask.green, mask.blue, mask.alpha);
}

void ForcedState::keep_to_mask(bool on, bool has_mask) {
    program.fragments.stencil_known = on;
    masked = on && has_mask;
    if (depth != GL_EQUAL) apply_stencil(pass.stencil);
    apply_order();
}

double ForcedState::level() const {
    const GLenum function = program.fragments.depth_function;
    return OffsetLevels::level_of(program.offset, function == GL_GREATER || function == GL_GEQUAL);
}

void ForcedState::note_faces() {
    if (pass.learnt && shows()) pass.learnt->note(level());
}

/// A decal that blends, over whatever is below it. Where a stencil test keeps it is not known.
bool ForcedState::mixes_over_others() const {
    if (kind != PassKind::blend || steps_nearer() <= 0) return false;
    FragmentState passing = program.fragments;
    passing.depth_function = GL_LEQUAL;
    return passing.blends() && !coincidence(passing).yields;
}

int ForcedState::steps_nearer() const {
    const int steps = pass.levels ? pass.levels->steps(level()) : 0;
    if (steps == 0 || !program.fragments.blends()) return steps;
    if (!pass.outermost) return 0;
    return kind == PassKind::blend ? steps : -1;
}

void ForcedState::apply_offset() {
    const int steps = steps_nearer();
    if (!pass.levels || steps == shifted) return;
    shifted = steps;
    pass.shift.apply(real, steps, program.matrix_mode);
}

void ForcedState::apply_fragments() {
    apply_alpha();
    apply_order();
    apply_offset();
}

void ForcedState::cleared(GLbitfield buffers) {
    if ((buffers & GL_DEPTH_BUFFER_BIT) && program.fragments.depth_mask) {
        ++depth_clears;
        if (kind == PassKind::blend) real.Clear(GL_STENCIL_BUFFER_BIT);
    }
    const auto& mask = program.colour_mask;
    const bool alpha_alone = mask.alpha && !mask.red && !mask.green && !mask.blue;
    if (kind != PassKind::blend || !(buffers & GL_COLOR_BUFFER_BIT) || !alpha_alone) return;
    real.ClearColor(0, 0, 0, program.fragments.clear[3]);
    real.Clear(GL_COLOR_BUFFER_BIT);
}

void ForcedState::apply_colour_material() const {
    if (kind != PassKind::colour && kind != PassKind::blend) return;
    const GLenum mode = mapped_material(program.colour_material_mode);
    const bool on = program.colour_material && mode != GL_NONE;
    if (on) real.ColorMaterial(program.colour_material_face, mode);
    set_cap(real, GL_COLOR_MATERIAL, on);
}

void ForcedState::apply_lighting() const {
    if (kind != PassKind::normal) return;
    static constexpr GLfloat lit[] = {1, 1, 1, lit_alpha}, unlit[] = {0, 0, 0, unlit_alpha};
    real.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, program.fragments.lighting ? lit : unlit);
}

void ForcedState::apply() {
    apply_fragments();
    apply_colour_material();
    apply_lighting();
}

} // namespace glcast
