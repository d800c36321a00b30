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
    return {(inward ? -sum : sum) / length, inward};
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

/// The triangles of wedges in the mesh.
struct WedgePlaces {
    std::vector<std::uint32_t> vertex;
    std::vector<glm::vec3> normal; ///< mean of its triangles, by angle, not unit

    WedgePlaces(const Mesh& mesh, const Wedges& wedges, const std::vector<glm::vec3>& normals)
        : vertex(wedges.normals.size()), normal(wedges.normals.size(), glm::vec3(0)) {
        for (std::uint32_t t = 0; t < wedges.corners.size(); ++t)
            for (std::uint32_t k = 0; k < 3; ++k) {
                normal[wedges.corners[t][k]] += normals[t] * angle_at(mesh, 3 * t + k);
                vertex[wedges.corners[t][k]] = mesh.triangles[t][k];
            }
    }
};

/// Which of them point inward.
std::vector<std::uint8_t> bound(const WedgePlaces& places, const Neighbours& neighbours, Wedges& wedges,
                                const std::vector<glm::vec3>& normals, double degrees) {
    constexpr int rounds = 4; // triangles of a wedge may want different turns
    const float radians = float(degrees * std::numbers::pi / 180);
    std::vector<std::uint8_t> way(wedges.normals.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, std::uint32_t(way.size()), 1024), [&](const auto& range) {
        for (std::uint32_t w = range.begin(); w < range.end(); ++w) {
            glm::vec3& normal = wedges.normals[w];
            const float along = glm::dot(normal, places.normal[w]);
            way[w] = along < -std::cos(radians) * glm::length(places.normal[w]) ? inward : outward;
            for (int round = 0; round < rounds; ++round)
                for (const std::uint32_t corner : neighbours.around(places.vertex[w])) {
                    const glm::vec3& axis = normals[corner / 3];
                    if (wedges.corners[corner / 3][corner % 3] != w || axis == glm::vec3(0)) continue;
                    normal = turned_towards(normal, way[w] == inward ? -axis : axis, radians);
                }
        }
    });
    return way;
}

} // namespace

void bound_normals(const Mesh& mesh, const Neighbours& neighbours, Wedges& wedges,
                   const std::vector<glm::vec3>& normals, double degrees) {
    bound(WedgePlaces(mesh, wedges, normals), neighbours, wedges, normals, degrees);
}

void make_shading_normals(const Mesh& mesh, const Neighbours& neighbours, Wedges& wedges,
                          const std::vector<glm::vec3>& normals) {
    constexpr double degrees = 60;
    const WedgePlaces places(mesh, wedges, normals);
    std::vector<std::uint8_t> way = bound(places, neighbours, wedges, normals, degrees);
    turn_inward_parts(wedges.normals, way, [&](std::uint32_t wedge, const auto& visit) {
        for (const std::uint32_t corner : neighbours.around(places.vertex[wedge]))
            for (const std::uint32_t w : wedges.corners[corner / 3]) visit(w);
    });
}

} // namespace glcast
