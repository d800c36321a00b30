// Textures of the levels of a run.
#pragma once
#include <span>
#include <vector>

#include "tools/mesh/level.h"
#include "tools/texture/bake.h"

namespace glcast {

/// Textures every level, atlases `size` texels wide; one report each. Throws as bake_texture does.
std::vector<TextureReport> texture_levels(std::span<Level> levels, const CapturedSurface& captured, int size);

} // namespace glcast
