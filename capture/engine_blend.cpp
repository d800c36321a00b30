#include "capture/engine_blend.h"

#include <glm/common.hpp>

namespace glcast {

void blend_coincident(PassRunner& passes, const Target& target, const Pass& colour) {
    if (!passes.wants_blend_pass()) return;
    Pass pass = colour;
    pass.kind = PassKind::blend;
    pass.depth = DepthRule::blend;
    passes.run(pass, target);
}

void read_blended(const Target& target, std::vector<glm::vec4>& colour, const PixelRect& only) {
    target.read_colour(colour, only);
    for_each_pixel(only, target.size(),
                   [&](std::size_t p) { colour[p] = glm::clamp(colour[p], 0.0f, 1.0f); });
}

} // namespace glcast
