// Which of the six views each triangle is textured from.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/texture/neighbours.h"

namespace glcast {

/// 2 axis + side, as in capture/view.h: 0 is seen from -x, 1 from +x, ...
using ViewNumber = std::uint8_t;
inline constexpr int view_count = 6;

/// How squarely a view sees a surface with this normal: cosine.
inline float facing(const glm::vec3& normal, ViewNumber view) {
    return view & 1 ? normal[view / 2] : -normal[view / 2];
}

/// Where a view's picture has a point: x to the right, y down, in the unit of the point. Never mirrored:
/// right and up make a right-handed frame with the direction to the viewer.
inline glm::dvec2 in_picture(const glm::dvec3& p, ViewNumber view) {
    const int axis = view / 2, right = (axis + 1) % 3, up = (axis + 2) % 3;
    return {view & 1 ? p[right] : -p[right], -p[up]};
}

/// Unit normals of the triangles; 0 where one has no area.
std::vector<glm::vec3> triangle_normals(const Mesh& mesh);

/// The view that faces a triangle and what lies around it most squarely, with few and smooth borders between
/// views: local minima of Potts' energy (Besag 1986, "On the statistical analysis of dirty pictures"). No
/// triangle is seen flatter than 60 degrees, but for crumbs smaller than `crumb` (area as its view sees it,
/// model units), which go with a neighbour that sees them at all.
std::vector<ViewNumber> choose_views(const Mesh& mesh, const Neighbours& neighbours,
                                     const std::vector<glm::vec3>& normals, double crumb);

/// Number of the connected part of one view that each triangle belongs to, by first triangle; and how many.
std::vector<std::uint32_t> connected_parts(const std::vector<ViewNumber>& views, const Neighbours& neighbours,
                                           std::uint32_t& count);

} // namespace glcast
