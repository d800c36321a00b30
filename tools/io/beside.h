// Files that a mesh file names: materials, pictures.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace glcast::format {

/// Bytes of the regular file `name` in the folder of `mesh` or below it; of a name that leads elsewhere (absolute, `..`, a link
/// out of the folder) its last part is looked for in the folder itself, since many programs write the path that they
/// had. Never waits, opens no device and reads no more than `most` bytes. Nothing when there is no such file.
std::optional<std::string> read_beside(const std::filesystem::path& mesh, std::string_view name, std::size_t most);

} // namespace glcast::format
