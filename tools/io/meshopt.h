// EXT_meshopt_compression by meshoptimizer. Internal.
#pragma once
#include <string>
#include <string_view>

#include "tools/io/glb_container.h"
#include "tools/mesh/corner_split.h"

namespace glcast::format {

inline constexpr const char* meshopt_extension = "EXT_meshopt_compression";

/// Triangles in an order that uses each vertex soon again, vertices in the order of their use: faster to
/// draw, and smaller when compressed. The vertices of the mesh stay before the copies. Returns the mesh's
/// vertices (and no triangles) in their new order.
Mesh reorder_for_drawing(const Mesh& mesh, CornerSplit& split);

/// The same .glb with its vertices and indices compressed, and no uncompressed copy beside them: the
/// extension is required.
std::string meshopt_compressed(std::string_view file);

/// The other way; needs what the extension's specification says. Throws std::runtime_error on damage, and
/// before it takes more memory than the compressed bytes can explain.
std::string meshopt_decompressed(const GlbChunks& chunks);

} // namespace glcast::format
