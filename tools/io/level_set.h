// Levels of one run in files of their own: what the files are called, and the mark in each by which they find
// one another.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast {

/// gears.glb, gears_LOD1.glb, gears_LOD2.glb, ...
std::filesystem::path level_path(const std::filesystem::path& path, std::size_t level);

/// "gears_LOD0", ...: what the level's mesh is called in its file.
std::string level_name(const std::filesystem::path& path, std::size_t level);

/// Makes the levels, finest first, one set, where there are several. Its number comes of what they hold.
void join_as_set(std::span<Level> levels);

/// "0123456789abcdef 1/4": the set, which of its levels, and of how many. Empty for a level of none.
std::string mark_of(const LevelSet& set);

/// The name under which a mark stands in a file: a comment, or `extras` of glTF.
inline constexpr const char* mark_name = "glcast-levels";

/// The set that a file, or its first bytes, say that they are of; none: count is 0. Throws nothing.
LevelSet marked_set(std::string_view bytes);
LevelSet set_of_file(const std::filesystem::path& path);

/// The other levels of the set of a file that holds its level 0, those that are there, finest first.
std::vector<std::filesystem::path> levels_beside(const std::filesystem::path& path, const LevelSet& set);

} // namespace glcast
