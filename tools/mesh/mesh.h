// The triangle mesh that the tools hand to one another.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace glcast {

using Triangle = std::array<std::uint32_t, 3>; ///< counter-clockwise seen from outside

/// Indexed triangles with one position, normal and colour per vertex. Units and axes are the capture frame's.
struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  ///< unit length, or empty
    std::vector<glm::vec3> colours;  ///< as drawn (display values, not linear light), 0..1, or empty
    std::vector<Triangle> triangles;
};

} // namespace glcast
