#include "tools/deviation/shown.h"

#include <glm/geometric.hpp>

#include "tools/picture/sample.h"

namespace glcast {
namespace {

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0 ? v / length : v;
}

template <class Values> auto mixed(const Values& values, const Triangle& t, const glm::vec3& w) {
    return values[t[0]] * w[0] + values[t[1]] * w[1] + values[t[2]] * w[2];
}

constexpr Triangle corners{0, 1, 2};

glm::vec3 normal_at(const Level& level, std::uint32_t triangle, const glm::vec3& weights) {
    const Mesh& mesh = level.mesh;
    const Triangle& t = mesh.triangles[triangle];
    if (has_normals(mesh, level.wedges))
        return mixed(corner_normals(mesh, level.wedges, triangle), corners, weights);
    const glm::dvec3& a = mesh.positions[t[0]];
    return unit(glm::vec3(glm::normalize(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a))));
}

} // namespace

bool has_colours(const Level& level) { return !level.texture.empty() || has_colours(level.mesh, level.wedges); }

Shown shown(const Level& level, std::uint32_t triangle, const glm::dvec3& weights) {
    const glm::vec3 w(weights), normal = normal_at(level, triangle, w);
    if (level.texture.empty() && !has_colours(level)) return {glm::vec3(0), unit(normal)};
    if (level.texture.empty())
        return {mixed(corner_colours(level.mesh, level.wedges, triangle), corners, w), unit(normal)};
    const glm::vec2 at = mixed(level.texture.coordinates[triangle], corners, w);
    const glm::vec4 tangent = mixed(level.texture.tangents[triangle], corners, w);
    const glm::vec3 along(tangent), across = cross(normal, along) * (tangent.w < 0 ? -1.0f : 1.0f);
    // As MikkTSpace wants it: neither is made a unit again in between.
    const glm::vec3 mapped = sample(level.texture.normal, at) * 2.0f - 1.0f;
    return {sample(level.texture.colour, at), unit(mapped.x * along + mapped.y * across + mapped.z * normal)};
}

} // namespace glcast
