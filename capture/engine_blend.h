// The last step of a colour pass.
#pragma once
#include "capture/engine_pass.h"

namespace glcast {

/// After the colour pass `colour`, whose depths and colours are still in `target`: mixes in what the program
/// blends at those depths (coincident.h). Draws only where there is something to mix.
void blend_coincident(PassRunner& passes, const Target& target, const Pass& colour);

/// Colours of the pixels of `only`, 0..1: between two draws into a floating-point target nothing bounds them.
void read_blended(const Target& target, std::vector<glm::vec4>& colour, const PixelRect& only);

} // namespace glcast
