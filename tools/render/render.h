// Pictures of a mesh through OSMesa: no X, no window.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; ///< row 0 on top
};

/// A contact sheet: a row per level, in it the six sides (-x +x -y +y -z +z) and two opposite corners, each `size` pixels
/// square, lit from the camera, colours as drawn. Throws std::runtime_error when there is no OSMesa.
Picture contact_sheet(std::span<const Level> levels, int size = 256);

/// One view from `direction` (towards the mesh), orthographic, fitted.
Picture picture(const Mesh& mesh, const glm::dvec3& direction, int size);

/// .png, by a temporary name. Throws std::runtime_error.
void write_png(const std::filesystem::path& path, const Picture& picture);

} // namespace glcast
