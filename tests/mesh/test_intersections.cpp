// Where a mesh passes through itself: exact, and of one opinion with CGAL.
#include <cmath>
#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <random>
#include <tbb/global_control.h>

#include "tests/mesh/bodies.h"
#include "tests/mesh/independent_check/cgal.h"
#include "tools/mesh/predicates.h"
#include "tools/mesh/triangle_contact.h"

namespace glcast::test {
namespace {

using Pairs = std::vector<TrianglePair>;

Pairs ours(const Mesh& mesh) { return find_self_intersections(mesh.positions, mesh.triangles); }

bool has_area(const Mesh& mesh, const Triangle& t) {
    const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    return orient2d(a, b, c, 0) || orient2d(a, b, c, 1) || orient2d(a, b, c, 2);
}

TEST(Predicates, AreExactWhereDoublesAreNot) {
    const double tiny = std::ldexp(1.0, -50);
    const glm::dvec3 a(12, 12, 12), b(24, 24, 24);
    for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j)
            EXPECT_EQ(orient2d(a, b, {0.5 + i * tiny, 0.5 + j * tiny, 0}, 2), (j > i) - (j < i));
    std::mt19937 random(1);
    std::uniform_int_distribution<int> whole(-1000, 1000);
    for (int k = 0; k < 2000;
         ++k) { // points in a plane, moved off it by less than doubles resolve in products
        const auto point = [&] { return glm::dvec3(whole(random), whole(random), 0) / 1024.0; };
        const auto tilted = [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 4 + p.x + p.y); };
        const glm::dvec3 p = tilted(point()), q = tilted(point()), r = tilted(point());
        glm::dvec3 s = tilted(point());
        EXPECT_EQ(orient3d(p, q, r, s), 0);
        const int turn = orient2d(p, q, r, 2);
        s.z = std::nextafter(s.z, 1e9);
        EXPECT_EQ(orient3d(p, q, r, s), turn);
        EXPECT_EQ(orient3d(q, p, r, s), -turn);
    }
}

TEST(Predicates, AreAntisymmetric) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int k = 0; k < 5000; ++k) {
        glm::dvec3 p[4];
        for (auto& q : p) q = {unit(random), unit(random), unit(random)};
        p[3] = p[0] + (p[1] - p[0]) * unit(random) + (p[2] - p[0]) * unit(random); // nearly in the plane
        const int sign = orient3d(p[0], p[1], p[2], p[3]);
        EXPECT_EQ(orient3d(p[1], p[2], p[3], p[0]), -sign);
        EXPECT_EQ(orient3d(p[2], p[1], p[0], p[3]), -sign);
        EXPECT_EQ(orient3d(p[2], p[3], p[0], p[1]), sign);
    }
}

/// Triangles with whole coordinates in 0..reach: contacts of every degenerate kind. `joined`: common
/// vertices.
TEST(Intersections, PairsAgreeWithCgal) {
    std::mt19937 random(3);
    int met = 0, apart = 0;
    for (int trial = 0; trial < 30000; ++trial) {
        const int reach = 1 + trial % 4, joined = trial / 4 % 3;
        std::uniform_int_distribution<int> whole(0, reach);
        Mesh mesh;
        for (int k = 0; k < 6 - joined; ++k)
            mesh.positions.emplace_back(whole(random), whole(random), trial % 7 == 0 ? 0 : whole(random));
        mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
        if (joined == 1) mesh.triangles[1] = {0, 3, 4};
        if (joined == 2) mesh.triangles[1] = {1, 0, 3};
        if (!has_area(mesh, mesh.triangles[0]) || !has_area(mesh, mesh.triangles[1])) continue;
        const bool meet = triangles_meet(mesh.positions, mesh.triangles[0], mesh.triangles[1]);
        EXPECT_EQ(meet, triangles_meet(mesh.positions, mesh.triangles[1], mesh.triangles[0])) << trial;
        ASSERT_EQ(meet, !cgal_self_intersections(mesh).empty()) << trial;
        ++(meet ? met : apart);
    }
    EXPECT_GT(met, 3000);
    EXPECT_GT(apart, 3000);
}

