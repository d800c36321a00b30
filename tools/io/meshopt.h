// EXT_meshopt_compression by meshoptimizer. Internal.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/io/glb_container.h"
#include "tools/mesh/corner_split.h"

namespace glcast::format {

inline constexpr const char* meshopt_extension = "EXT_meshopt_compression";

/// Triangles in an order that uses each vertex soon again, vertices in the order of their use: faster to
/// draw, and smaller when compressed. The vertices of the mesh stay before the copies. Returns the mesh's
/// vertices (and no triangles) in their new order; `order`: which vertex of the mesh each of them was.
Mesh reorder_for_drawing(const Mesh& mesh, CornerSplit& split, std::vector<std::uint32_t>* order = nullptr);

/// The same .glb with its vertices and indices compressed, and no uncompressed copy beside them: the
/// extension is required.
std::string meshopt_compressed(std::string_view file);

/// The other way: leaves in `gltf` a description with views of one buffer, 0, which it returns. Needs what
/// the extension's specification says. Throws std::runtime_error on damage, and before it takes more memory
/// than the compressed bytes can explain.
std::string meshopt_decompressed(nlohmann::ordered_json& gltf, const std::vector<std::string_view>& buffers);

} // namespace glcast::format
