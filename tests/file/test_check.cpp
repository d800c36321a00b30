// check_mesh against surfaces whose numbers are known by hand.
#include <gtest/gtest.h>

#include <chrono>

#include "tests/file/sample_meshes.h"
#include "tools/mesh/check.h"

using namespace glcast;
using namespace glcast::samples;

TEST(CheckMesh, TetrahedronIsClosed) {
    const MeshCheck c = check_mesh(tetrahedron());
    EXPECT_TRUE(c.closed_manifold());
    EXPECT_EQ(c.vertices, 4u);
    EXPECT_EQ(c.edges, 6u);
    EXPECT_EQ(c.euler, 2);
    EXPECT_EQ(c.components, 1u);
    EXPECT_NEAR(c.volume, 1.0 / 6, 1e-12);
    EXPECT_NEAR(c.area, 1.5 + std::sqrt(3.0) / 2, 1e-12);
    EXPECT_EQ(describe(c), "closed two-manifold");
}

TEST(CheckMesh, TorusHasEulerZero) {
    const MeshCheck c = check_mesh(torus(40, 30));
    EXPECT_TRUE(c.closed_manifold());
    EXPECT_EQ(c.euler, 0);
    EXPECT_NEAR(c.volume, 2 * M_PI * M_PI * 1 * 0.25 * 0.25, 0.02);
    EXPECT_GT(c.volume, 0);
}

TEST(CheckMesh, InsideOutHasNegativeVolume) {
    Mesh m = tetrahedron();
    for (Triangle& t : m.triangles) std::swap(t[0], t[1]);
    const MeshCheck c = check_mesh(m);
    EXPECT_TRUE(c.closed_manifold());
    EXPECT_LT(c.volume, 0);
}

TEST(CheckMesh, FarFromTheOriginKeepsTheVolume) {
    Mesh m = tetrahedron();
    for (auto& p : m.positions) p += glm::dvec3(1e6, -2e6, 3e6);
    EXPECT_NEAR(check_mesh(m).volume, 1.0 / 6, 1e-8);
}

TEST(CheckMesh, MissingTriangle) {
    Mesh m = tetrahedron();
    m.triangles.pop_back();
    const MeshCheck c = check_mesh(m);
    EXPECT_FALSE(c.closed_manifold());
    EXPECT_EQ(c.boundary_edges, 3u);
    EXPECT_EQ(c.non_manifold_edges, 0u);
    EXPECT_EQ(c.non_manifold_vertices, 0u) << "open fans are fans";
    EXPECT_EQ(c.euler, 1);
    EXPECT_EQ(describe(c), "3 boundary edges");
}

TEST(CheckMesh, FlippedTriangle) {
    Mesh m = tetrahedron();
    std::swap(m.triangles[0][0], m.triangles[0][1]);
    const MeshCheck c = check_mesh(m);
    EXPECT_EQ(c.non_manifold_edges, 3u);
    EXPECT_FALSE(c.closed_manifold());
}

TEST(CheckMesh, TwoSolidsThatShareAVertex) {
    const Mesh m = joined(tetrahedron(), tetrahedron(), {{0, 0}});
    const MeshCheck c = check_mesh(m);
    EXPECT_EQ(c.boundary_edges, 0u);
    EXPECT_EQ(c.non_manifold_edges, 0u);
    EXPECT_EQ(c.non_manifold_vertices, 1u);
    EXPECT_EQ(c.components, 1u);
    EXPECT_FALSE(c.closed_manifold());
}

TEST(CheckMesh, TwoSolidsThatShareAnEdge) {
    const Mesh m = joined(tetrahedron(), tetrahedron(), {{0, 0}, {1, 1}});
    const MeshCheck c = check_mesh(m);
    EXPECT_EQ(c.non_manifold_edges, 1u);
    EXPECT_EQ(c.edges, 11u);
    EXPECT_FALSE(c.closed_manifold());
}

TEST(CheckMesh, TwoSolidsApart) {
    const Mesh m = joined(tetrahedron(), torus(12, 9), {});
    const MeshCheck c = check_mesh(m);
    EXPECT_TRUE(c.closed_manifold());
    EXPECT_EQ(c.components, 2u);
    EXPECT_EQ(c.euler, 2);
}

TEST(CheckMesh, DoubledTriangleAndBadCorners) {
    Mesh m = tetrahedron();
    m.triangles.push_back(m.triangles[0]);
    EXPECT_EQ(check_mesh(m).non_manifold_edges, 3u);
    m = tetrahedron();
    m.triangles.push_back({0, 0, 1});
    m.triangles.push_back({0, 1, 99});
    m.positions.emplace_back(7);
    const MeshCheck c = check_mesh(m);
    EXPECT_EQ(c.degenerate_triangles, 2u);
    EXPECT_EQ(c.unused_vertices, 1u);
    EXPECT_EQ(c.euler, 2);
    EXPECT_FALSE(c.closed_manifold());
}

TEST(CheckMesh, NothingIsNotClosed) { EXPECT_FALSE(check_mesh(Mesh{}).closed_manifold()); }

TEST(CheckMesh, ManyTrianglesAreQuick) {
    const Mesh m = torus(500, 400);
    const auto start = std::chrono::steady_clock::now();
    const MeshCheck c = check_mesh(m);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_TRUE(c.closed_manifold());
    EXPECT_EQ(c.triangles, 400000u);
    EXPECT_LT(seconds, 20) << "sanitizers and busy machines included";
    RecordProperty("seconds", std::to_string(seconds));
}
