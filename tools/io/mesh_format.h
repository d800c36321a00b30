// What the mesh formats share: one reader and one writer each, listed in mesh_io.cpp.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/output_file.h"
#include "tools/mesh/level.h"

namespace glcast::format {

// Readers take the whole file and throw std::runtime_error without its name. Meshes need not be checked:
// read_levels does.
std::vector<Level> read_glb(std::string_view bytes);
std::vector<Level> read_obj(std::string_view bytes);
std::vector<Level> read_ply(std::string_view bytes);
std::vector<Level> read_off(std::string_view bytes);
std::vector<Level> read_stl(std::string_view bytes);

// Writers append to the file; false when it cannot take it (its error() says why).
std::string glb_bytes(std::span<const Level> levels); ///< the whole file
bool write_glb(OutputFile& file, std::span<const Level> levels);
bool write_obj(OutputFile& file, const Mesh& mesh);
bool write_ply(OutputFile& file, const Mesh& mesh);
bool write_off(OutputFile& file, const Mesh& mesh);

[[noreturn]] void refuse(const std::string& why);

std::vector<Level> one_level(Mesh mesh);

/// Where floats lose digits: a mesh so far from the origin that its own size is small beside its coordinates.
bool needs_doubles(const Mesh& mesh);

/// Centre of the bounding box.
glm::dvec3 centre(const Mesh& mesh);

/// Triangles of a polygon, as a fan from its first corner.
void add_fan(Mesh& mesh, std::span<const std::uint32_t> corners);

// Display value (sRGB) to linear light and back, 0..1.
float to_linear(float display);
float to_display(float linear);

} // namespace glcast::format
