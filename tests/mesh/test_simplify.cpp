#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/mesh/bodies.h"
#include "tests/mesh/independent_check/oracle.h"
#include "tools/deviation/deviation.h"
#include "tools/mesh/check.h"
#include "tools/simplify/simplify.h"

namespace glcast::test {
namespace {

using Unit = SimplifyTarget::Unit;

void expect_good(const Mesh& mesh, const std::string& what) {
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.closed_manifold()) << what;
    EXPECT_EQ(check.unused_vertices, 0U) << what;
    EXPECT_EQ(ask_oracle(mesh).fault, "") << what;
}

bool same(const Mesh& a, const Mesh& b) {
    const auto equal = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || !std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]));
    };
    return equal(a.positions, b.positions) && equal(a.normals, b.normals) && equal(a.colours, b.colours) &&
           equal(a.triangles, b.triangles);
}

double mean_distance(const Mesh& from, const Mesh& to) {
    DeviationOptions options;
    options.samples = 20'000;
    options.visible_only = false;
    return deviation(from, to, options).a_to_b.mean;
}

TEST(Simplify, KeepsEveryBodyAClosedManifoldDownToNothing) {
    for (const NamedBody& body : bodies())
        for (const double triangles : {1e9, 1000.0, 301.0, 100.0, 12.0, 4.0, 0.0}) {
            const Mesh level = simplify(body.mesh, {Unit::triangles, triangles}, {.refit = triangles < 200});
            const std::string what = body.name + " to " + std::to_string(int(triangles));
            expect_good(level, what);
            const MeshCheck check = check_mesh(level);
            EXPECT_EQ(check.euler, body.euler) << what; // no handle or part lost
            EXPECT_EQ(check.components, body.components) << what;
            EXPECT_GE(level.triangles.size(), 4 * body.components) << what;
        }
}

/// Nodes at the even cells of a grid, random bars between them: many handles and parts, and a manifold
/// always, as no two cells touch in an edge or a corner alone.
Mesh scaffold(std::mt19937& random, unsigned bars_of_eight) {
    constexpr int n = 7;
    std::vector<bool> cells(n * n * n);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t odd = i % n % 2 + i / n % n % 2 + i / n / n % 2;
        cells[i] = odd == 0 || (odd == 1 && random() % 8 < bars_of_eight);
    }
    return blocks(n, n, n, [&](int x, int y, int z) { return cells[std::size_t(x + n * (y + n * z))]; });
}

TEST(Simplify, KeepsRandomBodiesManifold) {
    std::mt19937 random(1);
    for (unsigned attempt = 0; attempt < 30; ++attempt) {
        const Mesh body = scaffold(random, 1 + attempt % 7);
        const MeshCheck before = check_mesh(body);
        ASSERT_TRUE(before.closed_manifold());
        for (const double ratio : {0.5, 0.0}) {
            const Mesh level = simplify(body, {Unit::ratio, ratio}, {.refit = attempt % 3 == 0});
            expect_good(level, "body " + std::to_string(attempt));
            EXPECT_EQ(check_mesh(level).euler, before.euler) << attempt;
            EXPECT_EQ(check_mesh(level).components, before.components) << attempt;
        }
    }
}

TEST(Simplify, ReachesTheLeastThatTheTopologyAllows) {
    for (const NamedBody& body : bodies()) {
        const bool all_spheres = body.euler == 2 * long(body.components);
        if (!all_spheres) continue;
        // One within another: a tetrahedron round one that is hardly smaller would cross it.
        const std::size_t most = body.name == "nested shells" ? 8 * body.components : 4 * body.components;
        const Mesh level = simplify(body.mesh, {Unit::triangles, 0});
        EXPECT_LE(level.triangles.size(), most) << body.name;
        EXPECT_EQ(check_mesh(level, CheckDepth::everything).self_intersections, 0U) << body.name;
    }
    // A torus needs 14 triangles (Möbius 1861); collapses alone need not find them.
    EXPECT_LE(simplify(torus(2, 0.6, 48, 24), {Unit::triangles, 0}).triangles.size(), 32U);
}

