// --texture of glcast mesh.
#pragma once
#include "tools/cli/command.h"
#include "tools/pipeline/textures.h"

namespace glcast::cli {

/// auto, none, or a power of two in range.
CLI::Validator texture_size();
TextureChoice texture_choice(const std::string& text); ///< of such a text

nlohmann::ordered_json to_json(const TextureReport& report);

/// "texture 2048 x 2048: 38 charts, 1 texel a sample, 2.1 % of it seen by no ray"
std::string describe(const TextureReport& report);

} // namespace glcast::cli
