#include "capture/coincident.h"

namespace glcast {

namespace {

/// Fragments at the depth that is there pass.
bool passes_equal_depth(const FragmentState& state) {
    if (!state.depth_test) return true;
    switch (state.depth_function) {
    case GL_LEQUAL:
    case GL_GEQUAL:
    case GL_EQUAL:
    case GL_ALWAYS:
        return true;
    default:
        return false;
    }
}

bool depends_on_stencil(const FragmentState& state) {
    return state.stencil_test && state.stencil_function != GL_ALWAYS && !state.stencil_known;
}

bool adds(const FragmentState& state) { return state.destination == GL_ONE && state.equation == GL_FUNC_ADD; }

} // namespace

bool FragmentState::blends() const {
    const bool replaces = source == GL_ONE && destination == GL_ZERO && equation == GL_FUNC_ADD;
    return blend && !logic_op && !replaces;
}

bool FragmentState::only_tints() const {
    if (!blends()) return false;
    if (equation == GL_FUNC_REVERSE_SUBTRACT) return true;
    if (source != GL_ZERO && source != GL_DST_COLOR) return false;
    return equation == GL_FUNC_ADD && !(source == GL_ZERO && destination == GL_ZERO);
}

bool FragmentState::interpolates() const {
    if (equation == GL_MIN || equation == GL_MAX) return true;
    const auto complement = [](GLenum factor) {
        switch (factor) {
        case GL_SRC_ALPHA:
            return GL_ONE_MINUS_SRC_ALPHA;
        case GL_ONE_MINUS_SRC_ALPHA:
            return GL_SRC_ALPHA;
        case GL_DST_ALPHA:
            return GL_ONE_MINUS_DST_ALPHA;
        case GL_ONE_MINUS_DST_ALPHA:
            return GL_DST_ALPHA;
        case GL_CONSTANT_ALPHA:
            return GL_ONE_MINUS_CONSTANT_ALPHA;
        case GL_ONE_MINUS_CONSTANT_ALPHA:
            return GL_CONSTANT_ALPHA;
        default:
            return GL_NONE;
        }
    };
    return equation == GL_FUNC_ADD && static_cast<GLenum>(complement(source)) == destination;
}

Coincidence coincidence(const FragmentState& state) {
    const bool yields = !passes_equal_depth(state);
    const bool everywhere = !depends_on_stencil(state);
    if (!state.blends()) return {yields || !everywhere, Mixing::replace};
    if (state.lighting && adds(state)) return {yields, Mixing::brighten};
    return {yields || !(everywhere || adds(state)), Mixing::blend};
}

void set_mixing(const GlTable& gl, const FragmentState& state, Mixing mixing) {
    if (mixing == Mixing::replace) return gl.Disable(GL_BLEND);
    const bool own = mixing == Mixing::blend;
    if (gl.BlendEquationSeparate)
        gl.BlendEquationSeparate(own ? state.equation : GLenum(GL_MAX),
                                 own ? state.equation_alpha : GLenum(GL_MAX));
    else if (gl.BlendEquation)
        gl.BlendEquation(own ? state.equation : GLenum(GL_MAX));
    if (own && gl.BlendFuncSeparate)
        gl.BlendFuncSeparate(state.source, state.destination, state.source_alpha, state.destination_alpha);
    else
        gl.BlendFunc(own ? state.source : GLenum(GL_ONE), own ? state.destination : GLenum(GL_ONE));
    gl.Enable(GL_BLEND);
}

void set_first_colour(const GlTable& gl, const FragmentState& state) {
    const bool own = !state.blends() || state.interpolates() || coincidence(state).mixing == Mixing::brighten;
    if (own) return gl.Disable(GL_BLEND);
    if (gl.BlendEquation) gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ZERO, GL_ZERO);
    gl.Enable(GL_BLEND);
}

} // namespace glcast
