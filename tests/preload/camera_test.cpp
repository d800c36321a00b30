// However a program looks at a body, with however many projections: it is cast whole, in its own shape, and
// of the hand that the window shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 64;

// As in programs/window.c.
const glm::dvec3 boxes[3][2] = {{{0, 0, 0}, {1, 1, 3}}, {{1, 0, 0}, {3, 1, 1}}, {{0, 1, 2}, {1, 2, 3}}};

/// As in programs/cameras.c.
glm::dmat4 view() {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), {0.3, -0.7, -12});
    m = glm::rotate(m, glm::radians(25.0), {1, 0, 0});
    return glm::rotate(m, glm::radians(-35.0), {0, 1, 0});
}

CastRun cast(const std::string& way, Environment environment = {}) {
    CastRun run = cast_program({CAMERAS, way}, n, std::move(environment));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    return run;
}

double distance_to_box(const glm::dvec3& p, const glm::dvec3& lo, const glm::dvec3& hi) {
    const glm::dvec3 outside = glm::max(glm::max(lo - p, p - hi), 0.0);
    const glm::dvec3 inside = glm::min(p - lo, hi - p);
    const double depth = std::min({inside.x, inside.y, inside.z});
    return depth > 0 ? depth : glm::length(outside);
}

/// Each hit lies on a box and has its colour, and each box has hits on all its sides.
void expect_the_body(const CastRun& run, const glm::dmat4& to_model, double tolerance = 0.01) {
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const Capture& capture = *run.capture;
    const double sample = capture.info.box.size / n * glm::length(glm::dvec3(to_model[0]));
    long hits[3] = {}, wrong_colours = 0;
    glm::dvec3 least[3] = {{9, 9, 9}, {9, 9, 9}, {9, 9, 9}},
               most[3] = {{-9, -9, -9}, {-9, -9, -9}, {-9, -9, -9}};
    for (const ViewImage& image : capture.images)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const std::size_t at = std::size_t(j) * n + i;
                if (!image.covered(at)) continue;
                const glm::dvec3 p(to_model * glm::dvec4(lattice_point(capture.info.box, n, image.view.axis,
                                                                       i, j, image.depth[at]),
                                                         1));
                double nearest = 1e9;
                bool has_a_colour = false;
                for (int b = 0; b < 3; ++b) {
                    const double d = distance_to_box(p, boxes[b][0], boxes[b][1]);
                    nearest = std::min(nearest, d);
                    if (d > tolerance * sample) continue;
                    has_a_colour |= image.colour[at][b] > 0.99f;
                    ++hits[b];
                    least[b] = glm::min(least[b], p), most[b] = glm::max(most[b], p);
                }
                ASSERT_LT(nearest, tolerance * sample) << p.x << ' ' << p.y << ' ' << p.z;
                wrong_colours += !has_a_colour;
            }
    EXPECT_EQ(wrong_colours, 0);
    for (int b = 0; b < 3; ++b) {
        EXPECT_GT(hits[b], 100);
        EXPECT_LT(glm::length(least[b] - boxes[b][0]), 3 * sample);
        EXPECT_LT(glm::length(most[b] - boxes[b][1]), 3 * sample);
    }
}

class Ways : public testing::TestWithParam<const char*> {};

TEST_P(Ways, lead_into_one_eye_space) {
    const CastRun run = cast(GetParam());
    expect_the_body(run, glm::dmat4(1.0));
    ASSERT_TRUE(run.capture);
    EXPECT_TRUE(run.capture->info.not_understood.empty()) << run.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Cameras, Ways,
                         testing::Values("one_projection", "planes", "reversed", "own_view", "left_handed",
                                         "whole_matrix", "clipped_whole", "view_in_projection",
                                         "parallel_planes", "parallel_whole", "ortho_in_modelview",
                                         "frustum_in_modelview", "upside_down_blit", "upside_down_quad",
                                         "upside_down_left_handed", "upside_down_unseen"),
                         [](const auto& info) { return std::string(info.param); });

