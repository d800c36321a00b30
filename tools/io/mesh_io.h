// Reading and writing meshes: .glb (tinygltf), .obj, .ply, .off, .stl, .3mf (lib3mf).
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "tools/io/units.h"
#include "tools/mesh/level.h"

namespace glcast {

/// All levels of a file, finest first (one for all but .glb). Colours come back as drawn: .glb holds linear
/// light, converted on the way. Of a .glb textures come back too, where a level has one material, its
/// pictures are PNG or JPEG; vertices that we copied along seams are one again. Throws std::runtime_error,
/// one line, on anything unreadable.
std::vector<Level> read_levels(const std::filesystem::path& path);
Mesh read_mesh(const std::filesystem::path& path); ///< level 0
/// The same, and of gears.glb the levels written with it to gears_LOD1.glb, ... beside it (level_set.h).
std::vector<Level> read_all_levels(const std::filesystem::path& path);

/// Of .glb alone (docs/reference/files.md).
enum class Compression {
    none,
    quantize, ///< KHR_mesh_quantization: positions of 16 bits, normals and tangents of 8
    meshopt,  ///< the same, reordered, and EXT_meshopt_compression
};

/// Positions become floats, as .glb, .stl and, where all are floats, .ply hold them: so that what is checked
/// and measured afterwards is true of the files. A mesh so far from the origin that floats would lose its
/// shape, or of which two vertices would come to one place, stays as it is.
void hold_in_floats(Mesh& mesh);

struct WriteOptions {
    Compression compression = Compression::none;
    bool one_file = false;          ///< .glb: all levels in one file, by MSFT_lod
    std::size_t units = millimetre; ///< .stl, .3mf: what a unit of the model is, of length_units
};

/// Leaves of the levels what a compressed file will hold, so that what is measured afterwards is true of the
/// file. No two vertices of a level come to one place. Does nothing without compression.
void round_levels(std::span<Level> levels, Compression compression);

/// By extension. Each level goes to a file of its own, NAME.EXT, NAME_LOD1.EXT, ... (level_path()), with one
/// mesh; errors in `extras` of .glb, textures embedded there, to .png beside .obj and .ply. Marks of sets are
/// kept (level_set.h). Written to temporary names and renamed, all or none. Throws std::runtime_error.
/// Returns the files written: meshes in the order of the levels, then what belongs to them.
std::vector<std::filesystem::path> write_levels(const std::filesystem::path& path,
                                                std::span<const Level> levels,
                                                const WriteOptions& options = {});

/// A line on what a format cannot hold of the level as it is, or nothing: .stl and .3mf of a mesh far from
/// the origin, .obj and .off of a vertex with several colours.
std::string note_on(const std::filesystem::path& path, const Level& level);

/// Bytes of the level as a .glb of its own. Throws as write_levels does.
std::uint64_t glb_size(const Level& level);

} // namespace glcast
