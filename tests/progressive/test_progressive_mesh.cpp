// A progressive mesh is every level of the run of collapses that it was made of.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "tests/mesh/bodies.h"
#include "tests/progressive/bodies.h"
#include "tools/mesh/check.h"
#include "tools/progressive/order.h"
#include "tools/progressive/progressive_mesh.h"
#include "tools/simplify/simplify.h"

namespace glcast::test {
namespace {

std::set<std::size_t> some_levels(std::size_t splits) {
    std::set<std::size_t> levels{0, splits, splits / 2, splits / 3};
    for (std::size_t k : {1, 2, 3, 7, 50})
        levels.insert(std::min(k, splits)), levels.insert(splits - std::min(k, splits));
    return levels;
}

TEST(ProgressiveMesh, IsTheMeshOfEveryLevelBitForBit) {
    for (const LoggedBody& body : logged_bodies()) {
        ProgressiveMesh mesh(body.mesh, body.log);
        ASSERT_EQ(mesh.splits(), body.log.size()) << body.name;
        for (const std::size_t level : some_levels(mesh.splits())) {
            mesh.refine_to(level);
            EXPECT_TRUE(same(mesh.mesh(), collapsed(body.mesh, body.log, body.log.size() - level)))
                << body.name << ", level " << level;
        }
        mesh.refine_to(mesh.splits());
        EXPECT_TRUE(same(mesh.mesh(), body.mesh)) << body.name;
    }
}

TEST(ProgressiveMesh, IsWhatTheCollapserHadAtEveryStep) {
    const Mesh body = small_body().mesh;
    const Collapses run = shortest_edges(body, 20, Placement::middle, 5, 1);
    ASSERT_GT(run.log.size(), 80u);
    ProgressiveMesh mesh(body, run.log);
    for (std::size_t level = 0; level <= mesh.splits(); ++level) {
        mesh.refine_to(level);
        ASSERT_TRUE(same(mesh.mesh(), run.meshes[run.log.size() - level])) << level;
    }
}

/// The whole road: levels of glcast's own simplification are levels of the progressive mesh made of its log.
TEST(ProgressiveMesh, IsEveryLevelOfGlcastsOwnRun) {
    for (LoggedBody& body : logged_bodies()) {
        if (!check_mesh(body.mesh).closed_manifold()) continue;
        for (glm::vec3& n : body.mesh.normals)
            n = glm::normalize(n + glm::vec3(0.01f, 0.02f, 0.03f)); // rounded normals
        std::vector<SimplifyTarget> targets;
        for (const double ratio : {0.9, 0.5, 0.25, 0.1, 0.01})
            targets.push_back(
                {SimplifyTarget::Unit::triangles, std::floor(ratio * double(body.mesh.triangles.size()))});
        CollapseLog log;
        const std::vector<Mesh> levels = simplify_levels(body.mesh, targets, {.refit = false}, &log);
        ProgressiveMesh mesh(body.mesh, log);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            mesh.refine_to(mesh.level_of_triangles(std::size_t(targets[k].value)));
            EXPECT_TRUE(same(mesh.mesh(), levels[k])) << body.name << " to " << targets[k].value;
        }
    }
}

TEST(ProgressiveMesh, WalksForwardAndBack) {
    std::mt19937 random(4);
    const LoggedBody body = small_body();
    ProgressiveMesh mesh(body.mesh, body.log);
    for (int k = 0; k < 300; ++k) {
        const std::size_t level = random() % (mesh.splits() + 1);
        mesh.refine_to(level);
        ASSERT_EQ(mesh.level(), level);
        ASSERT_TRUE(same(mesh.mesh(), collapsed(body.mesh, body.log, body.log.size() - level))) << level;
    }
}

TEST(ProgressiveMesh, CountsAsTheCheckDoes) {
    for (const LoggedBody& body : logged_bodies()) {
        ProgressiveMesh mesh(body.mesh, body.log);
        for (const std::size_t level : some_levels(mesh.splits())) {
            mesh.refine_to(level);
            const MeshCheck check = check_mesh(mesh.mesh());
            EXPECT_EQ(mesh.edges(level), check.edges) << body.name << ", level " << level;
            EXPECT_EQ(mesh.triangles(level), check.triangles) << body.name;
            EXPECT_EQ(mesh.vertices(level), check.vertices) << body.name;
        }
    }
}

TEST(ProgressiveMesh, FindsTheFinestLevelWithinACount) {
    const LoggedBody body = small_body();
    const ProgressiveMesh mesh(body.mesh, body.log);
    for (std::size_t most = 0; most < 400; ++most) {
        std::size_t vertices = 0, edges = 0, triangles = 0; // by trying all
        for (std::size_t level = 1; level <= mesh.splits(); ++level) {
            if (mesh.vertices(level) <= most) vertices = level;
            if (mesh.edges(level) <= most) edges = level;
            if (mesh.triangles(level) <= most) triangles = level;
        }
        ASSERT_EQ(mesh.level_of_vertices(most), vertices) << most;
        ASSERT_EQ(mesh.level_of_edges(most), edges) << most;
        ASSERT_EQ(mesh.level_of_triangles(most), triangles) << most;
    }
}

TEST(ProgressiveMesh, RefusesALogOfAnotherMesh) {
    const Mesh mesh = tetrahedron();
    const auto refuses = [&](const CollapseLog& log) {
        EXPECT_THROW(ProgressiveMesh(mesh, log), std::runtime_error);
        EXPECT_THROW(collapsed(mesh, log, log.size()), std::runtime_error) << "as the other does";
    };
    refuses({{0, 0}});
    refuses({{0, 4}});
    refuses({{7, 0}});
    refuses({{0, 1}, {0, 1}});
    refuses({{0, 1}, {1, 2}});
    Mesh two = joined(mesh, mesh);
    EXPECT_THROW(ProgressiveMesh(two, CollapseLog{{0, 5}}), std::runtime_error);
    two.triangles[0][0] = 99;
    EXPECT_THROW(ProgressiveMesh(two, CollapseLog{}), std::runtime_error);
}

TEST(ProgressiveMesh, TakesTheMemoryThatItSays) {
    Mesh mesh = sphere(1, 5);
    paint(mesh, [](const glm::dvec3& p) { return glm::vec3(0.5 + 0.5 * p); });
    const CollapseLog log = shortest_edges(mesh, 100, Placement::middle).log;
    const double all = double(mesh.positions.size());
    EXPECT_LT(double(ProgressiveMesh(mesh, log).bytes()) / all, 160);
    mesh.colours.clear(), mesh.normals.clear();
    EXPECT_LT(double(ProgressiveMesh(mesh, log).bytes()) / all, 112);
}

TEST(Order, SortsAsTheLibraryDoes) {
    std::mt19937 random(2);
    for (const std::uint32_t range : {1u, 2u, 2048u, 5'000'000u, UINT32_MAX}) {
        std::vector<std::uint32_t> keys(3000), expected(keys.size());
        for (std::uint32_t& key : keys) key = std::uint32_t(random()) % range;
        keys[17] = range - 1, keys[18] = 0;
        std::iota(expected.begin(), expected.end(), 0u);
        std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
        EXPECT_EQ(progressive::order_of(keys), expected) << range;
    }
    EXPECT_TRUE(progressive::order_of({}).empty());
}

} // namespace
} // namespace glcast::test
