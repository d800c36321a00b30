// What each pixel of an orthographic picture sees of a level: colour and normal, from the texture where there
// is one. No GL: normal maps need a fragment stage of their own, and pictures that are measured must not
// depend on a driver.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast {

/// A camera at infinity. Row 0 of the picture is on top; a pixel's ray goes through its centre.
struct OrthoView {
    glm::dvec3 right{1, 0, 0}, up{0, 1, 0},
        back{0, 0, 1};         ///< unit, square to one another; back: towards the camera
    glm::dvec3 centre{0};      ///< seen in the middle of the picture
    double pixel = 1;          ///< its width, model units
    int width = 0, height = 0; ///< pixels
};

struct SeenImage {
    int width = 0, height = 0;
    std::vector<char> covered;
    std::vector<glm::vec3> colour; ///< display values, 0..1
    std::vector<glm::vec3> normal; ///< model space, unit; 0 where nothing was drawn lit
};

/// The nearest surface of each pixel, either side of a triangle. Normals are those of wedges or vertices,
/// turned by the normal map where there is one, as they are, also where they point away from the camera; so
/// it is in what was captured. Else they are those of the triangles, towards the camera. Meshes without
/// colours are grey. Coordinates of the texture are read bilinearly, without smaller copies. Throws
/// std::runtime_error where texture or wedges and mesh do not go together.
SeenImage rasterise(const Mesh& mesh, const Texture& texture, const Wedges& wedges, const OrthoView& view);
inline SeenImage rasterise(const Level& level, const OrthoView& view) {
    return rasterise(level.mesh, level.texture, level.wedges, view);
}
inline SeenImage rasterise(const Mesh& mesh, const Texture& texture, const OrthoView& view) {
    return rasterise(mesh, texture, {}, view);
}

} // namespace glcast
