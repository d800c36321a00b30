// A level each of whose triangles has one colour: file formats say so by materials.
#pragma once
#include "tools/mesh/level.h"

namespace glcast {

struct FaceColours {
    std::vector<glm::vec3> palette;  ///< in the order of their first triangles, display values; empty: none
    std::vector<std::uint32_t> face; ///< by triangle, which of the palette

    bool empty() const { return palette.empty(); }
};

constexpr std::size_t most_face_colours = 32; ///< a material each is a draw call each

/// Empty where a triangle's corners differ, where there are more colours than that, no colours, or a texture.
FaceColours face_colours(const Level& level);

/// Of a mesh, the triangles that have one material.
struct FacePart {
    Mesh mesh;                           ///< their vertices, in the order of the whole; without colours
    Wedges wedges;                       ///< normals alone
    std::vector<std::uint32_t> vertices; ///< which of the whole each vertex is
};
FacePart part_of_colour(const Level& level, const FaceColours& colours, std::uint32_t which);

} // namespace glcast
