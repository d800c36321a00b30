// Is there room between two triangles? Internal. By planes between them: Ericson 2005, "Real-time collision
// detection", section 5.2.1.
#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "tools/mesh/mesh.h"

namespace glcast {

/// A triangle, with the positions of its corners.
struct Facet {
    Triangle corners;
    std::array<glm::dvec3, 3> at;
};

/// How near is too near, and what is mere rounding of doubles.
struct Nearness {
    double distance = 0, rounding = 0;
};

/// False where the triangles meet besides the corners or the edge that they have in common by name, where
/// they lie folded on one another, or where they would after moves of less than the distance; true else, but
/// for some that are hardly further apart.
bool are_apart(const Facet& s, const Facet& t, const Nearness& nearness);

} // namespace glcast
