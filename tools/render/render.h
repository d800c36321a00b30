// Pictures of a mesh through OSMesa: no X, no window.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tools/mesh/level.h"
#include "tools/mesh/picture.h"

namespace glcast {

/// A contact sheet: a row per level, in it the six sides (-x +x -y +y -z +z: from where it is seen) and two
/// opposite corners, each `size` pixels square, lit from the camera, colours as drawn, y up (in the y views
/// z). All at the scale of the first level; a line of text over each row says how many triangles it has.
/// Throws std::runtime_error when there is no OSMesa, no mesh, or `size` is not in 16..4096.
Picture contact_sheet(std::span<const Level> levels, int size = 256);

/// One view along `direction` (the way one looks), orthographic, fitted.
Picture picture(const Mesh& mesh, const glm::dvec3& direction, int size);

/// .png, by a temporary name. Throws std::runtime_error.
void write_png(const std::filesystem::path& path, const Picture& picture);

} // namespace glcast
