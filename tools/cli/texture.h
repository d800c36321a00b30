// --texture SIZE of glcast mesh.
#pragma once
#include "tools/cli/command.h"
#include "tools/texture/bake.h"

namespace glcast::cli {

/// A power of two in range.
CLI::Validator texture_size();

nlohmann::ordered_json to_json(const TextureReport& report);

/// "texture 2048 x 2048: 38 charts, 1 texel a sample, 2.1 % of it seen by no ray"
std::string describe(const TextureReport& report, int size);

} // namespace glcast::cli
