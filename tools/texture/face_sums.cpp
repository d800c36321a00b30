#include "tools/texture/face_sums.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tools/texture/reach.h"

namespace glcast {
namespace {

constexpr int fewest_rows = 2, most_rows = 6; // of points: 4 to 36 a triangle
constexpr double samples_a_point = 2;         // each mixes four
constexpr double alike = 0.02;                // of a triangle's weight: holds its corners' values together

/// The middles of rows * rows equal triangles that a triangle is cut into.
template <class Visit> void for_points(int rows, const Visit& visit) {
    const double step = 1.0 / rows;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; i + j < rows; ++j) {
            visit(glm::dvec3(i + 1 / 3.0, j + 1 / 3.0, rows - i - j - 2 / 3.0) * step);
            if (i + j + 1 < rows) visit(glm::dvec3(i + 2 / 3.0, j + 2 / 3.0, rows - i - j - 4 / 3.0) * step);
        }
}

FaceSums sum_face(const Mesh& mesh, const LookAtSurface& look, double sample, const Triangle& t,
                  const glm::vec3& normal) {
    FaceSums face;
    const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    face.area = 0.5 * glm::length(glm::cross(b - a, c - a)) / (sample * sample);
    if (normal == glm::vec3(0)) return face;
    const int rows =
        std::clamp(int(std::lround(std::sqrt(face.area / samples_a_point))), fewest_rows, most_rows);
    const double weight = face.area / (rows * rows);
    for_points(rows, [&](const glm::dvec3& w) {
        const CapturedPoint shown = look(w.x * a + w.y * b + w.z * c, normal);
        if (!shown.found) return;
        face.found += weight;
        face.products += glm::outerProduct(weight * w, w);
        for (int k = 0; k < 3; ++k) {
            face.normal[k] += weight * w[k] * glm::dvec3(shown.normal);
            face.colour[k] += weight * w[k] * glm::dvec3(shown.colour);
        }
    });
    return face;
}

} // namespace

std::vector<FaceSums> sum_faces(const Mesh& mesh, const LookAtSurface& look, double sample,
                                const std::vector<glm::vec3>& normals) {
    std::vector<FaceSums> faces(mesh.triangles.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces.size(), 64), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t)
            faces[t] = sum_face(mesh, look, sample, mesh.triangles[t], normals[t]);
    });
    return faces;
}

std::vector<FaceSums> sum_faces(const Mesh& mesh, const CapturedSurface& captured,
                                const std::vector<glm::vec3>& normals) {
    const double reach = needed_reach(mesh, captured, normals);
    return sum_faces(
        mesh,
        [&](const glm::dvec3& point, const glm::vec3& facing) {
            return captured.look(point, facing, facing, reach);
        },
        captured.sample(), normals);
}

std::array<glm::dvec3, 3> corner_values(const FaceSums& face, const std::array<glm::dvec3, 3>& right) {
    glm::dmat3 products = face.products;
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) products[k][l] += alike * face.found * ((k == l) - 1 / 3.0);
    const glm::dmat3 inverse = glm::inverse(products);
    std::array<glm::dvec3, 3> values{};
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) values[k] += inverse[k][l] * right[l];
    return values;
}

} // namespace glcast
