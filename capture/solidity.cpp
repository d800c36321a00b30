#include "capture/solidity.h"

namespace glcast {
namespace {

constexpr float half = 0.5f;

Solidity through(float transmittance) { return transmittance <= half ? Solidity::always : Solidity::never; }

float mean(const float* rgb) { return (rgb[0] + rgb[1] + rgb[2]) / 3; }

Solidity of_logic(GLenum operation) {
    switch (operation) {
    case GL_COPY:
    case GL_COPY_INVERTED:
    case GL_SET:
    case GL_CLEAR:
        return Solidity::always;
    default: // the background is in the result, or is the result
        return Solidity::never;
    }
}

bool reads_background(GLenum source) { return source == GL_DST_COLOR || source == GL_ONE_MINUS_DST_COLOR; }

Solidity of_destination(const FragmentState& state) {
    switch (state.destination) {
    case GL_ZERO:
        return Solidity::always;
    case GL_SRC_ALPHA:
        return Solidity::by_low_alpha;
    case GL_CONSTANT_ALPHA:
        return through(state.constant[3]);
    case GL_ONE_MINUS_CONSTANT_ALPHA:
        return through(1 - state.constant[3]);
    case GL_CONSTANT_COLOR:
        return through(mean(state.constant));
    case GL_ONE_MINUS_CONSTANT_COLOR:
        return through(1 - mean(state.constant));
    case GL_ONE: // front to back, alpha says what is covered
        return state.source == GL_ONE_MINUS_DST_ALPHA ? Solidity::by_high_alpha : Solidity::never;
    case GL_SRC_COLOR:
    case GL_ONE_MINUS_SRC_COLOR:
    case GL_DST_COLOR:
    case GL_ONE_MINUS_DST_COLOR:
        return Solidity::never;
    default: // GL_ONE_MINUS_SRC_ALPHA, and the alpha of a background that most windows have not
        return Solidity::by_high_alpha;
    }
}

} // namespace

Solidity solidity(const FragmentState& state) {
    if (state.logic_op) return of_logic(state.logic_operation);
    if (!state.blends()) return Solidity::always;
    // The depths are those that a pass before drew solid, without a colour.
    const bool over_depth = state.depth_test && state.depth_function == GL_EQUAL;
    if (state.equation == GL_MAX) return through(mean(state.clear));
    if (state.equation == GL_MIN) return through(1 - mean(state.clear));
    const bool shows_nothing_of_its_own =
        state.only_tints() || (reads_background(state.source) && state.destination == GL_ZERO);
    if (shows_nothing_of_its_own) return Solidity::never;
    if (over_depth && state.destination == GL_ONE) return Solidity::by_high_alpha;
    return of_destination(state);
}

bool is_judged_by_function(GLenum destination, GLenum equation) {
    if (equation == GL_MIN || equation == GL_MAX) return true;
    return destination == GL_SRC_COLOR || destination == GL_ONE_MINUS_SRC_COLOR;
}

} // namespace glcast
