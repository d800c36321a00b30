#include "tools/texture/shading_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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

/// Parts that point inward while what they are joined to does not are turned about: between the two,
/// interpolated normals would pass through all directions.
void turn_inward_parts(Mesh& mesh, const Neighbours& neighbours, std::vector<std::uint8_t>& inward) {
    std::vector<std::uint32_t> part;
    for (std::uint32_t seed = 0; seed < inward.size(); ++seed) {
        if (inward[seed] != 1) continue;
        bool joined = false;
        part = {seed};
        inward[seed] = 2; // in a part
        for (std::size_t k = 0; k < part.size(); ++k)
            for (const std::uint32_t corner : neighbours.around(part[k]))
                for (const std::uint32_t v : mesh.triangles[corner / 3]) {
                    joined |= !inward[v];
                    if (inward[v] == 1) inward[v] = 2, part.push_back(v);
                }
        for (const std::uint32_t v : part) {
            if (joined) mesh.normals[v] = -mesh.normals[v];
            inward[v] = 3; // done
        }
    }
}

} // namespace

void make_shading_normals(Mesh& mesh, const Neighbours& neighbours, const std::vector<glm::vec3>& normals) {
    if (mesh.normals.size() != mesh.positions.size())
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    std::vector<std::uint8_t> inward(mesh.positions.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, std::uint32_t(mesh.positions.size()), 2048),
                      [&](const auto& range) {
                          for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
                              const ShadingNormal made = shading_normal(mesh, neighbours, normals, v);
                              mesh.normals[v] = made.normal;
                              inward[v] = made.inward;
                          }
                      });
    turn_inward_parts(mesh, neighbours, inward);
}

} // namespace glcast
