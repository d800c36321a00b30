// What one sees of a level at a point. Internal.
#pragma once
#include <glm/vec3.hpp>

#include "tools/mesh/level.h"

namespace glcast {

struct Shown {
    glm::vec3 colour{0}, normal{0}; ///< display values; unit, as it is lit
};

/// By the texture where there is one, else by the wedges or the vertices; `weights` are those of the triangle's corners. A
/// mesh without normals shows those of its triangles; one without colours, black.
Shown shown(const Level& level, std::uint32_t triangle, const glm::dvec3& weights);

bool has_colours(const Level& level);

} // namespace glcast
