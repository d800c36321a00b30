// Between two levels of a progressive mesh: closed forms at both ends and in the middle.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/progressive/bodies.h"
#include "tools/progressive/geomorph.h"

namespace glcast::test {
namespace {

/// What is left of a mesh when vertices at one ancestor are one: triangles that keep three corners.
Mesh folded(const Mesh& mesh, const std::vector<std::uint32_t>& ancestors, const Mesh& coarse) {
    Mesh out = coarse;
    out.triangles.clear();
    for (const Triangle& t : mesh.triangles) {
        const Triangle to{ancestors[t[0]], ancestors[t[1]], ancestors[t[2]]};
        if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0]) out.triangles.push_back(to);
    }
    return out;
}

TEST(Geomorph, EndsAreTheTwoLevels) {
    for (const LoggedBody& body : logged_bodies()) {
        ProgressiveMesh mesh(body.mesh, body.log);
        const std::size_t n = mesh.splits();
        mesh.refine_to(n / 5);
        for (const auto& [low, high] :
             {std::pair{n / 4, n}, {std::size_t(0), n / 2}, {n / 3, n / 3}, {std::size_t(0), n}}) {
            const Geomorph morph(mesh, low, high);
            EXPECT_EQ(mesh.level(), n / 5) << "comes back";
            const Mesh coarse = collapsed(body.mesh, body.log, n - low), start = morph.at(0);
            EXPECT_TRUE(same(morph.at(1), collapsed(body.mesh, body.log, n - high))) << body.name;
            ASSERT_EQ(start.triangles.size(), mesh.triangles(high));
            EXPECT_TRUE(same(folded(start, morph.ancestors(), coarse), coarse))
                << body.name << ": the same triangles";
            for (std::size_t v = 0; v < start.positions.size();
                 ++v) { // in the same place, with the same look
                const std::uint32_t a = morph.ancestors()[v];
                ASSERT_EQ(start.positions[v], coarse.positions[a]);
                if (!start.colours.empty()) {
                    ASSERT_EQ(start.colours[v], coarse.colours[a]);
                }
                if (!start.normals.empty()) {
                    ASSERT_EQ(start.normals[v], coarse.normals[a]);
                }
            }
        }
    }
}

/// A square in the plane z = 0, one vertex of which is split: everything by hand.
TEST(Geomorph, MiddleInClosedForm) {
    Mesh fine;
    fine.positions = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 8}};
    fine.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    for (int v = 0; v < 5; ++v) fine.colours.emplace_back(v * 0.25f), fine.normals.emplace_back(0, 0, 1);
    const CollapseLog log{
        {0, 4, {-1, -2, -3}, {1, 0, 0}, {1, 0, 0}}}; // the tip goes into a corner, which moves
    ProgressiveMesh mesh(fine, log);
    EXPECT_EQ(mesh.triangles(0), 2u);
    const Geomorph morph(mesh, 0, 1);
    const Mesh quarter = morph.at(0.25), none = morph.at(0);
    EXPECT_EQ(morph.ancestors(), (std::vector<std::uint32_t>{0, 1, 2, 3, 0}));
    EXPECT_EQ(none.positions[4], glm::dvec3(-1, -2, -3));
    EXPECT_EQ(quarter.positions[0], glm::dvec3(-0.75, -1.5, -2.25));
    EXPECT_EQ(quarter.positions[4], glm::dvec3(-0.25, -1, -0.25)); // 3/4 (-1, -2, -3) + 1/4 (2, 2, 8)
    EXPECT_EQ(quarter.positions[2], fine.positions[2]);
    EXPECT_EQ(quarter.colours[4], glm::vec3(1, 0.25f, 0.25f)); // 3/4 (1, 0, 0) + 1/4 (1, 1, 1)
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.75, 0, 0.25));
    EXPECT_LT(glm::length(glm::dvec3(quarter.normals[4]) - n), 1e-7);
    EXPECT_EQ(quarter.triangles, fine.triangles);
}

TEST(Geomorph, MovesEveryVertexAlongAStraightLineEvenly) {
    const LoggedBody body = small_body();
    ProgressiveMesh mesh(body.mesh, body.log);
    const Geomorph morph(mesh, 5, mesh.splits() - 5);
    const Mesh start = morph.at(0), end = morph.at(1);
    for (const double fraction : {0.01, 0.3, 0.5, 0.99}) {
        const Mesh mid = morph.at(fraction);
        for (std::size_t v = 0; v < mid.positions.size(); ++v) {
            const glm::dvec3 expected =
                start.positions[v] + fraction * (end.positions[v] - start.positions[v]);
            ASSERT_LT(glm::length(mid.positions[v] - expected), 1e-14);
            ASSERT_NEAR(glm::length(mid.normals[v]), 1, 1e-6);
            ASSERT_LE(std::abs(mid.colours[v].x -
                               (start.colours[v].x * (1 - fraction) + end.colours[v].x * fraction)),
                      1e-6);
        }
    }
}

TEST(Geomorph, OppositeNormalsTakeTheNearerEnd) {
    Mesh fine;
    fine.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    fine.triangles = {{0, 1, 2}, {1, 3, 2}};
    fine.normals.assign(4, {0, 0, 1});
    ProgressiveMesh mesh(fine, CollapseLog{{1, 3, {1, 0, 0}, {}, {0, 0, -1}}});
    const Geomorph morph(mesh, 0, 1);
    EXPECT_EQ(morph.at(0.5).normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(morph.at(0.25).normals[1], glm::vec3(0, 0, -1));
}

TEST(Geomorph, RefusesWhatItIsNot) {
    const LoggedBody body = small_body();
    ProgressiveMesh mesh(body.mesh, body.log);
    EXPECT_THROW(Geomorph(mesh, 3, 2), std::runtime_error);
    EXPECT_THROW(Geomorph(mesh, 0, mesh.splits() + 1), std::runtime_error);
    const Geomorph morph(mesh, 1, 2);
    for (const double fraction : {-0.1, 1.1, std::nan("")})
        EXPECT_THROW(morph.at(fraction), std::runtime_error);
}

} // namespace
} // namespace glcast::test