TEST(Simplify, MeetsTargetsExactlyOrJustBelow) {
    const Mesh mesh = sphere(1, 4); // 5120 triangles, 7680 edges
    struct Row {
        SimplifyTarget target;
        std::size_t triangles;
    };
    const Row rows[] = {
        {{Unit::triangles, 1000}, 1000}, {{Unit::triangles, 1001}, 1000}, {{Unit::triangles, 999.5}, 998},
        {{Unit::edges, 1500}, 1000},     {{Unit::edges, 1501}, 1000},     {{Unit::edges, 782}, 520},
        {{Unit::edges, 100}, 66},        {{Unit::ratio, 0.5}, 2560},      {{Unit::ratio, 0.0999}, 510},
        {{Unit::ratio, 1}, 5120},        {{Unit::edges, 7680}, 5120},     {{Unit::triangles, 5119}, 5118},
    };
    for (const Row& row : rows)
        EXPECT_EQ(simplify(mesh, row.target, {.refit = false}).triangles.size(), row.triangles)
            << row.target.value;
}

TEST(Simplify, LeavesAMeshAloneThatIsSmallEnough) {
    Mesh mesh = torus(2, 0.6, 24, 12);
    paint(mesh, [](const glm::dvec3& p) { return glm::vec3(p * 0.1 + 0.5); });
    EXPECT_TRUE(same(simplify(mesh, {Unit::ratio, 1}), mesh));
    EXPECT_TRUE(same(simplify(mesh, {Unit::triangles, 1e9}), mesh));
}

TEST(Simplify, GivesLevelsInTheOrderAskedAndAsIfAskedAlone) {
    const Mesh mesh = torus(2, 0.6, 48, 24);
    const SimplifyTarget targets[] = {
        {Unit::edges, 300}, {Unit::ratio, 1}, {Unit::edges, 1500}, {Unit::edges, 300}};
    const std::vector<Mesh> levels = simplify_levels(mesh, targets);
    ASSERT_EQ(levels.size(), 4U);
    for (std::size_t i = 0; i < levels.size(); ++i)
        EXPECT_TRUE(same(levels[i], simplify(mesh, targets[i]))) << i;
    EXPECT_TRUE(simplify_levels(mesh, {}).empty());
}

TEST(Simplify, IsDeterministic) {
    for (const NamedBody& body : bodies())
        EXPECT_TRUE(
            same(simplify(body.mesh, {Unit::triangles, 200}), simplify(body.mesh, {Unit::triangles, 200})))
            << body.name;
}

TEST(Simplify, KeepsACubeExact) {
    const Mesh mesh = cube(2, 20);
    for (const double triangles : {600.0, 100.0, 12.0}) {
        const Mesh level = simplify(mesh, {Unit::triangles, triangles});
        EXPECT_NEAR(check_mesh(level).volume, 8, 1e-9) << triangles;
        EXPECT_NEAR(check_mesh(level).area, 24, 1e-9) << triangles;
    }
    for (const glm::dvec3& p : simplify(mesh, {Unit::triangles, 12}).positions)
        EXPECT_NEAR(std::abs(p.x) + std::abs(p.y) + std::abs(p.z), 3, 1e-9); // the eight corners
}

TEST(Simplify, KeepsAPlateWithHolesExact) {
    const Mesh mesh = plate_with_holes(5);
    const MeshCheck before = check_mesh(mesh), after = check_mesh(simplify(mesh, {Unit::triangles, 120}));
    EXPECT_NEAR(after.volume, before.volume, 1e-6 * before.volume);
    EXPECT_NEAR(after.area, before.area, 1e-6 * before.area);
}

TEST(Simplify, StaysNearASphere) {
    // N triangles inscribed or not, the best mesh of a unit sphere has a mean error of some 1/N (measured
    // bound).
    const Mesh mesh = sphere(1, 5);
    for (const double triangles : {2000.0, 500.0, 100.0})
        EXPECT_LT(mean_distance(mesh, simplify(mesh, {Unit::triangles, triangles})), 2.5 / triangles)
            << triangles;
}

TEST(Simplify, DoesNotTurnTrianglesOver) {
    const Mesh level = simplify(sphere(1, 5), {Unit::triangles, 400});
    for (const Triangle& t : level.triangles) {
        const glm::dvec3 &a = level.positions[t[0]], &b = level.positions[t[1]], &c = level.positions[t[2]];
        EXPECT_GT(dot(normalize(cross(b - a, c - a)), normalize(a + b + c)), 0.8);
    }
}

