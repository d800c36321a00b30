#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/mesh/bodies.h"
#include "tools/mesh/check.h"
#include "tools/simplify/collapse_log.h"

namespace glcast::test {
namespace {

/// Two triangles up, two down around the square 0 1 2 3: an octahedron.
Mesh octahedron() {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    return mesh;
}

TEST(CollapseLog, NothingCollapsedIsTheMesh) {
    const Mesh mesh = octahedron(), same = collapsed(mesh, {}, 0);
    EXPECT_EQ(same.positions, mesh.positions);
    EXPECT_EQ(same.triangles, mesh.triangles);
}

TEST(CollapseLog, KeepsTheOrderOfVerticesTrianglesAndCorners) {
    Mesh mesh = octahedron();
    mesh.colours.assign(6, glm::vec3(0.25F));
    mesh.normals.assign(6, glm::vec3(0, 0, 1));
    const CollapseLog log = {{2, 1, {-0.5, 0.5, 0}, {1, 0, 0}, {0, 1, 0}}};
    const Mesh level = collapsed(mesh, log, 1);
    const std::vector<glm::dvec3> positions = {{1, 0, 0}, {-0.5, 0.5, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const std::vector<Triangle> triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                             {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
    EXPECT_EQ(level.positions, positions);
    EXPECT_EQ(level.triangles, triangles);
    EXPECT_EQ(level.colours[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(level.colours[0], glm::vec3(0.25F));
    EXPECT_EQ(level.normals[1], glm::vec3(0, 1, 0));
    EXPECT_TRUE(check_mesh(level).closed_manifold());
}

TEST(CollapseLog, LaterStepsSeeWhatEarlierOnesDid) {
    const CollapseLog log = {{2, 1, {-0.5, 0.5, 0}, {}, {}}, {3, 2, {-1, -1, 0}, {}, {}}};
    const Mesh level = collapsed(octahedron(), log, 2);
    const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 0, 2}, {1, 0, 3}, {0, 1, 3}};
    EXPECT_EQ(level.triangles, triangles); // folded flat, as the log said
    EXPECT_EQ(level.positions[1], glm::dvec3(-1, -1, 0));
}

TEST(CollapseLog, RefusesALogOfAnotherMesh) {
    const Mesh mesh = octahedron();
    const CollapseLog wrong[] = {
        {{6, 0, {}, {}, {}}},                     // no such vertex
        {{0, 6, {}, {}, {}}},                     //
        {{1, 1, {}, {}, {}}},                     // with itself
        {{0, 2, {}, {}, {}}},                     // no edge
        {{0, 1, {}, {}, {}}, {2, 1, {}, {}, {}}}, // gone already
        {{0, 1, {}, {}, {}}, {1, 2, {}, {}, {}}}, //
    };
    for (const CollapseLog& log : wrong) EXPECT_THROW(collapsed(mesh, log, log.size()), std::runtime_error);
    EXPECT_THROW(collapsed(mesh, {}, 1), std::runtime_error);
    Mesh broken = mesh;
    broken.triangles[3][1] = 17;
    EXPECT_THROW(collapsed(broken, {}, 0), std::runtime_error);
    broken = mesh;
    broken.colours.resize(2);
    EXPECT_THROW(collapsed(broken, {}, 0), std::runtime_error);
}

} // namespace
} // namespace glcast::test
