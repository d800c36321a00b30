#include "tests/paper/error.h"

#include <glm/geometric.hpp>
#include <numeric>

#include "tools/deviation/deviation.h"

namespace glcast::paper {
namespace {

glm::dvec3 area_normal(const Mesh& mesh, const Triangle& t) {
    const glm::dvec3& a = mesh.positions[t[0]];
    return glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
}

glm::dvec3 centre(const Mesh& mesh, const Triangle& t) {
    return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
}

} // namespace

PaperPoints paper_points(const Mesh& original) {
    std::vector<SurfacePoint> look_from(original.positions.size());
    std::vector<double> area(original.positions.size(), 0);
    for (const Triangle& t : original.triangles) {
        const glm::dvec3 normal = area_normal(original, t);
        const double doubled = glm::length(normal);
        if (doubled <= 0) continue;
        for (const std::uint32_t v : t) // from a little inside the largest triangle: a vertex hides itself
            if (doubled > area[v]) {
                const glm::dvec3& p = original.positions[v];
                look_from[v] = {p + 0.01 * (centre(original, t) - p), normal / doubled};
                area[v] = doubled;
            }
    }
    std::vector<glm::dvec3> points = original.positions;
    for (const Triangle& t : original.triangles) {
        const glm::dvec3 normal = area_normal(original, t);
        points.push_back(centre(original, t));
        look_from.push_back({points.back(), glm::length(normal) > 0 ? glm::normalize(normal) : normal});
    }
    const std::vector<char> visible = visible_points(original, look_from);
    PaperPoints result;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (visible[i])
            result.seen.push_back(points[i]);
        else
            ++result.hidden;
    return result;
}

double paper_error(const PaperPoints& points, const Mesh& simplified) {
    const std::vector<double> d = distances_to(simplified, points.seen);
    return std::accumulate(d.begin(), d.end(), 0.0) / double(d.size());
}

} // namespace glcast::paper
