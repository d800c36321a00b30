#include "tools/texture/shading_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

constexpr float farthest = 0.5f; // cosine: 60 degrees

float angle_at(const Mesh& mesh, std::uint32_t corner) {
    const Triangle& t = mesh.triangles[corner / 3];
    const glm::dvec3& p = mesh.positions[t[corner % 3]];
    const glm::dvec3 a = mesh.positions[t[(corner + 1 - corner / 3 * 3) % 3]] - p,
                     b = mesh.positions[t[(corner + 2 - corner / 3 * 3) % 3]] - p;
    return float(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// The normal of a vertex that is least turned from the triangle most turned from it (Aubry and Löhner 2008),
/// by steps from `mean` towards that triangle, as Badoiu and Clarkson 2003 find the middle of a ball around
/// points; as far as needed.
glm::vec3 most_normal(const Neighbours& neighbours, const std::vector<glm::vec3>& normals, std::uint32_t v,
                      const glm::vec3& mean) {
    constexpr int steps = 64;
    glm::vec3 middle = mean, best = mean;
    float least_of_best = -2;
    for (int step = 1; step <= steps && least_of_best <= farthest; ++step) {
        const float length = glm::length(middle);
        if (!(length > 1e-3f)) break;
        const glm::vec3 unit = middle / length;
        float least = 2;
        glm::vec3 towards = unit;
        for (const std::uint32_t corner : neighbours.around(v)) {
            const glm::vec3& normal = normals[corner / 3];
            if (normal == glm::vec3(0) || glm::dot(unit, normal) >= least) continue;
            least = glm::dot(unit, normal), towards = normal;
        }
        if (least > least_of_best) least_of_best = least, best = unit;
        middle += (towards - middle) / float(step + 1);
    }
    return best;
}

struct ShadingNormal {
    glm::vec3 normal{0};
    bool inward = false; ///< against the triangles around
};

ShadingNormal shading_normal(const Mesh& mesh, const Neighbours& neighbours,
                             const std::vector<glm::vec3>& normals, std::uint32_t v) {
    const glm::vec3 own = mesh.normals[v];
    float least = 1, most = -1;
    for (std::uint32_t corner : neighbours.around(v)) {
        const glm::vec3& normal = normals[corner / 3];
        if (normal == glm::vec3(0)) continue;
        least = std::min(least, glm::dot(own, normal));
        most = std::max(most, glm::dot(own, normal));
    }
    if (own != glm::vec3(0) && (least > farthest || most < -farthest)) return {own, most < 0};
    glm::vec3 sum(0);
    for (std::uint32_t corner : neighbours.around(v)) sum += normals[corner / 3] * angle_at(mesh, corner);
    const float length = glm::length(sum);
    if (!(length > 1e-6f)) return {own != glm::vec3(0) ? own : glm::vec3(0, 0, 1)};
    const bool inward = glm::dot(sum, own) < 0;
    const glm::vec3 normal = most_normal(neighbours, normals, v, sum / length);
    return {inward ? -normal : normal, inward};
}

constexpr std::uint8_t outward = 0, inward = 1, in_part = 2, turned = 3;

/// Parts that point inward while what they are joined to does not are turned about: between the two,
/// interpolated normals would pass through all directions. `joined(k, visit)`: calls visit for all that normal k is
/// joined to.
template <class Joined>
void turn_inward_parts(std::vector<glm::vec3>& normals, std::vector<std::uint8_t>& way, const Joined& joined) {
    std::vector<std::uint32_t> part;
    for (std::uint32_t seed = 0; seed < way.size(); ++seed) {
        if (way[seed] != inward) continue;
        bool to_outward = false;
        part = {seed};
        way[seed] = in_part;
        for (std::size_t k = 0; k < part.size(); ++k)
            joined(part[k], [&](std::uint32_t other) {
                to_outward |= way[other] == outward;
                if (way[other] == inward) way[other] = in_part, part.push_back(other);
            });
        for (const std::uint32_t k : part) {
            if (to_outward) normals[k] = -normals[k];
            way[k] = turned;
        }
    }
}

/// Within so many radians of `axis`.
glm::vec3 turned_towards(const glm::vec3& normal, const glm::vec3& axis, float radians) {
    const float along = glm::dot(normal, axis);
    if (along >= std::cos(radians)) return normal;
    glm::vec3 across = normal - along * axis;
    const float length = glm::length(across);
    if (!(length > 1e-6f)) return axis;
    return std::cos(radians) * axis + std::sin(radians) * across / length;
}

} // namespace

void make_shading_normals(Mesh& mesh, const Neighbours& neighbours, const std::vector<glm::vec3>& normals) {
    if (mesh.normals.size() != mesh.positions.size())
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    std::vector<std::uint8_t> way(mesh.positions.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, std::uint32_t(mesh.positions.size()), 2048),
                      [&](const auto& range) {
                          for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
                              const ShadingNormal made = shading_normal(mesh, neighbours, normals, v);
                              mesh.normals[v] = made.normal;
                              way[v] = made.inward ? inward : outward;
                          }
                      });
    turn_inward_parts(mesh.normals, way, [&](std::uint32_t vertex, const auto& visit) {
        for (const std::uint32_t corner : neighbours.around(vertex))
            for (const std::uint32_t v : mesh.triangles[corner / 3]) visit(v);
    });
}

