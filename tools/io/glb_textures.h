// The texture of a level out of a .glb. Internal.
#pragma once
#include <glm/mat3x3.hpp>
#include <vector>

#include "tools/io/gltf_file.h"
#include "tools/mesh/level.h"

namespace glcast::format {

/// A level has a texture when all its primitives have coordinates and one material with a base colour
/// texture, as we write them. Colours of vertices, where there are none, are then taken from it.
class TextureReader {
  public:
    explicit TextureReader(const GltfFile& file) : file(file), model(file.model) {}

    /// The primitive's vertices begin at `first_vertex` of the mesh, its triangles at `first_triangle`. To be
    /// called for every primitive.
    void add(const tinygltf::Primitive& primitive, const Mesh& mesh, std::size_t first_vertex,
             std::size_t first_triangle, const glm::dmat3& turn);
    /// Throws std::runtime_error on a damaged picture.
    void finish(Level& level);

  private:
    Picture picture(int texture) const;
    void add_corners(const tinygltf::Primitive& primitive, const Mesh& mesh, std::size_t first_vertex,
                     std::size_t first_triangle, const glm::dmat3& turn);

    const GltfFile& file;
    const tinygltf::Model& model;
    Texture texture;
    int material = -1;
    bool whole = true, tangents = true; ///< every primitive so far has them
};

} // namespace glcast::format
