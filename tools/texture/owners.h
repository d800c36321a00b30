// Which triangle each texel of the atlas belongs to.
#pragma once
#include "tools/texture/atlas.h"

namespace glcast {

/// Corners of a triangle in the atlas, texels.
std::array<glm::dvec2, 3> in_atlas(const Mesh& mesh, const Charts& charts, const Atlas& atlas,
                                   std::uint32_t triangle);

/// By texel, rows from the top: the triangle that covers its centre or, beside a chart's border, the nearest
/// one within half the gutter; of several the first. Else no_triangle. On the way the coordinates of all corners,
/// 0..1, y down.
std::vector<std::uint32_t> find_owners(const Mesh& mesh, const Neighbours& neighbours, const Charts& charts,
                                       const Atlas& atlas, std::vector<std::array<glm::vec2, 3>>& coordinates);

} // namespace glcast
