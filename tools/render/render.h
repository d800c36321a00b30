// Pictures of a mesh: no X, no window. Through OSMesa, or pixel by pixel where there is a texture.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "capture/view_image.h"
#include "tools/mesh/level.h"
#include "tools/mesh/picture.h"

namespace glcast {

/// The six views of a capture, as they stand beside levels.
struct CapturedViews {
    std::string caption;
    std::span<const ViewImage> images; ///< layer 0 of the six views among them
    Box box;
};

/// A contact sheet: a row per level, in it the six sides (-x +x -y +y -z +z: from where it is seen) and two
/// opposite corners, each `size` pixels square, lit from the camera, colours as drawn, or of the texture with
/// its normals, y up (in the y views z). All at the scale of the first level; a line of text over each row
/// says how many triangles the level has and how far it is from level 0. With `captured`, a first row of what
/// was captured, in the same light, place and scale. Throws std::runtime_error when there is no OSMesa, no
/// mesh, or `size` is not in 16..4096.
Picture contact_sheet(std::span<const Level> levels, int size = 256, const CapturedViews* captured = nullptr);

/// "level 1: 500 triangles, error mean 0.3, max 4 samples, ...": what is known of it.
std::string level_caption(const Level& level);

/// One view along `direction` (the way one looks), orthographic, fitted, by OSMesa.
Picture picture(const Mesh& mesh, const glm::dvec3& direction, int size);

/// The same in the same light, without GL, textured where there is a texture.
Picture picture(const Level& level, const glm::dvec3& direction, int size);

/// .png, by a temporary name. Throws std::runtime_error.
void write_png(const std::filesystem::path& path, const Picture& picture);

} // namespace glcast
