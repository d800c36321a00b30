// Both sides of a sheet have a colour and a normal of their own, also where other sheets stand before them
// (programs/sides.c).
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "tests/preload/program_run.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast::test {
namespace {

constexpr int n = 96;

CastRun cast(const std::string& way, Environment environment = {}) {
    CastRun run = cast_program({SIDES, way}, n, std::move(environment));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    return run;
}

struct Areas {
    double all = 0, red = 0, green = 0; ///< of triangles of one colour
    double turned = 0;                  ///< whose normals point into the sheet
};

Areas measure(const Capture& capture) {
    const Mesh mesh = reconstruct(capture.images, capture.info.box, {.complete_layers = true});
    Areas areas;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const glm::dvec3 across = glm::cross(b - a, c - a);
        const double area = glm::length(across) / 2;
        areas.all += area;
        const glm::vec3 colour = (mesh.colours[t[0]] + mesh.colours[t[1]] + mesh.colours[t[2]]) / 3.0f;
        if (colour.r > 0.9f && colour.g < 0.1f) areas.red += area;
        if (colour.g > 0.9f && colour.r < 0.1f) areas.green += area;
        const glm::vec3 normal = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
        if (glm::dot(glm::dvec3(normal), across) < 0) areas.turned += area;
    }
    return areas;
}

struct Truth {
    const char* way;
    double side; ///< area of one side of all sheets
    bool is_lit; ///< its normals are drawn
};

class Sides : public testing::TestWithParam<Truth> {};

// The border of a sheet is up to a sample short.
TEST_P(Sides, have_a_colour_each) {
    const Truth& truth = GetParam();
    const CastRun run = cast(truth.way);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_TRUE(run.capture->info.both_sides);
    const Areas areas = measure(*run.capture);
    EXPECT_NEAR(areas.all, 2 * truth.side, 0.1 * truth.side);
    EXPECT_NEAR(areas.red, areas.all / 2, 0.02 * areas.all);
    EXPECT_NEAR(areas.green, areas.all / 2, 0.02 * areas.all);
    const double most_turned = truth.is_lit ? 0.02 * areas.all : areas.all;
    EXPECT_LE(areas.turned, most_turned);
}

constexpr double bent = 2 * std::numbers::pi / 2 * 4;
INSTANTIATE_TEST_SUITE_P(
    Programs, Sides,
    testing::Values(Truth{"plates", 8, true}, Truth{"plates_by_colour_material", 8, true},
                    Truth{"plates_by_two_passes", 8, false}, Truth{"four_plates", 16, true},
                    Truth{"four_plates_by_two_passes", 16, false}, Truth{"bent_sheet", bent, true},
                    Truth{"bent_sheet_by_two_passes", bent, false}, Truth{"open_box", 20, true},
                    Truth{"open_box_by_two_passes", 20, false}),
    [](const auto& info) { return std::string(info.param.way); });

struct Alike {
    const char* way;
    bool both_sides, reversed; ///< as the capture says
    double turned;             ///< share of the area whose normals point into the sheet
};

class AlikeSides : public testing::TestWithParam<Alike> {};

// Backs have the reverse of the front's normal where light is two-sided, and the same one where it is not.
TEST_P(AlikeSides, have_normals_as_lit) {
    const Alike& truth = GetParam();
    const CastRun run = cast(truth.way);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->info.both_sides, truth.both_sides);
    EXPECT_EQ(run.capture->info.reversed_backs, truth.reversed);
    const Areas areas = measure(*run.capture);
    EXPECT_NEAR(areas.red, areas.all, 0.02 * areas.all);
    EXPECT_NEAR(areas.turned, truth.turned * areas.all, 0.03 * areas.all);
}

INSTANTIATE_TEST_SUITE_P(Programs, AlikeSides,
                         testing::Values(Alike{"four_plates_in_one_colour", false, true, 0},
                                         Alike{"bent_sheet_in_one_colour", false, true, 0},
                                         Alike{"open_box_in_one_colour", false, true, 0},
                                         Alike{"plates_lit_as_fronts", false, false, 0.5},
                                         Alike{"two_of_each", true, false, 0.25}),
                         [](const auto& info) { return std::string(info.param.way); });

TEST(SidesTest, that_look_alike_are_drawn_once) {
    const CastRun run = cast("four_plates_in_one_colour"), both = cast("four_plates");
    ASSERT_TRUE(run.capture && both.capture) << run.outcome.err;
    for (const ViewImage& image : run.capture->images) EXPECT_TRUE(image.other_colour.empty());
    EXPECT_LT(run.capture->file_bytes, both.capture->file_bytes);
}

} // namespace
} // namespace glcast::test
