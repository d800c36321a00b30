#include "tests/mesh/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace glcast::test {
namespace {

constexpr double pi = std::numbers::pi;

/// Each triangle in four, new corners on the unit sphere.
void subdivide(Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] =
            middles.try_emplace(std::minmax(a, b), std::uint32_t(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(normalize(mesh.positions[a] + mesh.positions[b]));
        return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
}

Mesh moved(Mesh mesh, double factor, const glm::dvec3& by) {
    for (glm::dvec3& p : mesh.positions) p = p * factor + by;
    return mesh;
}

} // namespace

Mesh sphere(double radius, int subdivisions, const glm::dvec3& centre) {
    const double g = std::numbers::phi;
    Mesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::dvec3& p : mesh.positions) p = normalize(p);
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int i = 0; i < subdivisions; ++i) subdivide(mesh);
    for (const glm::dvec3& p : mesh.positions) mesh.normals.emplace_back(p);
    return moved(std::move(mesh), radius, centre);
}

Mesh torus(double major, double minor, int around, int across) {
    Mesh mesh;
    const auto id = [&](int i, int j) { return std::uint32_t((i % around) * across + j % across); };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double u = 2 * pi * i / around, v = 2 * pi * j / across;
            const glm::dvec3 out(std::cos(u), std::sin(u), 0),
                normal(std::cos(v) * out + glm::dvec3(0, 0, std::sin(v)));
            mesh.positions.push_back(major * out + minor * normal);
            mesh.normals.emplace_back(normal);
            mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return mesh;
}

Mesh blocks(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled) {
    const std::array<int, 3> size{nx, ny, nz};
    const auto is_filled = [&](const std::array<int, 3>& c) {
        for (std::size_t k = 0; k < 3; ++k)
            if (c[k] < 0 || c[k] >= size[k]) return false;
        return filled(c[0], c[1], c[2]);
    };
    Mesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> corners;
    const auto corner = [&](const std::array<int, 3>& c) {
        const auto [at, is_new] = corners.try_emplace(c, std::uint32_t(mesh.positions.size()));
        if (is_new) mesh.positions.emplace_back(c[0], c[1], c[2]);
        return at->second;
    };
    const auto square = [&](std::array<int, 3> at, std::size_t axis, bool forwards) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> q{};
        for (const std::size_t k : {0, 1, 2, 3}) {
            std::array<int, 3> c = at;
            c[u] += (k == 1 || k == 2), c[v] += (k >= 2);
            q[forwards ? k : 3 - k] = corner(c);
        }
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    };
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                for (std::size_t axis = 0; axis < 3 && filled(x, y, z); ++axis)
                    for (const int side : {-1, 1}) {
                        std::array<int, 3> next{x, y, z}, at{x, y, z};
                        next[axis] += side, at[axis] += side > 0;
                        if (!is_filled(next)) square(at, axis, side > 0);
                    }
    return mesh;
}

Mesh cube(double edge, int cells) {
    return moved(blocks(cells, cells, cells, [](int, int, int) { return true; }), edge / cells,
                 glm::dvec3(-edge / 2));
}

Mesh plate_with_holes(int holes) {
    return blocks(4 * holes + 2, 6, 2, [](int x, int y, int) {
        const bool in_hole = x % 4 >= 2 && y >= 2 && y < 4;
        return !in_hole;
    });
}

Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

Mesh joined(Mesh a, const Mesh& b) {
    const auto offset = std::uint32_t(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
    a.colours.insert(a.colours.end(), b.colours.begin(), b.colours.end());
    for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + offset, j + offset, k + offset});
    return a;
}

Mesh turned_inside_out(Mesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    for (glm::vec3& n : mesh.normals) n = -n;
    return mesh;
}

void paint(Mesh& mesh, const std::function<glm::vec3(const glm::dvec3&)>& colour) {
    mesh.colours.clear();
    for (const glm::dvec3& p : mesh.positions) mesh.colours.push_back(colour(p));
}

std::vector<NamedBody> bodies() {
    Mesh specks = cube(8, 8);
    for (int i = 0; i < 20; ++i) specks = joined(std::move(specks), moved(tetrahedron(), 0.1, {i, 9, 0}));
    Mesh shells = sphere(3, 4);
    shells = joined(std::move(shells), turned_inside_out(sphere(2.9, 4))); // thin, hollow
    shells = joined(std::move(shells), sphere(1, 3));                      // and something in it
    Mesh row = sphere(1, 3);
    row = joined(std::move(row), sphere(1, 3, {1.5, 0, 0}));
    Mesh leaf = sphere(1, 5);
    for (glm::dvec3& p : leaf.positions) p.z *= 1e-3;
    return {
        {"sphere", sphere(1, 4), 2, 1},
        {"torus", torus(2, 0.6, 48, 24), 0, 1},
        {"cube", cube(1, 16), 2, 1},
        {"plate with 5 holes", plate_with_holes(5), -8, 1},
        {"nested shells", std::move(shells), 6, 3},
        {"overlapping spheres", std::move(row), 4, 2},
        {"cube and specks", std::move(specks), 42, 21},
        {"leaf", std::move(leaf), 2, 1},
        {"tiny and far away", moved(sphere(1, 3), 1e-4, {1000, -2000, 500}), 2, 1},
        {"huge", moved(torus(2, 0.6, 24, 12), 1e7, {0, 0, 0}), 0, 1},
        {"tetrahedron", tetrahedron(), 2, 1},
    };
}

} // namespace glcast::test
