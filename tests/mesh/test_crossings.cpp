// Levels do not pass through themselves; and the guard that sees to it is never of a better opinion than
// CGAL.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "tests/mesh/bodies.h"
#include "tests/mesh/independent_check/cgal.h"
#include "tools/simplify/crossing_guard.h"
#include "tools/simplify/simplify.h"

namespace glcast::test {
namespace {

using Unit = SimplifyTarget::Unit;

CrossingGuard::Surface surface_of(const Mesh& mesh) {
    return {mesh.positions, {mesh.triangles[0].data(), 3 * mesh.triangles.size()}};
}

SurfaceChange move_of(const Mesh& mesh, std::uint32_t v, const glm::dvec3& to) {
    SurfaceChange change;
    change.moved = v;
    change.to = to;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (std::set<std::uint32_t>(mesh.triangles[t].begin(), mesh.triangles[t].end()).contains(v)) {
            change.replaced.push_back(t);
            change.made.push_back(mesh.triangles[t]);
        }
    return change;
}

Mesh shell() { return joined(sphere(1, 4), turned_inside_out(sphere(0.98, 4))); }

/// Vertices are thrown about; what the guard lets pass is done, and CGAL looks at all of it.
TEST(CrossingGuard, LetsNothingPassThatCgalFinds) {
    const Mesh bodies[] = {joined(sphere(1, 2), turned_inside_out(sphere(0.9, 2))), torus(1, 0.3, 16, 8),
                           cube(1, 4), plate_with_holes(2)};
    std::mt19937 random(1);
    std::normal_distribution<double> any;
    for (Mesh mesh : bodies) {
        ASSERT_TRUE(cgal_self_intersections(mesh).empty());
        CrossingGuard guard(surface_of(mesh), true);
        int passed = 0, refused = 0;
        for (int trial = 0; trial < 800; ++trial) {
            const auto v = std::uint32_t(random() % mesh.positions.size());
            const double far = trial % 3 ? 0.05 : 0.4;
            const glm::dvec3 from = mesh.positions[v],
                             to = from + far * glm::dvec3(any(random), any(random), any(random));
            const SurfaceChange change = move_of(mesh, v, to);
            const bool crosses = guard.crosses(surface_of(mesh), change);
            mesh.positions[v] = to;
            const bool found = !cgal_self_intersections(mesh).empty();
            EXPECT_TRUE(crosses || !found) << trial;
            // Nothing here is nearer than rounding: then they are of one opinion.
            EXPECT_EQ(crosses, found) << trial;
            ++(crosses ? refused : passed);
            if (crosses)
                mesh.positions[v] = from;
            else
                guard.made_it(surface_of(mesh), change);
        }
        EXPECT_GT(passed, 50);
        EXPECT_GT(refused, 50);
    }
}

/// The same where the surface has boundaries: there the quick answers do not hold.
TEST(CrossingGuard, KnowsSurfacesWithBoundaries) {
    Mesh mesh = joined(sphere(1, 2), sphere(0.9, 2)); // both face outwards, and are open
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.positions[t[0]].z > 0.5; });
    std::mt19937 random(2);
    std::normal_distribution<double> any;
    CrossingGuard guard(surface_of(mesh), false);
    int refused = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const auto v = std::uint32_t(random() % mesh.positions.size());
        const glm::dvec3 from = mesh.positions[v],
                         to = from + 0.1 * glm::dvec3(any(random), any(random), any(random));
        const SurfaceChange change = move_of(mesh, v, to);
        if (change.made.empty()) continue;
        const bool crosses = guard.crosses(surface_of(mesh), change);
        mesh.positions[v] = to;
        EXPECT_EQ(crosses, !cgal_self_intersections(mesh).empty()) << trial;
        refused += crosses;
        if (crosses)
            mesh.positions[v] = from;
        else
            guard.made_it(surface_of(mesh), change);
    }
    EXPECT_GT(refused, 100);
}

TEST(CrossingGuard, DoesNotCountWhatCrossedAlready) {
    Mesh mesh = joined(sphere(1, 3), sphere(1, 3, {0.5, 0.1, 0.2}));
    const auto pairs = cgal_self_intersections(mesh);
    ASSERT_FALSE(pairs.empty());
    CrossingGuard guard(surface_of(mesh), true);
    for (const auto& [one, other] : pairs) {
        const std::uint32_t v = mesh.triangles[one][0];
        EXPECT_FALSE(guard.crosses(surface_of(mesh), move_of(mesh, v, mesh.positions[v])));
    }
}

TEST(Crossings, LevelsOfThinWallsHaveNone) {
    for (const Mesh& body : {shell(), plate_with_holes(5), torus(2, 0.6, 96, 48)})
        for (const bool refit : {false, true}) {
            const SimplifyTarget targets[] = {
                {Unit::triangles, 2500}, {Unit::triangles, 1200}, {Unit::triangles, 600}};
            for (const Mesh& level : simplify_levels(body, targets, {.refit = refit}))
                EXPECT_EQ(cgal_self_intersections(level).size(), 0U)
                    << level.triangles.size() << (refit ? ", fitted" : "");
        }
}

TEST(Crossings, ASurfaceThatCrossesItselfIsSimplifiedAllTheSame) {
    const Mesh mesh = joined(sphere(1, 4), sphere(1, 4, {0.5, 0.1, 0.2}));
    ASSERT_FALSE(cgal_self_intersections(mesh).empty());
    for (const bool refit : {false, true})
        EXPECT_EQ(simplify(mesh, {Unit::triangles, 400}, {.refit = refit}).triangles.size(), 400U);
}

} // namespace
} // namespace glcast::test