TEST(Simplify, DoesNotDependOnSizeOrPlace) {
    Mesh far = sphere(1, 4);
    for (glm::dvec3& p : far.positions)
        p = p * 1024.0 + glm::dvec3(4096, -8192, 2048); // exact in binary, nearly
    const Mesh here = simplify(sphere(1, 4), {Unit::triangles, 200}),
               there = simplify(far, {Unit::triangles, 200});
    EXPECT_NEAR(check_mesh(there).volume / (1024. * 1024 * 1024), check_mesh(here).volume, 1e-2);
    ASSERT_EQ(here.triangles.size(), there.triangles.size());
}

TEST(Simplify, KeepsOneColourExactly) {
    const glm::vec3 colour(0.1F, 1.0F / 3, 0.7F);
    for (NamedBody& body : bodies()) {
        paint(body.mesh, [&](const glm::dvec3&) { return colour; });
        const Mesh level = simplify(body.mesh, {Unit::ratio, 0.1});
        ASSERT_EQ(level.colours.size(), level.positions.size());
        for (const glm::vec3& c : level.colours) EXPECT_EQ(c, colour) << body.name;
    }
}

TEST(Simplify, InventsNoColourAndKeepsEachOnItsSide) {
    Mesh mesh = sphere(1, 5);
    const glm::vec3 red(1, 0, 0), blue(0, 0, 1);
    paint(mesh, [&](const glm::dvec3& p) { return p.x < 0 ? red : blue; });
    const Mesh level = simplify(mesh, {Unit::triangles, 500});
    const double edge = 0.04; // of the original: a colour may come from so far off
    for (std::size_t i = 0; i < level.colours.size(); ++i) {
        EXPECT_TRUE(level.colours[i] == red || level.colours[i] == blue);
        if (level.positions[i].x < -edge) {
            EXPECT_EQ(level.colours[i], red);
        }
        if (level.positions[i].x > edge) {
            EXPECT_EQ(level.colours[i], blue);
        }
    }
}

TEST(Simplify, NeverTakesTheColourOfTheOtherSide) {
    Mesh outer = sphere(1, 5),
         inner = turned_inside_out(sphere(0.999, 5)); // far thinner than a coarse triangle is off
    paint(outer, [](const glm::dvec3&) { return glm::vec3(1, 0, 0); });
    paint(inner, [](const glm::dvec3&) { return glm::vec3(0, 1, 0); });
    const Mesh level = simplify(joined(std::move(outer), inner), {Unit::triangles, 200});
    ASSERT_EQ(level.colours.size(), level.positions.size());
    for (const Triangle& t : level.triangles) {
        EXPECT_EQ(level.colours[t[0]], level.colours[t[1]]);
        EXPECT_EQ(level.colours[t[1]], level.colours[t[2]]);
    }
    for (std::size_t i = 0; i < level.colours.size(); ++i)
        EXPECT_GT(dot(level.normals[i], glm::vec3(level.positions[i])) * (level.colours[i].r > 0 ? 1 : -1),
                  0.9F);
}

TEST(Simplify, NormalsFollowTheSurface) {
    const Mesh level = simplify(sphere(2, 5), {Unit::triangles, 500});
    ASSERT_EQ(level.normals.size(), level.positions.size());
    for (std::size_t i = 0; i < level.normals.size(); ++i) {
        EXPECT_NEAR(glm::length(level.normals[i]), 1, 1e-5);
        EXPECT_GT(dot(glm::dvec3(level.normals[i]), normalize(level.positions[i])),
                  std::cos(1 * std::numbers::pi / 180));
    }
}

TEST(Simplify, NormalsThatFaceInwardDoNotMoveTheSurface) { // those of what lies behind a closed slit
    const Mesh body = sphere(1, 5);
    ASSERT_FALSE(body.normals.empty());
    Mesh banded = body;
    for (std::size_t v = 0; v < banded.normals.size(); ++v)
        if (std::abs(banded.positions[v].z - 0.4) < 0.04) banded.normals[v] = -banded.normals[v];
    for (const double triangles : {2000.0, 500.0}) {
        Mesh level = simplify(banded, {Unit::triangles, triangles}),
             plain = simplify(body, {Unit::triangles, triangles});
        level.normals = plain.normals = {};
        EXPECT_TRUE(same(level, plain)) << triangles;
    }
}

