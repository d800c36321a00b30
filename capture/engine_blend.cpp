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

void read_blended(const Target& target, std::vector<glm::vec4>& colour) {
    target.read_colour(colour);
    for (glm::vec4& pixel : colour) pixel = glm::clamp(pixel, 0.0f, 1.0f);
}

} // namespace glcast
