// Reading and writing meshes: .glb (tinygltf), .obj, .ply, .off; .stl is read only.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

#include "tools/mesh/level.h"

namespace glcast {

/// All levels of a file, finest first (one for .obj, .ply, .off, .stl). Colours come back as drawn: .glb
/// holds linear light, converted on the way. Throws std::runtime_error, one line, on anything unreadable.
std::vector<Level> read_levels(const std::filesystem::path& path);
Mesh read_mesh(const std::filesystem::path& path); ///< level 0

/// By extension. .glb: all levels in one file, level 0 shown, the others beside it by MSFT_lod, measured
/// errors in `extras`; the other formats hold one level, so more levels go to NAME.lod1.EXT, ... Written to
/// temporary names and renamed. Throws std::runtime_error. Returns the files written.
std::vector<std::filesystem::path> write_levels(const std::filesystem::path& path,
                                                std::span<const Level> levels);

/// Bytes of the level as a .glb of its own. Throws as write_levels does.
std::uint64_t glb_size(const Level& level);

} // namespace glcast
