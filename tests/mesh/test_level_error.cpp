// The error certificate of a level, against closed forms.
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "tests/file/textured_torus.h"
#include "tests/mesh/bodies.h"
#include "tools/deviation/level_error.h"

using namespace glcast;
using samples::torus;
using samples::torus_texture;

namespace {

Level level_of(Mesh mesh, const glm::vec3& colour = {}) {
    mesh.colours.assign(mesh.positions.size(), colour);
    return {std::move(mesh), "level 0"};
}

/// A closed box with the lower corner at 0, a colour below and one above the middle of z.
Level sheet(double thickness) {
    Level level{test::cube(1, 8), "sheet"};
    glm::dvec3 lo = level.mesh.positions[0], hi = lo;
    for (const auto& p : level.mesh.positions) lo = min(lo, p), hi = max(hi, p);
    level.mesh.colours.clear();
    for (auto& p : level.mesh.positions) {
        p = (p - lo) / (hi - lo);
        level.mesh.colours.push_back(p.z > 0.5 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1));
        p.z *= thickness;
    }
    level.mesh.normals.clear();
    return level;
}

} // namespace

TEST(LevelErrorTest, ConcentricSpheres) {
    const Level inner = level_of(test::sphere(1, 5), {0.25f, 0.5f, 0.5f}),
                outer = level_of(test::sphere(1.25, 5), {0.25f, 0.5f, 0.75f});
    const LevelError e = measure_level(inner, outer);
    EXPECT_NEAR(e.mean, 0.25, 2e-3);
    EXPECT_NEAR(e.p999, 0.25, 2e-3);
    EXPECT_NEAR(e.max, 0.25, 2e-3);
    EXPECT_LT(e.normal_mean_degrees, 1.5);
    EXPECT_NEAR(e.colour_mean, 0.25, 1e-6);
    EXPECT_NEAR(e.colour_p999, 0.25, 1e-6);
}

TEST(LevelErrorTest, NothingApartFromItself) {
    const Level level = level_of(torus(60, 40), {0.5f, 0.5f, 0.5f});
    const LevelError e = measure_level(level, level);
    EXPECT_LT(e.max, 1e-12);
    EXPECT_LT(e.normal_mean_degrees, 0.05);
    EXPECT_LT(e.colour_p999, 1e-6);
}

/// One vertex out of a thousand sticks out: the maximum must see it, whichever of the two it is on.
TEST(LevelErrorTest, TheMaximumIsThatOfAnyVertex) {
    const Level flat = level_of(test::sphere(1, 5));
    Level spike = flat;
    const std::size_t at = spike.mesh.positions.size() / 3;
    spike.mesh.positions[at] *= 1.5;
    EXPECT_NEAR(measure_level(flat, spike).max, 0.5, 5e-3);
    EXPECT_NEAR(measure_level(spike, flat).max, 0.5, 5e-3);
}

TEST(LevelErrorTest, TheSidesOfASheetAreNotMixedUp) {
    const Level thick = sheet(2e-3),
                thin = sheet(0.8e-3); // its upper side is nearest to the lower one of the other
    const LevelError e = measure_level(thick, thin);
    EXPECT_NEAR(e.max, 1.2e-3, 1e-6);
    EXPECT_LT(e.colour_mean, 0.01);
    EXPECT_LT(e.normal_mean_degrees, 1);
}

TEST(LevelErrorTest, TexturesAndNormalMapsAreWhatIsShown) {
    Level plain{torus(200, 120), "level 0"};
    for (std::uint32_t i = 0; i < 200; ++i)
        for (std::uint32_t j = 0; j < 120; ++j)
            plain.mesh.colours[i * 120 + j] = samples::torus_colour(i / 200.0, j / 120.0);
    Level textured = plain;
    textured.texture = torus_texture(200, 120, 256);
    textured.mesh.colours.assign(textured.mesh.positions.size(), glm::vec3(0)); // not what is shown
    const LevelError flat = measure_level(plain, textured);
    EXPECT_LT(flat.colour_mean, 0.006);
    EXPECT_LT(flat.normal_mean_degrees, 0.5); // 128 of 255 is a little off the middle
    for (const double tilt : {20.0, 50.0}) {
        textured.texture = torus_texture(200, 120, 256, tilt);
        EXPECT_NEAR(measure_level(plain, textured).normal_mean_degrees, tilt, 0.5);
    }
}

TEST(LevelErrorTest, UnsupportedAreaIsThatOfTheFullSurface) {
    Level full = level_of(torus(12, 8));
    full.error.unsupported_area_share = 0.25;
    EXPECT_EQ(measure_level(full, level_of(torus(6, 5))).unsupported_area_share, 0.25);
}

TEST(LevelErrorTest, TheSameOnAnyNumberOfThreads) {
    const Level full = level_of(torus(200, 120)), level = level_of(torus(24, 16));
    const LevelError many = measure_level(full, level);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const LevelError alone = measure_level(full, level);
    EXPECT_EQ(many.mean, alone.mean);
    EXPECT_EQ(many.p999, alone.p999);
    EXPECT_EQ(many.max, alone.max);
    EXPECT_EQ(many.normal_mean_degrees, alone.normal_mean_degrees);
}

TEST(LevelErrorTest, InsideOutEndsAllTheSame) {
    const Level full = level_of(torus(200, 120));
    Level inverted = full;
    for (Triangle& t : inverted.mesh.triangles) std::swap(t[1], t[2]);
    EXPECT_LT(measure_level(full, inverted).max, 1e-12);
}

TEST(LevelErrorTest, NothingToMeasure) { EXPECT_THROW(LevelMeter(Level{}), std::runtime_error); }
