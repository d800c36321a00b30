// Reading and writing meshes: .glb (tinygltf), .obj, .ply, .off, .stl; .3mf (lib3mf) is written only.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "tools/io/units.h"
#include "tools/mesh/level.h"

namespace glcast {

/// All levels of a file, finest first (one for .obj, .ply, .off, .stl). Colours come back as drawn: .glb holds linear
/// light, converted on the way. Of a .glb textures come back too, where a level has one material, its pictures are PNG
/// or JPEG; vertices that we copied along seams are one again. Throws std::runtime_error, one line, on anything
/// unreadable.
std::vector<Level> read_levels(const std::filesystem::path& path);
Mesh read_mesh(const std::filesystem::path& path); ///< level 0

/// Of .glb alone (docs/files.md).
enum class Compression {
    none,
    quantize, ///< KHR_mesh_quantization: positions of 16 bits, normals and tangents of 8
    meshopt,  ///< the same, reordered, and EXT_meshopt_compression
};

struct WriteOptions {
    Compression compression = Compression::none;
    bool split = false; ///< .glb: beside NAME.glb a file for each level, NAME.lod0.glb, NAME.lod1.glb, ...
    /// .glb: called once all but the errors has been taken from the levels, which may still be measured until it
    /// returns. What it throws is passed on, and nothing is written.
    std::function<void()> await_errors = {};
    std::size_t units = millimetre; ///< .stl, .3mf: what a unit of the model is, of length_units
};

/// Leaves of the levels what a compressed file will hold, so that what is measured afterwards is true of the file. No
/// two vertices of a level come to one place. Does nothing without compression.
void round_levels(std::span<Level> levels, Compression compression);

/// By extension. .glb: all levels in one file, level 0 shown, the others beside it by MSFT_lod, measured errors in
/// `extras`, textures embedded; the other formats hold one level, so more levels go to NAME.lod1.EXT, ..., and textures
/// of .obj and .ply to .png beside them. Written to temporary names and renamed, all or none. Throws
/// std::runtime_error. Returns the files written: meshes in the order of the levels, then what belongs to them.
std::vector<std::filesystem::path> write_levels(const std::filesystem::path& path, std::span<const Level> levels,
                                                const WriteOptions& options = {});

/// A line on what a format cannot hold of the level as it is, or nothing: .stl and .3mf of a mesh far from the origin.
std::string note_on(const std::filesystem::path& path, const Level& level);

/// Bytes of the level as a .glb of its own. Throws as write_levels does.
std::uint64_t glb_size(const Level& level);

} // namespace glcast
