// What becomes of the fragments that a program draws at one and the same depth: several passes over a
// surface, light maps, decals, surfaces drawn twice. The colour of a depth is what the program's own sequence
// of draws leaves there.
//
// Two passes find it. The colour pass finds the depth, and leaves the colour of the fragment that stays
// there. Where a program blends, the blend pass draws once more, at the depths that were found, with the
// program's own blending; the stencil buffer stands in for the program's depth buffer, and tells where it
// would hold this depth already.
//
// Three things a program blends for are not to be mixed in, since the light that they belong to is not drawn:
// a further light of a lit surface, which in our passes has no light and would be its material once more; a
// shadow, kept to places by a stencil test that is not followed (program_stencil.h); and fog.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast {

/// How a fragment changes the colour that is at its depth already.
enum class Mixing {
    replace,  ///< its own colour stays
    blend,    ///< the program's blend function and equation
    brighten, ///< the greater of both: a further light over a surface that is lit
};

/// What a draw does among others at its depth.
struct Coincidence {
    bool yields =
        true; ///< to what wrote this depth before it: the program's depth test lets only nearer ones through
    Mixing mixing = Mixing::replace;
};

/// The state of a program on which it depends. GL's defaults.
struct FragmentState {
    bool lighting = false, blend = false, depth_test = false, depth_mask = true, stencil_test = false;
    bool stencil_known = false; ///< it is drawn only where the stencil test passes (program_stencil.h)
    GLenum depth_function = GL_LESS, stencil_function = GL_ALWAYS;
    GLenum source = GL_ONE, destination = GL_ZERO, source_alpha = GL_ONE, destination_alpha = GL_ZERO;
    GLenum equation = GL_FUNC_ADD, equation_alpha = GL_FUNC_ADD;
    bool logic_op = false; ///< GL_COLOR_LOGIC_OP, which takes the place of blending
    GLenum logic_operation = GL_COPY;
    float constant[4] = {0, 0, 0, 0}; ///< glBlendColor
    float clear[4] = {0, 0, 0, 0};    ///< glClearColor

    bool blends() const; ///< and not in a way that replaces
    /// Nothing but what is behind, tinted: a light map or a shadow, and no surface of its own.
    bool only_tints() const;
    /// Over itself, and whatever its alpha is, it leaves its own colour: glass.
    bool interpolates() const;
};

Coincidence coincidence(const FragmentState& state);

/// Blending of the real GL as the program has it, or as `mixing` says.
void set_mixing(const GlTable& gl, const FragmentState& state, Mixing mixing);
/// Blending of the colour pass: what is to be blended begins with its own colour or with black.
void set_first_colour(const GlTable& gl, const FragmentState& state);

} // namespace glcast
