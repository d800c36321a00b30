// What the mesh formats share: one reader and one writer each, listed in mesh_io.cpp.
#pragma once
#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/output_file.h"
#include "tools/io/mesh_io.h"
#include "tools/io/rounding.h"
#include "tools/mesh/level.h"

namespace glcast::format {

// Readers take the whole file, and where it lies for what it names, and throw std::runtime_error without its
// name. Meshes need not be checked: read_levels does.
std::vector<Level> read_glb(std::string_view bytes, const std::filesystem::path& path);
std::vector<Level> read_obj(std::string_view bytes, const std::filesystem::path& path);
std::vector<Level> read_ply(std::string_view bytes, const std::filesystem::path& path);
std::vector<Level> read_off(std::string_view bytes, const std::filesystem::path& path);
std::vector<Level> read_stl(std::string_view bytes, const std::filesystem::path& path);
std::vector<Level> read_3mf(std::string_view bytes, const std::filesystem::path& path);

/// The files of a run, which appear together.
class FileSet {
  public:
    OutputFile& mesh(const std::filesystem::path& path) { return open(path, meshes); }
    OutputFile& companion(const std::filesystem::path& path) { return open(path, companions); }
    /// All or none. Throws std::runtime_error. The meshes, then what belongs to them.
    std::vector<std::filesystem::path> commit();

  private:
    OutputFile& open(const std::filesystem::path& path, std::vector<std::filesystem::path>& list);

    std::deque<OutputFile> files;
    std::vector<std::filesystem::path> meshes, companions;
};

/// The pictures of a textured level beside its mesh NAME.EXT: NAME.colour.png, NAME.normal.png. Their file
/// names.
struct PictureNames {
    std::string colour, normal;
};
bool write_pictures(FileSet& files, const std::filesystem::path& path, const Texture& texture,
                    bool with_normal, PictureNames& names);

// Writers append to the file; false when it cannot take it (its error() says why).
/// The whole file. `grid`: of levels that share one with levels in other files; null: their own.
std::string glb_bytes(std::span<const Level> levels, Compression compression,
                      const PositionGrid* grid = nullptr);
bool write_glb(OutputFile& file, std::span<const Level> levels, Compression compression,
               const PositionGrid* grid = nullptr);
bool write_obj(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&);
bool write_ply(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&);
bool write_off(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&);

bool write_stl(FileSet& files, const std::filesystem::path& path, const Level& level,
               const WriteOptions& options);
bool write_3mf(FileSet& files, const std::filesystem::path& path, const Level& level,
               const WriteOptions& options);

/// "colour_cc1a00": of a plain colour, in .glb and .mtl.
std::string material_name(const glm::vec3& colour);

[[noreturn]] void refuse(const std::string& why);

std::vector<Level> one_level(Mesh mesh);

/// Where floats lose digits that show: a mesh so far from the origin that its own size is small beside its
/// coordinates.
bool needs_doubles(const Mesh& mesh);
/// What to write coordinates relative to where floats are all that a format has: a whole-numbered point where
/// they would lose digits, else the origin.
glm::dvec3 origin_of_floats(const Mesh& mesh);
std::string
moved_by(const glm::dvec3& from);  ///< "(-4500000, 0, 0)": how a mesh came from there to the origin
double diagonal(const Mesh& mesh); ///< of the bounding box
/// Are all coordinates floats?
bool floats_hold(const Mesh& mesh);

/// Centre of the bounding box.
glm::dvec3 centre(const Mesh& mesh);

// Display value (sRGB) to linear light and back, 0..1.
float to_linear(float display);
float to_display(float linear);

} // namespace glcast::format
