// Opaque is what blending makes opaque: which fragments of a draw are solid, by how much of what is behind
// them still shows in the program's own picture.
//
// What is left of the background is the destination's factor. Most factors are constant or depend on the
// fragment's alpha alone, so that an alpha test tells one fragment from another. Those that depend on its
// colour, or on the background, are judged by the function as a whole; minimum and maximum over the colour
// that the program clears to.
#pragma once
#include "capture/coincident.h"

namespace glcast {

enum class Solidity {
    always,
    never,         ///< glows, tints, light maps, what a logic operation mixes with the background
    by_high_alpha, ///< where alpha is a half or more
    by_low_alpha,  ///< where it is a half or less
};

Solidity solidity(const FragmentState& state);

/// Its colours decide, and no test of ours can look at them: all of it counts as not solid.
bool is_judged_by_function(GLenum destination, GLenum equation);

} // namespace glcast
