// A progressive mesh in a file: docs/reference/progressive-meshes.md has the grammar.
#pragma once
#include <filesystem>
#include <istream>
#include <memory>
#include <string>

#include "capture/output_file.h"
#include "tools/progressive/progressive_mesh.h"

namespace glcast {

/// What a stream says of itself before its meshes begin.
struct ProgressiveInfo {
    std::string name;                        ///< at most 65,535 bytes
    double sample = 0;                       ///< lattice spacing of the capture, model units; 0 when unknown
    std::size_t vertices = 0, triangles = 0; ///< of the original
    std::size_t base_vertices = 0, base_triangles = 0;
    std::size_t splits() const { return vertices - base_vertices; }
};

/// Writes the mesh at whatever level it is, with all its splits; it comes back at that level. Of `info` only
/// name and sample count. All cores pack; the bytes are the same on any number of them. Throws
/// std::runtime_error.
void write_progressive(OutputFile& file, ProgressiveMesh& mesh, const ProgressiveInfo& info);

/// Reads while a stream comes in. All functions throw std::runtime_error, one line without the file's name,
/// on what is no stream of ours, is newer than this reader, or is damaged.
class ProgressiveReader {
  public:
    /// Up to the base mesh. `in` must outlive this; nothing beyond the stream is read from it.
    explicit ProgressiveReader(std::istream& in);
    ~ProgressiveReader();

    const ProgressiveInfo& info() const;

    /// Read one block more: the mesh grows to a new finest level, at which it is then. False where there is
    /// none: the stream is complete, or cut off; what came of a block that is cut off is not used.
    bool next();
    bool complete() const { return mesh().splits() == info().splits(); }

    ProgressiveMesh& mesh();
    const ProgressiveMesh& mesh() const;

  private:
    struct State;
    std::unique_ptr<State> state;
};

struct ProgressiveFile {
    ProgressiveInfo info;
    ProgressiveMesh mesh; ///< at its finest level
    std::size_t blocks = 0;
    bool complete = true; ///< else the file is cut off, and the finest level is coarser than the original
};

/// Everything that is there. Throws std::runtime_error, one line.
ProgressiveFile read_progressive(const std::filesystem::path& path);

/// Does the file begin as a stream of ours does?
bool looks_like_progressive(const std::filesystem::path& path);

} // namespace glcast
