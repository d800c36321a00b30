// The names that meshes are written under, in one place. Nothing else, so that glcast-run can ask too.
#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace glcast {

inline constexpr std::array<std::string_view, 4> mesh_endings = {".glb", ".obj", ".ply", ".off"};

inline bool has_mesh_ending(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return std::find(mesh_endings.begin(), mesh_endings.end(), ending) != mesh_endings.end();
}

/// ".glb, .obj, .ply or .off"
inline std::string listed_mesh_endings() {
    std::string text;
    for (std::size_t k = 0; k < mesh_endings.size(); ++k)
        text += std::string(k == 0                         ? ""
                            : k + 1 == mesh_endings.size() ? " or "
                                                           : ", ") +
                std::string(mesh_endings[k]);
    return text;
}

} // namespace glcast
