#include "tests/pictures/creases.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

namespace glcast::pictures {
namespace {

glm::dvec3 area_normal(const Mesh& mesh, const Triangle& t) {
    const glm::dvec3& a = mesh.positions[t[0]];
    return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
}

struct Edge {
    std::uint32_t low, high;
    std::uint32_t at_low, at_high; ///< corners
    bool operator<(const Edge& o) const {
        return std::tie(low, high, at_low) < std::tie(o.low, o.high, o.at_low);
    }
};

class Groups {
  public:
    explicit Groups(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }
    std::uint32_t of(std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

  private:
    std::vector<std::uint32_t> parent;
};

std::vector<Edge> edges_of(const Mesh& mesh) {
    std::vector<Edge> edges;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            const std::uint32_t at_a = 3 * t + k, at_b = 3 * t + (k + 1) % 3;
            edges.push_back(a < b ? Edge{a, b, at_a, at_b} : Edge{b, a, at_b, at_a});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

} // namespace

Sides sides_of_creases(const Mesh& mesh, double least) {
    std::vector<glm::dvec3> normals;
    for (const Triangle& t : mesh.triangles) normals.push_back(area_normal(mesh, t));
    Groups groups(3 * mesh.triangles.size());
    const std::vector<Edge> edges = edges_of(mesh);
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const Edge &one = edges[i - 1], &other = edges[i];
        if (one.low != other.low || one.high != other.high) continue;
        const glm::dvec3 &n = normals[one.at_low / 3], &m = normals[other.at_low / 3];
        if (!(dot(n, m) > least * length(n) * length(m))) continue;
        groups.join(one.at_low, other.at_low);
        groups.join(one.at_high, other.at_high);
    }
    Sides sides;
    std::vector<std::uint32_t> number(3 * mesh.triangles.size());
    std::vector<double> count;
    sides.of_corner.resize(mesh.triangles.size());
    for (std::uint32_t c = 0; c < number.size(); ++c) {
        const std::uint32_t first = groups.of(c);
        if (first == c) {
            number[c] = std::uint32_t(count.size());
            count.push_back(0);
            sides.normals.emplace_back(0), sides.middles.emplace_back(0);
            sides.vertex.push_back(mesh.triangles[c / 3][c % 3]);
        }
        const Triangle& t = mesh.triangles[c / 3];
        const std::uint32_t side = sides.of_corner[c / 3][c % 3] = number[first];
        sides.normals[side] += normals[c / 3];
        sides.middles[side] += (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
        ++count[side];
    }
    for (std::size_t side = 0; side < count.size(); ++side) {
        sides.middles[side] /= count[side];
        if (const double size = length(sides.normals[side]); size > 0) sides.normals[side] /= size;
    }
    return sides;
}

} // namespace glcast::pictures
