// Texels that nothing was baked to.
#pragma once
#include <vector>

#include "tools/mesh/picture.h"

namespace glcast {

/// Gives every texel that is not `known` a smooth continuation of those that are, so that filters and smaller
/// mip levels mix in nothing foreign (push-pull: Gortler et al. 1996, "The lumigraph"). Sizes are powers of
/// two, square.
void fill_unknown(Picture& picture, const std::vector<std::uint8_t>& known);

} // namespace glcast