TEST(Intersections, SoupsAgreeWithCgal) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 40; ++trial) {
        std::uniform_real_distribution<double> unit(0, 1);
        const bool whole = trial % 2;
        const double size = whole ? 3 : std::pow(10.0, -0.5 * (trial % 6));
        Mesh mesh;
        for (std::uint32_t t = 0; t < 400; ++t) {
            const glm::dvec3 at(10 * unit(random), 10 * unit(random), 10 * unit(random));
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 p = at + size * glm::dvec3(unit(random), unit(random), unit(random));
                mesh.positions.push_back(whole ? glm::round(p) : p);
            }
            mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
            if (!has_area(mesh, mesh.triangles.back())) mesh.triangles.pop_back();
        }
        const Pairs pairs = ours(mesh);
        EXPECT_EQ(pairs, cgal_self_intersections(mesh)) << trial;
        EXPECT_EQ(pairs.size(), count_self_intersections(mesh.positions, mesh.triangles));
    }
}

TEST(Intersections, DentedSurfacesAgreeWithCgal) {
    std::mt19937 random(5);
    std::normal_distribution<double> any;
    for (double dent : {0.0, 0.01, 0.05}) {
        Mesh mesh = joined(sphere(1, 4), torus(1.3, 0.5, 40, 30));
        for (glm::dvec3& p : mesh.positions) p += dent * glm::dvec3(any(random), any(random), any(random));
        const Pairs pairs = ours(mesh);
        EXPECT_GT(pairs.size(), 50u);
        EXPECT_EQ(pairs, cgal_self_intersections(mesh)) << dent;
    }
}

TEST(Intersections, BodiesThatTouchNothingHaveNone) {
    for (const Mesh& mesh :
         {tetrahedron(), cube(2, 8), sphere(1, 4), torus(2, 0.5, 40, 30), plate_with_holes(3)})
        EXPECT_TRUE(ours(mesh).empty());
    const Mesh apart = joined(sphere(1, 3), sphere(1, 3, {2.0001, 0, 0}));
    EXPECT_TRUE(ours(apart).empty());
    EXPECT_FALSE(ours(joined(sphere(1, 3), sphere(1, 3, {2, 0, 0}))).empty()); // in one point
    EXPECT_FALSE(ours(joined(cube(1, 2), cube(1, 2))).empty());                // on one another
}

TEST(Intersections, TrianglesWithoutAreaAndWithoutCornersDoNoHarm) {
    Mesh mesh = tetrahedron();
    const std::uint32_t last = std::uint32_t(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[0]);
    mesh.positions.push_back(mesh.positions[0]);
    mesh.triangles.push_back({last, last + 1, 1000});
    mesh.triangles.push_back({0, 0, 1});
    EXPECT_TRUE(ours(mesh).empty());
    mesh.triangles.push_back({last, last + 1, 1}); // a line along an edge
    EXPECT_FALSE(ours(mesh).empty());
    EXPECT_TRUE(find_self_intersections({}, {}).empty());
}

TEST(Intersections, OfSomeTrianglesAreThoseOfTheWhole) {
    const Mesh mesh = joined(sphere(1, 4), sphere(1, 4, {0.7, 0.1, 0.2}));
    const Pairs whole = ours(mesh);
    std::vector<std::uint32_t> all, probes;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        all.push_back(t);
        if (t % 5 < 2) probes.push_back(t);
    }
    Pairs wanted;
    for (const auto& [a, b] : whole)
        if (a % 5 < 2 || b % 5 < 2) wanted.emplace_back(a, b);
    EXPECT_EQ(find_intersections_of(mesh.positions, mesh.triangles, probes, all), wanted);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(ours(mesh), whole);
}

} // namespace
} // namespace glcast::test
