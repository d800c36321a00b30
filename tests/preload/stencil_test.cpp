// What a program draws by way of its stencil buffer is cast as its test lets it be seen: caps of cut bodies,
// faces filled by parity and decals are, outlines are not (programs/stencils.c).
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/preload/program_run.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast::test {
namespace {

constexpr int n = 96;

CastRun cast(const std::string& way, Environment environment = {}) {
    CastRun run = cast_program({STENCILS, way}, n, std::move(environment));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    return run;
}

struct Body {
    double volume = 0, area = 0;
    double red = 0, green = 0, blue = 0; ///< areas, of triangles of one colour
};

Body measure(const Capture& capture) {
    const Mesh mesh = reconstruct(capture.images, capture.info.box, {.complete_layers = true});
    Body body;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const double area = glm::length(glm::cross(b - a, c - a)) / 2;
        body.volume += glm::dot(a, glm::cross(b, c)) / 6;
        body.area += area;
        const glm::vec3 colour = (mesh.colours[t[0]] + mesh.colours[t[1]] + mesh.colours[t[2]]) / 3.0f;
        if (colour.r > 0.9f && colour.g < 0.1f && colour.b < 0.1f) body.red += area;
        if (colour.g > 0.9f && colour.r < 0.1f && colour.b < 0.1f) body.green += area;
        if (colour.b > 0.9f && colour.r < 0.1f && colour.g < 0.1f) body.blue += area;
    }
    return body;
}

struct Truth {
    const char* way;
    double volume, area, green, blue; ///< green, blue: areas; the rest of the area is red
};

class Stencils : public testing::TestWithParam<Truth> {};

TEST_P(Stencils, cast_as_the_window_shows) {
    const Truth& truth = GetParam();
    const CastRun run = cast(truth.way);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_TRUE(run.capture->info.not_understood.empty()) << run.outcome.err;
    EXPECT_EQ(run.outcome.err.find("backdrop"), std::string::npos) << run.outcome.err; // marks are none
    const Body body = measure(*run.capture);
    EXPECT_NEAR(body.volume, truth.volume, 0.02 * truth.volume);
    EXPECT_NEAR(body.area, truth.area, 0.02 * truth.area);
    // Triangles along a border of colours have neither.
    const double border = 0.03 * truth.area, red = truth.area - truth.green - truth.blue;
    EXPECT_NEAR(body.red, red, border);
    EXPECT_NEAR(body.green, truth.green, border);
    EXPECT_NEAR(body.blue, truth.blue, border);
}

constexpr double root_of_8 = 2.8284271247461903;
INSTANTIATE_TEST_SUITE_P(
    Programs, Stencils,
    testing::Values(Truth{"cap_by_two_passes", 4, 16, 0, 4}, Truth{"cap_by_invert", 4, 16, 0, 4},
                    Truth{"cap_by_two_sides", 4, 16, 0, 4}, Truth{"cap_by_extension", 4, 16, 0, 4},
                    Truth{"cap_of_a_hollow_box", 3.5, 18, 0, 3}, Truth{"cap_beside_others", 8, 32, 0, 4},
                    Truth{"cap_askew", 4, 12 + 2 * root_of_8, 0, 2 * root_of_8},
                    Truth{"two_caps", 2, 10, 0, 4}, Truth{"concave_by_parity", 6, 22, 6, 0},
                    Truth{"holed_by_parity", 6, 30, 6, 0}, Truth{"outline", 8, 24, 0, 0},
                    Truth{"outline_where_0", 8, 24, 0, 0}, Truth{"outline_of_far_faces", 8, 24, 0, 0},
                    Truth{"outline_of_value_2", 12, 40, 0, 0}, Truth{"outline_before_its_body", 8, 24, 0, 0},
                    Truth{"outline_of_marks_but_the_body", 8, 24, 0, 0},
                    Truth{"floor_where_nothing_is", 24, 64, 0, 0}, Truth{"decal", 8, 24, 1.5, 0},
                    Truth{"decal_at_equal_depth", 8, 24, 1.5, 0}, Truth{"label_in_front", 8, 24, 0, 0},
                    Truth{"lit_without_shadow", 8, 24, 0, 0}),
    [](const auto& info) { return std::string(info.param.way); });

TEST(StencilTest, by_invisible_marks_cuts_a_hole) {
    const CastRun run = cast("hole_in_a_wall"), parts = cast("wall_of_four_parts");
    ASSERT_TRUE(run.capture && parts.capture) << run.outcome.err;
    const Body body = measure(*run.capture), same = measure(*parts.capture);
    EXPECT_NEAR(body.area, same.area, 0.01 * same.area);
    EXPECT_NEAR(body.area, 24, 0.04 * 24); // the border of a sheet is half a sample short
}

TEST(StencilTest, by_slabs_caps_are_the_same) {
    const CastRun run = cast("cap_of_a_hollow_box", {{"GLCAST_LAYERS", "slab"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const Body body = measure(*run.capture);
    EXPECT_NEAR(body.volume, 3.5, 0.07);
    EXPECT_NEAR(body.blue, 3, 0.5);
}

TEST(StencilTest, whose_marks_lie_in_the_window_is_not_followed_and_said) {
    const CastRun run = cast("in_part_of_the_window");
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(measure(*run.capture).volume, 8, 0.16);
    ASSERT_EQ(run.capture->info.not_understood.size(), 1u) << run.outcome.err;
    EXPECT_EQ(run.capture->info.not_understood.begin()->second, 1);
    EXPECT_NE(run.outcome.err.find("stencil test"), std::string::npos) << run.outcome.err;
}

TEST(StencilTest, of_which_nothing_can_be_asked_is_said) {
    const CastRun run = cast("outline", {{"GLCAST_MASK", "queries"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NE(run.outcome.err.find("whether it is an outline or a decal"), std::string::npos)
        << run.outcome.err;
    EXPECT_FALSE(run.capture->info.not_understood.empty());
}

} // namespace
} // namespace glcast::test
