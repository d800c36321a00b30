#include "tools/texture/tangents.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

using Coordinates = std::vector<std::array<glm::vec2, 3>>;

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 1e-30 ? v / length : glm::dvec3(0);
}
glm::dvec3 flattened(const glm::dvec3& normal, const glm::dvec3& v) {
    return v - normal * glm::dot(normal, v);
}

/// Corners of one vertex, and the group that each is in.
struct Fan {
    std::vector<std::uint32_t> corners, group;
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
        for (std::uint32_t& g : group)
            if (g == from) g = to;
    }
};

class Tangents {
  public:
    Tangents(const Mesh& mesh, const Neighbours& neighbours, const std::vector<std::uint32_t>& chart_of,
             const Coordinates& coordinates, std::vector<std::array<glm::vec4, 3>>& out)
        : mesh(mesh), neighbours(neighbours), chart_of(chart_of), coordinates(coordinates), out(out) {}

    void at(std::uint32_t vertex, Fan& fan) const {
        const auto around = neighbours.around(vertex);
        fan.corners.assign(around.begin(), around.end());
        fan.group.resize(fan.corners.size());
        for (std::uint32_t i = 0; i < fan.group.size(); ++i) fan.group[i] = i;
        for (std::uint32_t i = 0; i < fan.corners.size(); ++i) join_across(fan, i);
        for (std::uint32_t i = 0; i < fan.corners.size(); ++i)
            if (fan.group[i] == i) set_group(vertex, fan, i);
    }

  private:
    /// Twice the area in the atlas, y down: negative where the triangle is not mirrored.
    float turn(std::uint32_t t) const {
        const auto& c = coordinates[t];
        const glm::vec2 a = c[1] - c[0], b = c[2] - c[0];
        return a.x * b.y - a.y * b.x;
    }
    bool mirrored(std::uint32_t t) const { return turn(t) > 0; }

    void join_across(Fan& fan, std::uint32_t i) const {
        const std::uint32_t t = fan.corners[i] / 3, k = fan.corners[i] % 3;
        const std::uint32_t other = neighbours.across[t][k]; // each edge once: the others are theirs
        if (other == no_triangle || chart_of[other] != chart_of[t] || mirrored(other) != mirrored(t)) return;
        for (std::uint32_t j = 0; j < fan.corners.size(); ++j)
            if (fan.corners[j] / 3 == other) fan.join(i, j);
    }

    /// Where x grows in the triangle, of any length.
    glm::dvec3 along_x(std::uint32_t t) const {
        const Triangle& v = mesh.triangles[t];
        const auto& c = coordinates[t];
        const glm::dvec2 a = c[1] - c[0], b = c[2] - c[0];
        const glm::dvec3 d = mesh.positions[v[1]] - mesh.positions[v[0]],
                         e = mesh.positions[v[2]] - mesh.positions[v[0]];
        const double area = a.x * b.y - a.y * b.x;
        return area == 0 ? glm::dvec3(0) : (b.y * d - a.y * e) / area;
    }

    void set_group(std::uint32_t vertex, const Fan& fan, std::uint32_t group) const {
        const glm::dvec3 normal(mesh.normals[vertex]);
        glm::dvec3 sum(0);
        for (std::uint32_t i = 0; i < fan.corners.size(); ++i) {
            if (fan.group[i] != group) continue;
            const std::uint32_t t = fan.corners[i] / 3, k = fan.corners[i] % 3;
            const Triangle& v = mesh.triangles[t];
            const glm::dvec3 a = flattened(normal, mesh.positions[v[(k + 2) % 3]] - mesh.positions[v[k]]),
                             b = flattened(normal, mesh.positions[v[(k + 1) % 3]] - mesh.positions[v[k]]);
            const double lengths = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
            const double cosine = lengths > 0 ? std::clamp(glm::dot(a, b) / lengths, -1.0, 1.0) : 0;
            sum += unit_or_zero(flattened(normal, along_x(t))) * std::acos(cosine);
        }
        glm::dvec3 tangent = unit_or_zero(sum);
        if (tangent == glm::dvec3(0)) // nothing to go by: any direction square to the normal
            tangent = unit_or_zero(
                flattened(normal, std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        for (std::uint32_t i = 0; i < fan.corners.size(); ++i)
            if (fan.group[i] == group)
                out[fan.corners[i] / 3][fan.corners[i] % 3] =
                    glm::vec4(glm::vec3(tangent), mirrored(fan.corners[i] / 3) ? -1.0f : 1.0f);
    }

    const Mesh& mesh;
    const Neighbours& neighbours;
    const std::vector<std::uint32_t>& chart_of;
    const Coordinates& coordinates;
    std::vector<std::array<glm::vec4, 3>>& out;
};

} // namespace

std::vector<std::array<glm::vec4, 3>> make_tangents(const Mesh& mesh, const Neighbours& neighbours,
                                                    const std::vector<std::uint32_t>& chart_of,
                                                    const Coordinates& coordinates) {
    std::vector<std::array<glm::vec4, 3>> out(mesh.triangles.size());
    const Tangents tangents(mesh, neighbours, chart_of, coordinates, out);
    tbb::enumerable_thread_specific<Fan> fans;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, std::uint32_t(mesh.positions.size()), 1024),
                      [&](const auto& range) {
                          Fan& fan = fans.local();
                          for (std::uint32_t v = range.begin(); v < range.end(); ++v) tangents.at(v, fan);
                      });
    return out;
}

} // namespace glcast