namespace {

/// The mean normals of wedges' triangles, by area; 0 where they have none.
std::vector<glm::vec3> mean_normals(const Mesh& mesh, const Wedges& wedges) {
    std::vector<glm::dvec3> sums(wedges.normals.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < wedges.corners.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const glm::dvec3 &p = mesh.positions[v[0]], area = glm::cross(mesh.positions[v[1]] - p, mesh.positions[v[2]] - p);
        for (const std::uint32_t w : wedges.corners[t]) sums[w] += area;
    }
    std::vector<glm::vec3> means(sums.size(), glm::vec3(0));
    for (std::size_t w = 0; w < sums.size(); ++w)
        if (const double length = glm::length(sums[w]); length > 0) means[w] = glm::vec3(sums[w] / length);
    return means;
}

/// A wedge for this corner alone.
void split_off(Wedges& wedges, std::vector<std::uint8_t>& way, std::uint32_t& corner, const glm::vec3& normal) {
    const std::uint32_t from = corner;
    corner = std::uint32_t(wedges.normals.size());
    wedges.normals.push_back(normal);
    if (!wedges.colours.empty()) wedges.colours.push_back(glm::vec3(wedges.colours[from]));
    way.push_back(std::uint8_t(way[from]));
}

/// Which of the wedges point inward.
std::vector<std::uint8_t> bound(const Mesh& mesh, Wedges& wedges, const std::vector<glm::vec3>& normals,
                                double degrees) {
    const float radians = float(degrees * std::numbers::pi / 180), rounding = 1e-3f;
    std::vector<std::uint8_t> way(wedges.normals.size());
    const std::vector<glm::vec3> means = mean_normals(mesh, wedges);
    for (std::size_t w = 0; w < way.size(); ++w) {
        glm::vec3& normal = wedges.normals[w];
        way[w] = glm::dot(normal, means[w]) < -std::cos(radians) ? inward : outward;
        if (means[w] != glm::vec3(0))
            normal = turned_towards(normal, way[w] == inward ? -means[w] : means[w], radians);
    }
    for (std::size_t t = 0; t < wedges.corners.size(); ++t)
        for (std::uint32_t& w : wedges.corners[t]) {
            const glm::vec3 axis = way[w] == inward ? -normals[t] : normals[t];
            if (axis == glm::vec3(0) || glm::dot(wedges.normals[w], axis) >= std::cos(radians + rounding)) continue;
            split_off(wedges, way, w, turned_towards(wedges.normals[w], axis, radians));
        }
    return way;
}

} // namespace

void bound_normals(const Mesh& mesh, Wedges& wedges, const std::vector<glm::vec3>& normals, double degrees) {
    bound(mesh, wedges, normals, degrees);
}

void make_shading_normals(const Mesh& mesh, const Neighbours& neighbours, Wedges& wedges,
                          const std::vector<glm::vec3>& normals) {
    constexpr double degrees = 60;
    std::vector<std::uint8_t> way = bound(mesh, wedges, normals, degrees);
    std::vector<std::uint32_t> vertex_of(wedges.normals.size());
    for (std::size_t t = 0; t < wedges.corners.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) vertex_of[wedges.corners[t][k]] = mesh.triangles[t][k];
    turn_inward_parts(wedges.normals, way, [&](std::uint32_t wedge, const auto& visit) {
        for (const std::uint32_t corner : neighbours.around(vertex_of[wedge]))
            for (const std::uint32_t w : wedges.corners[corner / 3]) visit(w);
    });
}

} // namespace glcast
