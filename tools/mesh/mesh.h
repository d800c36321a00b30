// The triangle mesh that the tools hand to one another.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
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

/// One level of detail, finest first.
struct Level {
    Mesh mesh;
    std::string name; ///< "level 0", ...
    double mean_error = 0, max_error = 0; ///< measured against level 0, model units
    double sample = 0; ///< lattice spacing of the capture it was made from, model units; 0 when unknown
};

} // namespace glcast
