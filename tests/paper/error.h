// The paper's error measure.
#pragma once
#include "tools/mesh/mesh.h"

namespace glcast::paper {

/// Points p of an original: "all the vertexes as well as the center of all polygons", without those that
/// nobody can see from outside.
struct PaperPoints {
    std::vector<glm::dvec3> seen;
    std::size_t hidden = 0;
};
PaperPoints paper_points(const Mesh& original);

/// Mean distance of the points to the surface, model units.
double paper_error(const PaperPoints& points, const Mesh& simplified);

} // namespace glcast::paper
