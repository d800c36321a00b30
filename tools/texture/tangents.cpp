#include "tools/texture/tangents.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

using Coordinates = std::vector<std::array<glm::vec2, 3>>;

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 1e-30 ? v * (1 / length) : glm::dvec3(0);
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
        if (set_whole_ring(vertex, fan)) return; // most
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

    /// Of a vertex whose triangles go once around it and are all of one group; false where they do not. Each edge
    /// between two of them is looked at once.
    bool set_whole_ring(std::uint32_t vertex, Fan& fan) const {
        const auto around = neighbours.around(vertex);
        if (around.empty()) return true;
        const std::uint32_t first = around[0] / 3;
        const std::uint32_t chart = chart_of[first];
        const bool turned = mirrored(first);
        const glm::dvec3 normal(mesh.normals[vertex]), &middle = mesh.positions[vertex];
        std::uint32_t t = first, k = around[0] % 3, shared = mesh.triangles[t][(k + 2) % 3];
        glm::dvec3 sum(0), before = flattened(normal, mesh.positions[shared] - middle);
        double length_before = glm::length(before);
        fan.corners.clear();
        do {
            const Triangle& v = mesh.triangles[t];
            k = v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
            if (v[(k + 2) % 3] != shared || chart_of[t] != chart || mirrored(t) != turned) return false;
            fan.corners.push_back(3 * t + k);
            if (fan.corners.size() > around.size()) return false;
            shared = v[(k + 1) % 3];
            const glm::dvec3 after = flattened(normal, mesh.positions[shared] - middle);
            const double length_after = glm::length(after);
            sum += unit_or_zero(along_x(t, k, after, before)) *
                   angle(glm::dot(before, after), length_before * length_after);
            before = after, length_before = length_after;
            t = neighbours.across[t][k];
            if (t == no_triangle) return false;
        } while (t != first);
        if (fan.corners.size() != around.size()) return false;
        set_all(fan.corners, tangent_along(sum, normal), turned);
        return true;
    }

    static double angle(double dot, double lengths) {
        return std::acos(lengths > 0 ? std::clamp(dot / lengths, -1.0, 1.0) : 0);
    }

    void set_all(std::span<const std::uint32_t> corners, const glm::vec3& tangent, bool turned) const {
        const glm::vec4 value(tangent, turned ? -1.0f : 1.0f);
        for (const std::uint32_t corner : corners) out[corner / 3][corner % 3] = value;
    }

    void join_across(Fan& fan, std::uint32_t i) const {
        const std::uint32_t t = fan.corners[i] / 3, k = fan.corners[i] % 3;
        const std::uint32_t other = neighbours.across[t][k]; // each edge once: the others are theirs
        if (other == no_triangle || chart_of[other] != chart_of[t] || mirrored(other) != mirrored(t)) return;
        for (std::uint32_t j = 0; j < fan.corners.size(); ++j)
            if (fan.corners[j] / 3 == other) fan.join(i, j);
    }

    /// Where x grows in the triangle, of any length: by its edges from corner k to the next and the one after.
    glm::dvec3 along_x(std::uint32_t t, std::uint32_t k, const glm::dvec3& to_next, const glm::dvec3& to_last) const {
        const auto& c = coordinates[t];
        const glm::dvec2 next = c[(k + 1) % 3] - c[k], last = c[(k + 2) % 3] - c[k];
        const double area = next.x * last.y - next.y * last.x;
        if (area == 0) return glm::dvec3(0);
        const glm::dvec3 way = last.y * to_next - next.y * to_last;
        return area < 0 ? -way : way;
    }

    static glm::vec3 tangent_along(const glm::dvec3& sum, const glm::dvec3& normal) {
        if (const glm::dvec3 tangent = unit_or_zero(sum); tangent != glm::dvec3(0)) return glm::vec3(tangent);
        return glm::vec3(unit_or_zero( // nothing to go by: any direction square to the normal
            flattened(normal, std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))));
    }

    void set_group(std::uint32_t vertex, const Fan& fan, std::uint32_t group) const {
        const glm::dvec3 normal(mesh.normals[vertex]), &middle = mesh.positions[vertex];
        glm::dvec3 sum(0);
        for (std::uint32_t i = 0; i < fan.corners.size(); ++i) {
            if (fan.group[i] != group) continue;
            const std::uint32_t t = fan.corners[i] / 3, k = fan.corners[i] % 3;
            const Triangle& v = mesh.triangles[t];
            const glm::dvec3 next = flattened(normal, mesh.positions[v[(k + 1) % 3]] - middle),
                             last = flattened(normal, mesh.positions[v[(k + 2) % 3]] - middle);
            sum += unit_or_zero(along_x(t, k, next, last)) *
                   angle(glm::dot(next, last), glm::length(next) * glm::length(last));
        }
        const glm::vec3 tangent = tangent_along(sum, normal);
        for (std::uint32_t i = 0; i < fan.corners.size(); ++i)
            if (fan.group[i] == group)
                set_all({&fan.corners[i], 1}, tangent, mirrored(fan.corners[i] / 3));
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
