// Levels of few plain colours, told from those whose colours run into one another.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/file/sample_meshes.h"
#include "tools/mesh/face_colours.h"
#include "tools/texture/colour_patches.h"

namespace glcast {
namespace {

/// A torus whose triangles have the colours of `colour(u, v)`, 0..1 round it both ways.
template <class Colour> Level torus_of(Colour&& colour, std::uint32_t u = 64, std::uint32_t v = 24) {
    Level level;
    level.mesh = samples::torus(u, v);
    CornerValues normals, colours;
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
        const std::size_t quad = t / 2;
        auto& c = colours.emplace_back();
        auto& n = normals.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t at = level.mesh.triangles[t][k];
            n[std::size_t(k)] = level.mesh.normals[at];
            c[std::size_t(k)] = colour(double(quad / v) / u, double(at % v) / v);
        }
    }
    level.wedges = take_corner_values(level.mesh, normals, colours);
    return level;
}

std::vector<glm::vec3> noisy(std::vector<glm::vec3> colours, float by) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> noise(-by, by);
    for (glm::vec3& c : colours) c += glm::vec3(noise(random), noise(random), noise(random));
    return colours;
}

const glm::vec3 red(0.8f, 0.1f, 0), blue(0.2f, 0.2f, 1);

} // namespace

TEST(ColourPatches, PlainColoursUnderNoiseAreOneEach) {
    Level level = torus_of([](double u, double) { return u < 0.5 ? red : blue; });
    level.wedges.colours = noisy(level.wedges.colours, 0.4f / 255);
    const std::vector<Triangle> before = level.mesh.triangles;
    ASSERT_TRUE(take_patch_colours(level));
    const FaceColours found = face_colours(level);
    ASSERT_EQ(found.palette.size(), 2u);
    EXPECT_EQ(level.mesh.triangles, before);
    for (std::size_t t = 0; t < found.face.size(); ++t) {
        const glm::vec3 wanted = t < found.face.size() / 2 ? red : blue;
        EXPECT_NEAR(glm::distance(found.palette[found.face[t]], wanted), 0, 1.0 / 255) << t;
    }
}

/// Triangles across a border are of one side or the other.
TEST(ColourPatches, ABorderOfMixedTrianglesIsAllowed) {
    Level level = torus_of([](double u, double v) { return u == 0 && v > 0.5 ? 0.5f * (red + blue) : u < 0.5 ? red : blue; });
    const std::vector<glm::vec3> normals = level.mesh.normals;
    ASSERT_TRUE(take_patch_colours(level));
    EXPECT_EQ(face_colours(level).palette.size(), 2u);
    EXPECT_EQ(level.mesh.normals, normals) << "of the largest wedges, for readers that know one a vertex";
    for (const glm::vec3& colour : level.mesh.colours)
        EXPECT_TRUE(glm::distance(colour, red) < 0.01f || glm::distance(colour, blue) < 0.01f);
}

TEST(ColourPatches, OneColourIsOne) {
    Level level;
    level.mesh = samples::torus(16, 8);
    level.mesh.colours.assign(level.mesh.positions.size(), red);
    ASSERT_TRUE(take_patch_colours(level));
    EXPECT_EQ(face_colours(level).palette.size(), 1u);
    EXPECT_TRUE(level.wedges.empty());
}

/// However flat it is: bands would show.
TEST(ColourPatches, GradientsAreNone) {
    for (const float depth : {1.0f, 0.2f, 0.08f}) {
        SCOPED_TRACE(depth);
        Level level = torus_of([&](double, double v) { return glm::vec3(0.5f + depth * float(std::abs(v - 0.5)) - depth / 4); });
        const std::vector<glm::vec3> before = level.wedges.empty() ? level.mesh.colours : level.wedges.colours;
        EXPECT_FALSE(take_patch_colours(level));
        EXPECT_EQ(level.wedges.empty() ? level.mesh.colours : level.wedges.colours, before);
    }
    Level steps = torus_of([](double u, double) { return glm::vec3(float(std::floor(u * 16)) / 32); });
    EXPECT_FALSE(take_patch_colours(steps)) << "a gradient in small steps";
}

TEST(ColourPatches, TooManyColoursAreNone) {
    Level level = torus_of([](double u, double) { return glm::vec3(std::fmod(u * 4, 1.0), u * 0.9, std::fmod(u * 16, 1.0)); });
    EXPECT_FALSE(take_patch_colours(level));
    EXPECT_TRUE(face_colours(level).empty());
}

} // namespace glcast
