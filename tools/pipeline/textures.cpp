#include "tools/pipeline/textures.h"

namespace glcast {

std::vector<TextureReport> texture_levels(std::span<Level> levels, const CapturedSurface& captured,
                                          int size) {
    std::vector<TextureReport> reports(levels.size());
    for (std::size_t k = 0; k < levels.size(); ++k)
        bake_texture(levels[k], captured, {.size = size}, &reports[k]);
    return reports;
}

} // namespace glcast
