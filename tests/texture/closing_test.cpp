// What textures show where the surface closes an opening that nobody drew shut.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/texture/baked.h"
#include "tools/texture/bake.h"

namespace glcast::test {
namespace {

constexpr int n = 96;
constexpr double sample = 2.04 / n, half = 0.6, slit_at = 0.004, slit = 2 * sample,
                 reach = 4; // reach: samples
const glm::vec3 up(0, 0, 1);

/// Green deep inside, red outside.
Source painted(const BodyPtr& body, bool layers = true, const NormalEdit& edit = {}) {
    auto images = layers ? cast_layers(*body, test_box, n, edit) : cast_body(*body, test_box, n, edit);
    paint(images, test_box, [](const glm::dvec3& at, const glm::vec3&) {
        const glm::dvec3 out = glm::abs(at);
        return std::max({out.x, out.y, out.z}) > half - 0.05 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    });
    return make_source(images, layers);
}
/// Two samples wide, down to the middle of a block.
BodyPtr slit_block() {
    return subtract(box({0, 0, 0}, glm::dvec3(half)), box({0, slit_at, 0.4}, {2, slit / 2, 0.4}));
}
/// The same, through the wall of a hollow cube.
BodyPtr slit_shell() {
    return subtract(subtract(box({0, 0, 0}, glm::dvec3(half)), box({0, 0, 0}, glm::dvec3(0.4))),
                    box({0.003, slit_at, 0.5}, {0.41, slit / 2, 0.3}));
}
/// A floor whose normals the program has the wrong way round.
glm::dvec3 inward(const glm::dvec3& at, const glm::dvec3& normal) {
    return std::abs(at.z) < 0.01 ? -normal : normal;
}
/// On the closing: places along the slit, at its middle, so far over the flush face.
std::vector<glm::dvec3> along_slit(double over) {
    std::vector<glm::dvec3> places;
    for (double x = -0.3; x <= 0.3; x += 0.37 * sample) places.push_back({x, slit_at, half + over * sample});
    return places;
}

TEST(Closing, ShowsTheFloorOfTheSlit) {
    const Source source = painted(slit_block());
    for (const double over : {-0.6, 0.0, 0.8, 2.0})
        for (const glm::dvec3& at : along_slit(over)) {
            const CapturedPoint seen = source.captured.look(at, up, up, reach);
            ASSERT_TRUE(seen.found);
            EXPECT_NEAR(seen.position.z, 0, 0.01 * sample);
            EXPECT_LT(glm::distance(seen.normal, up), 1e-3f);
            EXPECT_LT(glm::distance(seen.colour, glm::vec3(0, 1, 0)), 1e-3f);
            // and what lies beside is all that there is without
            EXPECT_NEAR(source.captured.find(at, up, up, reach).position.z, half, 0.01 * sample);
        }
}

/// Triangles of a coarse level over the end of a slit face its wall, which is farther off.
TEST(Closing, IsNearerThanTheWallOfTheSlit) {
    const Source source = painted(slit_block());
    for (const float turned : {-1.0f, 1.0f})
        for (const glm::dvec3& at : along_slit(-0.9)) {
            const glm::vec3 facing = glm::normalize(glm::vec3(0.1f, 0.8f * turned, 0.7f));
            const CapturedPoint seen = source.captured.look(at, facing, facing, reach);
            ASSERT_TRUE(seen.found);
            EXPECT_TRUE(seen.behind);
            EXPECT_LT(glm::distance(seen.colour, glm::vec3(0, 1, 0)), 1e-3f);
        }
}

TEST(Closing, ShowsTheFarWallOfAHollow) {
    const Source source = painted(slit_shell());
    for (const glm::dvec3& at : along_slit(0)) {
        const CapturedPoint seen = source.captured.look(at, up, up, reach);
        ASSERT_TRUE(seen.found);
        EXPECT_NEAR(seen.position.z, -0.4, 0.01 * sample);
        EXPECT_LT(glm::distance(seen.normal, up), 1e-3f);
    }
}

TEST(Closing, IsNothingThatWasDrawn) {
    const Source source = painted(slit_block());
    for (double y = slit_at + slit; y < half - sample; y += 0.31 * sample)
        for (const double over : {-0.6, 0.0, 0.8}) {
            const glm::dvec3 at(0.1, y, half + over * sample);
            const CapturedPoint seen = source.captured.look(at, up, up, reach);
            EXPECT_EQ(seen.position, source.captured.find(at, up, up, reach).position);
            EXPECT_NEAR(seen.position.z, half, 0.01 * sample);
        }
}

/// Nor is the air beyond an outline, though it lies over the body's far side.
TEST(Closing, IsNotBeyondAnOutline) {
    const Source source = make_source(cast_layers(*sphere({0, 0, 0}, 0.7), test_box, n), true);
    for (const double over : {-1.0, 0.5, 1.5, 3.0})
        for (double turn = 0; turn < 6.28; turn += 0.01)
            for (const double tilt : {0.0, 0.2, 0.6}) {
                const glm::dvec3 out(std::cos(turn) * std::cos(tilt), std::sin(turn) * std::cos(tilt),
                                     std::sin(tilt));
                const glm::dvec3 at = (0.7 + over * sample) * out;
                const glm::vec3 facing(out);
                EXPECT_EQ(source.captured.look(at, facing, facing, reach).position,
                          source.captured.find(at, facing, facing, reach).position);
            }
}

/// With the six outer images alone nobody knows what lies behind.
TEST(Closing, NeedsAllLayers) {
    const Source source = painted(slit_block(), false);
    for (const glm::dvec3& at : along_slit(0))
        EXPECT_EQ(source.captured.look(at, up, up, reach).position,
                  source.captured.find(at, up, up, reach).position);
}

TEST(Closing, IsSeenInTheVertices) {
    const Source source = painted(slit_block(), true, inward);
    std::size_t closing = 0, beside = 0;
    for (std::size_t v = 0; v < source.full.positions.size(); ++v) {
        const glm::dvec3& at = source.full.positions[v];
        if (at.z < half - 3 * sample || std::abs(at.x) > 0.5 || std::abs(at.y) > 0.5) continue;
        const double off = std::abs(at.y - slit_at);
        if (off < 0.45 * slit) {
            EXPECT_LT(glm::distance(source.full.colours[v], glm::vec3(0, 1, 0)), 1e-3f);
            EXPECT_LT(glm::distance(source.full.normals[v], -up), 1e-3f);
            ++closing;
        } else if (off > 0.6 * slit) {
            EXPECT_LT(glm::distance(source.full.colours[v], glm::vec3(1, 0, 0)), 1e-3f);
            EXPECT_LT(glm::distance(source.full.normals[v], up), 1e-3f);
            ++beside;
        }
    }
    EXPECT_GT(closing, 40u);
    EXPECT_GT(beside, 1000u);
}

TEST(Closing, IsSeenInTheTextureOfALevel) {
    const Source source = painted(slit_block(), true, inward);
    Mesh mesh = coarse(source.full, 60);
    TextureReport report;
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512}, &report);
    double green = 0, red = 0, down = 0, up_beside = 0, along = 0, beside = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int i = 1; i < 200; ++i)
            for (int j = 1; i + j < 200; ++j) {
                const glm::vec3 w = glm::vec3(i, j, 200 - i - j) / 200.0f;
                glm::dvec3 at(0);
                for (int k = 0; k < 3; ++k) at += double(w[k]) * mesh.positions[mesh.triangles[t][k]];
                if (at.z < half - 3 * sample || std::abs(at.x) > 0.5 || std::abs(at.y) > 0.5) continue;
                const double off = std::abs(at.y - slit_at) / sample;
                const Shown shown = shown_at(mesh, texture, t, w);
                if (off < 0.3) green += shown.colour.g, down -= shown.normal.z, ++along;
                if (off > 2.5) red += shown.colour.r, up_beside += shown.normal.z, ++beside;
            }
    // About two samples wide, a block long, and no ray saw it.
    EXPECT_GT(double(report.texels_unseen), half / sample * report.texels_per_sample);
    ASSERT_GT(along, 10);
    ASSERT_GT(beside, 1000);
    EXPECT_GT(green / along, 0.95);
    EXPECT_GT(red / beside, 0.999);
    EXPECT_GT(down / along, 0.9);
    EXPECT_GT(up_beside / beside, 0.999);
    // The frame that they are written in turns over nowhere.
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            EXPECT_GT(glm::dot(mesh.normals[t[k]], mesh.normals[t[(k + 1) % 3]]), -0.5f);
}

} // namespace
} // namespace glcast::test
