#include "tests/progressive/bodies.h"

#include <cstring>
#include <glm/trigonometric.hpp>

#include "tests/mesh/bodies.h"
#include "tests/paper/originals.h"

namespace glcast::test {
namespace {

/// Nodes at the even cells of a grid, random bars between them.
Mesh scaffold(unsigned seed) {
    constexpr int n = 7;
    std::mt19937 random(seed);
    std::vector<bool> cells(n * n * n);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t odd = i % n % 2 + i / n % n % 2 + i / n / n % 2;
        cells[i] = odd == 0 || (odd == 1 && random() % 8 < 1 + seed % 7);
    }
    return blocks(n, n, n, [&](int x, int y, int z) { return cells[std::size_t(x + n * (y + n * z))]; });
}

void paint_by_place(Mesh& mesh) {
    paint(mesh, [](const glm::dvec3& p) { return glm::vec3(0.5 + 0.5 * glm::sin(7.0 * p)); });
}

template <class T> bool equal(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || !std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]));
}

} // namespace

std::vector<LoggedBody> logged_bodies() {
    std::vector<LoggedBody> all;
    const auto add = [&](const std::string& name, Mesh mesh, Placement placement, std::size_t down_to = 4) {
        CollapseLog log = shortest_edges(mesh, down_to, placement, unsigned(all.size() + 1)).log;
        all.push_back({name, std::move(mesh), std::move(log)});
    };
    for (NamedBody& body : bodies()) {
        if (body.mesh.triangles.size() > 6000) continue; // the collapser here is slow
        if (all.size() % 2) paint_by_place(body.mesh);
        if (all.size() % 3 == 0) body.mesh.normals.clear();
        add(body.name, std::move(body.mesh), all.size() % 4 ? Placement::middle : Placement::half);
    }
    add("teapot with boundaries", paper::teapot(5), Placement::middle, 40);
    add("spheres", paper::spheres(1), Placement::half, 42000);
    for (unsigned seed = 0; seed < 6; ++seed) {
        Mesh mesh = scaffold(seed);
        if (seed % 2) paint_by_place(mesh);
        add("bars " + std::to_string(seed), std::move(mesh), Placement::middle, 100 * seed);
    }
    Mesh disc = sphere(1, 3); // open where its top was
    std::erase_if(disc.triangles, [&](const Triangle& t) {
        return disc.positions[t[0]].z > 0.3 && disc.positions[t[1]].z > 0.3 && disc.positions[t[2]].z > 0.3;
    });
    add("bowl, with vertices that no triangle has", disc, Placement::middle, 10);
    all.push_back({"no collapse", tetrahedron(), {}});
    return all;
}

LoggedBody small_body() {
    LoggedBody body{"torus", torus(2, 0.6, 14, 8), {}};
    paint_by_place(body.mesh);
    body.log = shortest_edges(body.mesh, 40, Placement::middle).log;
    return body;
}

testing::AssertionResult same(const Mesh& a, const Mesh& b) {
    if (!equal(a.positions, b.positions)) return testing::AssertionFailure() << "other positions";
    if (!equal(a.colours, b.colours)) return testing::AssertionFailure() << "other colours";
    if (!equal(a.normals, b.normals)) return testing::AssertionFailure() << "other normals";
    if (!equal(a.triangles, b.triangles)) return testing::AssertionFailure() << "other triangles";
    return testing::AssertionSuccess();
}

} // namespace glcast::test
