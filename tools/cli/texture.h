// --texture SIZE of glcast mesh.
#pragma once
#include <span>
#include <vector>

#include "tools/cli/command.h"
#include "tools/texture/bake.h"

namespace glcast::cli {

/// A power of two in range.
CLI::Validator texture_size();

/// Textures every level; one report each.
std::vector<TextureReport> texture_levels(std::span<Level> levels, const CapturedSurface& captured, int size);

nlohmann::ordered_json to_json(const TextureReport& report);

/// "texture 2048 x 2048: 38 charts, 1 texel a sample, 2.1 % of it seen by no ray"
std::string describe(const TextureReport& report, int size);

} // namespace glcast::cli
