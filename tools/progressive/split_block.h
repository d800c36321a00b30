// A run of vertex splits as bytes. Internal; docs/reference/progressive-meshes.md has the grammar.
#pragma once
#include <string_view>

#include "tools/progressive/incidence.h"
#include "tools/progressive/packing.h"
#include "tools/progressive/progressive_mesh.h"

namespace glcast::progressive {

constexpr std::size_t most_splits_in_block = 65536;
constexpr std::size_t most_bytes_in_block = 64u << 20; ///< unpacked

/// Incidence of a mesh at its base level.
Incidence incidence_of(const ProgressiveMesh& mesh);

/// The next `count` splits of a mesh, or fewer where they are large. Refines the mesh and its incidence past
/// them; `count` becomes their number.
Planes encode_splits(ProgressiveMesh& mesh, Incidence& incidence, std::size_t& count);

/// What a stream says of the original.
struct Totals {
    std::size_t vertices = 0, triangles = 0;
};

/// Appends `count` splits to the mesh. Throws std::runtime_error where they are none of this mesh; the mesh
/// is then refined as far as they were.
void decode_splits(std::string_view bytes, std::size_t count, const Totals& totals, ProgressiveMesh& mesh,
                   Incidence& incidence);

} // namespace glcast::progressive
