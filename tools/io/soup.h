// Polygons as a file of somebody else's has them, before they are a Mesh.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast::format {

/// Every list but the first three may be empty: the file does not say. Colours of corners go before those of vertices, these
/// before those of faces.
struct Soup {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> sizes;   ///< corners of each face, in order
    std::vector<std::uint32_t> corners; ///< of all faces, one after another: vertices
    std::vector<glm::vec3> normals;        ///< of vertices
    std::vector<glm::vec3> colours;        ///< of vertices
    std::vector<glm::vec3> face_colours;   ///< of faces
    std::vector<glm::vec3> corner_normals; ///< of corners; not finite where a corner has none
    std::vector<glm::vec3> corner_colours; ///< of corners
    std::vector<glm::vec2> corner_places;  ///< of corners, texture coordinates as in the file; not finite: none

    void begin_face() { sizes.push_back(0); }
    void corner(std::uint32_t vertex) { corners.push_back(vertex), ++sizes.back(); }
};

/// The mesh, its polygons cut into triangles; what belongs to faces and corners becomes wedges. Throws
/// std::runtime_error on corners that are not there and lists of the wrong length.
Level level_of(Soup&& soup);

/// Colours of 0..255 or 0..65535 to 0..1. `whole`: they are written as whole numbers, so that 1 is nearly black; other
/// colours are taken to be of 0..1 unless one is larger.
void scale_colours(std::vector<glm::vec3>& colours, bool whole);

/// As bytes and back, to pass through a pipe; `to` throws std::runtime_error on bytes that are no soup.
std::string bytes_of(const Soup& soup);
Soup soup_of(std::string_view bytes);

} // namespace glcast::format
