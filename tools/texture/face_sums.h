// What the captured surface shows over each triangle of a level. Internal.
#pragma once
#include <array>
#include <functional>
#include <glm/mat3x3.hpp>
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast {

/// Sums over points that are spread evenly on a triangle: all that a least-squares fit of values of its
/// corners, mixed linearly in between, asks for. Each point weighs its share of the area, in samples squared.
struct FaceSums {
    glm::dmat3 products{0};                       ///< of the corners' barycentric weights
    std::array<glm::dvec3, 3> normal{}, colour{}; ///< weight of the corner times what is shown
    double area = 0;                              ///< of the triangle
    double found = 0;                             ///< of it, where something is shown: 0 where nothing is
};

/// What there is to see next to a point of a triangle whose normal is `facing`.
using LookAtSurface = std::function<CapturedPoint(const glm::dvec3& point, const glm::vec3& facing)>;

/// `normals`: of the triangles, unit, or 0 where one has no area; `sample`: model units. `look` is called
/// from many threads.
std::vector<FaceSums> sum_faces(const Mesh& mesh, const LookAtSurface& look, double sample,
                                const std::vector<glm::vec3>& normals);
std::vector<FaceSums> sum_faces(const Mesh& mesh, const CapturedSurface& captured,
                                const std::vector<glm::vec3>& normals);

/// Values of the corners of one triangle for what is shown over it alone: `right` is its sums of normals or
/// colours. Where that tells little of their differences, they are nearly alike. found must not be 0.
std::array<glm::dvec3, 3> corner_values(const FaceSums& face, const std::array<glm::dvec3, 3>& right);

} // namespace glcast