TEST(Simplify, NeedsNeitherColoursNorNormals) {
    Mesh mesh = torus(2, 0.6, 24, 12);
    mesh.normals.clear();
    const Mesh level = simplify(mesh, {Unit::triangles, 100});
    EXPECT_TRUE(level.normals.empty());
    EXPECT_TRUE(level.colours.empty());
}

/// Half a sphere, z >= 0; its boundary is the circle z = 0.
Mesh bowl(int subdivisions) {
    Mesh mesh = sphere(1, subdivisions), half;
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.positions[t[0]].z + mesh.positions[t[1]].z + mesh.positions[t[2]].z < 0;
    });
    std::vector<std::uint32_t> number(mesh.positions.size(), UINT32_MAX);
    for (Triangle t : mesh.triangles) {
        for (std::uint32_t& v : t) {
            if (number[v] == UINT32_MAX) {
                number[v] = std::uint32_t(half.positions.size());
                half.positions.push_back(mesh.positions[v]);
            }
            v = number[v];
        }
        half.triangles.push_back(t);
    }
    return half;
}

TEST(Simplify, BoundariesStayWhereTheyAre) {
    const Mesh mesh = bowl(5);
    const std::size_t edges = 300;
    for (const bool refit : {false, true}) {
        const Mesh level =
            simplify(mesh, {Unit::edges, double(edges)}, {.allow_boundaries = true, .refit = refit});
        const MeshCheck check = check_mesh(level);
        EXPECT_EQ(check.non_manifold_edges + check.non_manifold_vertices, 0U);
        EXPECT_LE(check.edges, edges);
        EXPECT_GE(check.edges, edges - 3);
        EXPECT_EQ(check.euler, 1); // still a disc
        EXPECT_LT(mean_distance(mesh, level), 0.012);
        EXPECT_LT(mean_distance(level, mesh), 0.012);
    }
    EXPECT_THROW(simplify(mesh, {Unit::edges, 300}), std::runtime_error);
}

TEST(Simplify, TheFitLessensTheErrorAndFoldsNothing) {
    const Mesh bodies[] = {sphere(1, 5), torus(2, 0.6, 96, 48),
                           joined(sphere(1, 5), turned_inside_out(sphere(0.98, 5)))};
    for (const Mesh& body : bodies)
        for (const double triangles : {800.0, 200.0}) {
            const Mesh plain = simplify(body, {Unit::triangles, triangles}, {.refit = false}),
                       fitted = simplify(body, {Unit::triangles, triangles});
            expect_good(fitted, "fitted");
            EXPECT_EQ(fitted.triangles.size(), plain.triangles.size());
            EXPECT_LT(mean_distance(body, fitted), 0.8 * mean_distance(body, plain))
                << triangles << " of " << body.triangles.size();
            EXPECT_LT(mean_distance(fitted, body), 1.0 * mean_distance(plain, body)) << triangles;
        }
}

TEST(Simplify, RefusesWhatIsNotClosedOrMakesNoSense) {
    Mesh open = sphere(1, 2);
    open.triangles.pop_back();
    EXPECT_THROW(simplify(open, {Unit::triangles, 10}), std::runtime_error);
    EXPECT_THROW(simplify(Mesh{}, {Unit::triangles, 10}), std::runtime_error);
    EXPECT_THROW(simplify(sphere(1, 1), {Unit::triangles, -1}), std::runtime_error);
    EXPECT_THROW(simplify(sphere(1, 1), {Unit::ratio, 1.5}), std::runtime_error);
    EXPECT_THROW(simplify(sphere(1, 1), {Unit::edges, std::nan("")}), std::runtime_error);
}

TEST(Simplify, TakesTrianglesWithoutArea) {
    Mesh mesh = cube(1, 8);
    for (glm::dvec3& p : mesh.positions)
        if (p.x > 0.2 && p.x < 0.4) p.x = 0.5; // a row of squares folded flat
    const Mesh level = simplify(mesh, {Unit::triangles, 40});
    expect_good(level, "folded cube");
    EXPECT_EQ(level.triangles.size(), 40U);
    EXPECT_NEAR(check_mesh(level).volume, check_mesh(mesh).volume, 0.02);
}

} // namespace
} // namespace glcast::test