// The cube, which comes last, tells the lens.
TEST(Cameras, of_models_that_are_scaled_unevenly_in_the_whole_matrix_are_found) {
    expect_the_body(cast("stretched_whole", {{"GLCAST_FRAME_MATRIX", "eye"}}), glm::inverse(view()));
}

TEST(Cameras, of_clip_positions_are_found_with_a_field_of_view) {
    for (const char* way : {"clip_positions", "clip_arrays"}) {
        const CastRun run = cast(way, {{"GLCAST_FOV", "28.072486935852957"}}); // 2 atan 1/4
        expect_the_body(run, glm::inverse(view()), 0.05);
        ASSERT_TRUE(run.capture);
        EXPECT_TRUE(run.capture->info.not_understood.empty()) << run.outcome.err;
    }
}

// Wrong by a stretch along the line of sight, and no more: what is flat stays flat.
TEST(Cameras, of_clip_positions_are_guessed_with_a_warning) {
    const CastRun run = cast("clip_positions");
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NE(run.outcome.err.find("--fov"), std::string::npos) << run.outcome.err;
    EXPECT_EQ(run.capture->info.not_understood.size(), 1u);
    const double stretch = 0.25 / std::tan(glm::radians(22.5));
    const glm::dmat4 narrow = glm::scale(glm::dmat4(1.0), glm::dvec3(stretch, stretch, 1));
    EXPECT_GT(run.capture->info.box.size, 0);
    ASSERT_TRUE(run.capture);
    const glm::dmat4 to_model = glm::inverse(view()) * narrow;
    for (const ViewImage& image : run.capture->images)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const std::size_t at = std::size_t(j) * n + i;
                if (!image.covered(at)) continue;
                const glm::dvec3 p(
                    to_model *
                    glm::dvec4(
                        lattice_point(run.capture->info.box, n, image.view.axis, i, j, image.depth[at]), 1));
                double nearest = 1e9;
                for (const auto& box : boxes) nearest = std::min(nearest, distance_to_box(p, box[0], box[1]));
                ASSERT_LT(nearest, 0.05 * run.capture->info.box.size / n);
            }
}

TEST(Cameras, that_cannot_be_found_are_told_of) {
    const CastRun run = cast("bent_positions");
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->info.not_understood.size(), 1u) << run.outcome.err;
    EXPECT_NE(run.outcome.err.find("w of their own"), std::string::npos) << run.outcome.err;
}

// The mark covers a quarter of the first box's side at z = 0.
TEST(Cameras, that_draw_decals_by_a_nudged_depth_row_show_them) {
    const CastRun run = cast("decal");
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const double square = std::pow(run.capture->info.box.size / n, 2);
    long yellow = 0;
    for (const ViewImage& image : run.capture->images)
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
            const bool is_yellow = image.covered(i) && image.colour[i].r > 0.99f && image.colour[i].g > 0.99f;
            yellow += is_yellow && image.view.axis == Axis::z && image.view.side == Side::minus &&
                      image.view.layer == 0;
        }
    EXPECT_NEAR(yellow * square, 0.25, 0.03);
}

TEST(Cameras, are_as_many_renders_as_one_where_planes_differ) {
    const auto draws = [](const char* way) {
        const CastRun run = cast(way);
        const std::size_t at = run.outcome.err.find(" draws");
        return run.outcome.err.substr(at - std::min<std::size_t>(at, 4), 4);
    };
    EXPECT_EQ(draws("one_cleared"), draws("planes"));
    EXPECT_EQ(draws("one_cleared"), draws("whole_matrix"));
}

TEST(Cameras, have_a_field_of_view_of_less_than_half_a_turn) {
    for (const char* degrees : {"180", "0", "-3", "nan", "wide"}) {
        const CastRun run = cast("clip_positions", {{"GLCAST_FOV", degrees}});
        EXPECT_FALSE(run.capture);
        EXPECT_NE(run.outcome.err.find("GLCAST_FOV"), std::string::npos) << run.outcome.err;
    }
}

} // namespace
} // namespace glcast::test
