// The tables behind "two-manifold by construction", and the quadric.
#include <glm/geometric.hpp>
#include <random>

#include "tests/reconstruct/cast.h"
#include "tools/reconstruct/manifold.h"
#include "tools/reconstruct/patches.h"
#include "tools/reconstruct/planes.h"
#include "tools/reconstruct/qef.h"

namespace glcast::test {
namespace {

TEST(Patches, CountsOfKnownConfigurations) {
    const PatchTable& table = patch_table();
    EXPECT_EQ(table.count[0x00][no_face], 0);
    EXPECT_EQ(table.count[0xff][no_face], 0);
    EXPECT_EQ(table.count[0x01][no_face], 1);
    EXPECT_EQ(table.count[0x0f][no_face], 1);
    EXPECT_EQ(table.count[0x81][no_face], 2); // opposite corners share no face
    EXPECT_EQ(table.count[0x09][no_face], 1); // diagonal on a face: joined
    EXPECT_EQ(table.count[0x09][4], 2);       // and apart when the face is flipped
    EXPECT_EQ(table.count[0x69][no_face], 4);
}

TEST(Patches, ComplementIsTheOtherSideOfTheSameSurfaceWhereNothingIsAmbiguous) {
    const PatchTable& table = patch_table();
    for (int config : {0x01, 0x03, 0x0f, 0x17, 0x81})
        EXPECT_EQ(table.count[config][6], table.count[255 - config][6]);
}

TEST(Normals, PackedNormalsAreExactEnough) {
    std::mt19937 random(1);
    std::normal_distribution<float> any;
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 normal = glm::normalize(glm::vec3(any(random), any(random), any(random)));
        EXPECT_NE(pack_normal(normal), 0u);
        EXPECT_LT(glm::distance(unpack_normal(pack_normal(normal)), normal), 1e-4f);
    }
    for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1)})
        EXPECT_LT(glm::distance(unpack_normal(pack_normal(axis)), axis), 1e-4f);
}

TEST(Quadric, ThreePlanesMeetInTheirCorner) {
    Quadric quadric;
    quadric.add({0.3f, 0.1f, 0.9f}, {1, 0, 0}, 1);
    quadric.add({0.2f, 0.6f, 0.1f}, {0, 1, 0}, 1);
    quadric.add({0.5f, 0.5f, 0.7f}, {0, 0, 1}, 1);
    EXPECT_LT(glm::distance(quadric.minimum(glm::vec3(0), glm::vec3(1)), glm::vec3(0.3f, 0.6f, 0.7f)), 2e-3f);
}

TEST(Quadric, BoundedMinimumBeatsEveryPointOfTheBox) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    std::normal_distribution<float> any;
    for (int trial = 0; trial < 200; ++trial) {
        Quadric quadric;
        for (int k = 0; k < 4; ++k)
            quadric.add({unit(random), unit(random), unit(random)},
                        glm::normalize(glm::vec3(any(random), any(random), any(random))), 1);
        const glm::vec3 best = quadric.minimum(glm::vec3(0), glm::vec3(1));
        const float least = quadric.distance(best) * quadric.distance(best);
        for (int k = 0; k < 50; ++k) {
            const glm::vec3 other(unit(random), unit(random), unit(random));
            const float d = quadric.distance(other), slack = 2e-3f * 3; // the pull towards the mean
            EXPECT_LE(least, d * d + slack);
        }
    }
}

TEST(Manifold, AnythingElseIsCaught) {
    const std::vector<Triangle> closed = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    EXPECT_NO_THROW(assert_manifold(closed, 4));
    auto open = closed;
    open.pop_back();
    EXPECT_THROW(assert_manifold(open, 4), std::logic_error);
    auto turned_over = closed;
    std::swap(turned_over[0][1], turned_over[0][2]);
    EXPECT_THROW(assert_manifold(turned_over, 4), std::logic_error);
    auto touching = closed; // a second tetrahedron on vertex 0
    for (Triangle t : closed) {
        for (auto& v : t) v = v == 0 ? 0 : v + 3;
        touching.push_back(t);
    }
    EXPECT_THROW(assert_manifold(touching, 7), std::logic_error);
    EXPECT_THROW(assert_manifold(closed, 5), std::logic_error);
    EXPECT_THROW(assert_manifold(std::vector<Triangle>{{0, 0, 1}}, 2), std::logic_error);
}

} // namespace
} // namespace glcast::test
