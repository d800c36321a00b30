// What `glcast info` says of a progressive mesh.
#pragma once
#include <filesystem>

#include "tools/cli/command.h"

namespace glcast::cli {

/// `glcast info` of a .glpm.
int progressive_info(const std::filesystem::path& file, bool json);

} // namespace glcast::cli
