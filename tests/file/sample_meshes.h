// Small meshes with normals and colours, for tests.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::samples {

/// The corner of the unit cube: volume 1/6.
inline Mesh tetrahedron() {
    Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    m.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (const glm::dvec3& p : m.positions) {
        m.normals.push_back(glm::vec3(glm::normalize(p - glm::dvec3(0.25))));
        m.colours.emplace_back(p);
    }
    return m;
}

/// Radii 1 and 1/4 about z; 2 u v triangles.
inline Mesh torus(std::uint32_t u, std::uint32_t v) {
    Mesh m;
    for (std::uint32_t i = 0; i < u; ++i)
        for (std::uint32_t j = 0; j < v; ++j) {
            const double a = 2 * M_PI * i / u, b = 2 * M_PI * j / v;
            const glm::dvec3 out(std::cos(a), std::sin(a), 0);
            const glm::dvec3 normal = out * std::cos(b) + glm::dvec3(0, 0, std::sin(b));
            m.positions.push_back(out + normal * 0.25);
            m.normals.emplace_back(normal);
            m.colours.emplace_back(double(i) / u, double(j) / v, 0.5);
            const std::uint32_t i1 = (i + 1) % u, j1 = (j + 1) % v;
            m.triangles.push_back({i * v + j, i1 * v + j, i1 * v + j1});
            m.triangles.push_back({i * v + j, i1 * v + j1, i * v + j1});
        }
    return m;
}

/// Both in one mesh, where vertex `second` of each pair of `b` is vertex `first` of `a`.
inline Mesh joined(Mesh a, const Mesh& b,
                   const std::vector<std::pair<std::uint32_t, std::uint32_t>>& shared) {
    std::vector<std::uint32_t> index(b.positions.size());
    for (std::uint32_t v = 0; v < index.size(); ++v) {
        bool found = false;
        for (auto [in_a, in_b] : shared)
            if (in_b == v) index[v] = in_a, found = true;
        if (found) continue;
        index[v] = a.positions.size();
        a.positions.push_back(b.positions[v] + glm::dvec3(5));
        a.normals.push_back(b.normals[v]);
        a.colours.push_back(b.colours[v]);
    }
    for (const Triangle& t : b.triangles) a.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
    return a;
}

} // namespace glcast::samples
