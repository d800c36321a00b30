// The tables behind "two-manifold by construction", and the quadric.
#include <glm/geometric.hpp>
#include <random>

#include "tests/reconstruct/cast.h"
#include "tests/reconstruct/random_bodies.h"
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

/// Quarter plane of the cube's face about cell edge `e`: +-1 along the two axes that span it, seen from the
/// cell's middle.
glm::ivec3 quarter(int e) {
    glm::ivec3 towards(0);
    for (int k = 0; k < 3; ++k)
        if (k != edge_axis(e)) towards[k] = (edge_corner(e) >> k & 1) ? 1 : -1;
    return towards;
}

/// Is there an axis along which p + quarter and q + quarter are apart, `d` = p - q?
bool quarters_apart(const glm::ivec3& p, const glm::ivec3& q, const glm::vec3& d) {
    for (int k = 0; k < 3; ++k) {
        const bool q_reaches_up = q[k] > 0 || p[k] < 0, q_reaches_down = q[k] < 0 || p[k] > 0;
        if ((d[k] > 1e-6f && !q_reaches_up) || (d[k] < -1e-6f && !q_reaches_down)) return true;
    }
    return false;
}

TEST(Patches, OfOneCellDoNotTouchWhenPulledApart) {
    const PatchTable& table = patch_table();
    int pairs = 0;
    for (int config = 0; config < 256; ++config)
        for (int flipped : {no_face, int(table.twice[config])}) {
            const auto& patch = table.patch[config][flipped];
            const auto& towards = table.towards[config][flipped];
            for (int e = 0; e < 12; ++e)
                for (int f = 0; f < 12; ++f) {
                    if (patch[e] == 255 || patch[f] == 255 || patch[e] == patch[f]) continue;
                    ++pairs;
                    EXPECT_TRUE(quarters_apart(quarter(e), quarter(f), towards[patch[e]] - towards[patch[f]]))
                        << config << ' ' << flipped << ' ' << e << ' ' << f;
                }
        }
    EXPECT_GT(pairs, 1000);
}

/// The four edges of a face that changes sign at all of them: parts on either side of it, each with one
/// corner.
TEST(Patches, ArcsOfAnAmbiguousFaceArePulledApartBothWays) {
    const PatchTable& table = patch_table();
    int faces = 0;
    for (int config = 0; config < 256; ++config)
        for (int flipped : {no_face, int(table.twice[config])})
            for (int face = 0; face < 6; ++face) {
                const auto& patch = table.patch[config][flipped];
                glm::ivec2 edge[2] = {glm::ivec2(-1),
                                      glm::ivec2(-1)}; // by axis within the face, low and high
                const int a = face >> 1, b = (a + 1) % 3, c = (a + 2) % 3;
                for (int e = 0; e < 12; ++e) {
                    if (patch[e] == 255 || edge_axis(e) == a || (edge_corner(e) >> a & 1) != (face & 1))
                        continue;
                    const int other = edge_axis(e) == b ? c : b;
                    edge[edge_axis(e) == b][edge_corner(e) >> other & 1] = patch[e];
                }
                const glm::ivec2 along_b = edge[1], along_c = edge[0]; // at low and high c; at low and high b
                if (along_b[0] < 0 || along_b[1] < 0 || along_c[0] < 0 || along_c[1] < 0) continue;
                if (along_b[0] == along_b[1]) continue; // both arcs in one patch
                ++faces;
                const auto& towards = table.towards[config][flipped];
                EXPECT_GT(towards[along_b[1]][c] - towards[along_b[0]][c], 0.3f) << config << ' ' << face;
                EXPECT_GT(towards[along_c[1]][b] - towards[along_c[0]][b], 0.3f) << config << ' ' << face;
            }
    EXPECT_GT(faces, 50);
}

TEST(Patches, CubesOfNoiseDoNotTouch) { // the last rung of mend.cpp
    Dice dice(11);
    for (int trial = 0; trial < 6; ++trial) {
        const auto images = noise_images(20, dice.random, 1);
        cast(images, {.method = SurfaceMethod::cubes, .close_gaps = 0});
    }
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
