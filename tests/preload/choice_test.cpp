// Which draws of which frame are cast, in frames as toolkits, CAD programs and games make them
// (programs/scenes.c).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <tuple>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 64;

CastRun cast(const std::string& kind, Environment environment = {}) {
    CastRun run = cast_program({SCENES, kind}, n, std::move(environment));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    return run;
}

/// Edge of what was drawn, without the two samples of margin about it.
double extent(const Capture& capture) { return capture.info.box.size * (n - 4) / n; }

/// Largest and mean of a colour channel over what is covered.
struct Tint {
    double red = 0, green = 0, blue = 0;
};
Tint mean_colour(const Capture& capture) {
    Tint sum;
    long count = 0;
    for (const ViewImage& image : capture.images)
        for (std::size_t i = 0; i < image.depth.size(); ++i)
            if (image.covered(i) && image.view.layer == 0) {
                sum.red += image.colour[i].r, sum.green += image.colour[i].g, sum.blue += image.colour[i].b;
                ++count;
            }
    return {sum.red / count, sum.green / count, sum.blue / count};
}

void expect_the_body(const CastRun& run) {
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(extent(*run.capture), 3, 0.01);
}

void expect_green(const CastRun& run) {
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const Tint tint = mean_colour(*run.capture);
    EXPECT_GT(tint.green, 0.95);
    EXPECT_LT(tint.red + tint.blue, 0.05);
}

TEST(Choice, of_a_cad_program_is_the_perspective_view_and_no_backdrop_nor_navigation_ball) {
    const CastRun listed = cast("cad", {{"GLCAST_LIST", "1"}});
    const auto lines = glcast_lines(listed.outcome);
    ASSERT_EQ(lines.size(), 8u) << listed.outcome.err; // hooked, backdrop, four views, ball, listed
    EXPECT_NE(lines[1].find("group 1 36 triangles"), std::string::npos) << lines[1];
    EXPECT_NE(lines[1].find("perspective"), std::string::npos) << lines[1];
    EXPECT_NE(listed.outcome.err.find("an inset"), std::string::npos) << listed.outcome.err;
    const CastRun run = cast("cad");
    expect_the_body(run);
    expect_green(run);
}

TEST(Choice, can_be_overruled_by_number) {
    const CastRun listed = cast("cad", {{"GLCAST_LIST", "1"}});
    int ball = 0, number = 0;
    for (const std::string& line : glcast_lines(listed.outcome))
        if (line.starts_with("group ") && ++number && line.find("an inset") != std::string::npos)
            ball = number;
    const CastRun run = cast("cad", {{"GLCAST_GROUP", std::to_string(ball)}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(extent(*run.capture), 4, 0.05);
}

TEST(Choice, of_offscreen_pictures_is_the_one_drawn_last) {
    const CastRun run = cast("helper");
    expect_the_body(run);
    expect_green(run);
}

TEST(Choice, is_shown_as_pictures) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({SCENES, "cad"}, {{"GLCAST_LIST", folder / "list.png"}}, true);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_TRUE(std::filesystem::exists(folder / "list.png")) << outcome.err;
    EXPECT_GT(std::filesystem::file_size(folder / "list.png"), 2000u);
}

class WholeFrames : public testing::TestWithParam<const char*> {};

TEST_P(WholeFrames, hold_the_whole_body) {
    const CastRun run = cast(GetParam());
    expect_the_body(run);
    long covered = 0; // of the three boxes, seen along z: 2 x 1 + 1 x 2 of 3 x 3
    for (const ViewImage& image : run.capture->images)
        if (image.view.axis == Axis::z && image.view.side == Side::plus && image.view.layer == 0)
            for (std::size_t i = 0; i < image.depth.size(); ++i) covered += image.covered(i);
    const double square = run.capture->info.box.size / n;
    EXPECT_NEAR(covered * square * square, 4, 0.3);
}
INSTANTIATE_TEST_SUITE_P(Kinds, WholeFrames,
                         testing::Values("composite", "composite_of_thread", "interrupted", "picking", "sky",
                                         "front", "after_front"),
                         [](const auto& info) { return info.param; });

TEST(Frames, that_only_show_a_texture_again_do_not_count) {
    const CastRun run = cast("composite_still", {{"GLCAST_FRAME", "3"}});
    EXPECT_FALSE(run.capture);
    EXPECT_NE(run.outcome.err.find("none with solid geometry"), std::string::npos) << run.outcome.err;
}

TEST(Frames, of_which_a_part_is_painted_over_show_the_rest) { expect_green(cast("picking")); }

TEST(Transparent, is_cast_by_its_alpha_or_kept_or_skipped) {
    const auto width = [](const Environment& environment) {
        const CastRun run = cast("glass", environment);
        return run.capture ? extent(*run.capture) : -1;
    };
    EXPECT_NEAR(width({}), 5, 0.05);
    EXPECT_NEAR(width({{"GLCAST_TRANSPARENT", "keep"}}), 7, 0.05);
    EXPECT_NEAR(width({{"GLCAST_TRANSPARENT", "skip"}}), 3, 0.05);
}

// All faces that a view shows are seen under the same share of their size, so the marks' share is that on
// each.
TEST(Decals, told_apart_by_an_offset_cover_what_they_cover) {
    const Outcome plain = run_program({SCENES, "decals"}, {}, false);
    const CastRun run = cast("decals", {{"GLCAST_FRAME", "3"}, {"GLCAST_FRAME_MATRIX", "eye"}});
    EXPECT_EQ(run.outcome.out, plain.out);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const double share = 32 * std::sin(std::numbers::pi / 32) * 0.25 / 4;
    for (const ViewImage& image : run.capture->images) {
        if (image.view.layer != 0) continue;
        long covered = 0, red = 0;
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
            if (!image.covered(i)) continue;
            ++covered;
            red += image.colour[i].g < 0.5f;
            EXPECT_EQ(image.colour[i].r, 1);
        }
        EXPECT_NEAR(double(red) / double(covered), share, 0.015);
    }
}

TEST(Lines, are_no_solid_unless_asked_for) {
    const CastRun without = cast("wires");
    EXPECT_FALSE(without.capture);
    EXPECT_NE(without.outcome.err.find("--include lines"), std::string::npos) << without.outcome.err;
    const CastRun with = cast("wires", {{"GLCAST_INCLUDE", "lines"}});
    ASSERT_TRUE(with.capture) << with.outcome.err;
    EXPECT_NEAR(extent(*with.capture), 2, 0.1);
    const double sample = with.capture->info.box.size / n;
    for (const ViewImage& image : with.capture->images) {
        if (image.view.layer != 0) continue;
        long covered = 0;
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
            if (!image.covered(i)) continue;
            ++covered;
            EXPECT_GT(image.colour[i].g, 0.9);
            EXPECT_LT(image.colour[i].b, 0.1);
        }
        EXPECT_NEAR(covered * sample, 4 * 2 * 1.5, 5) << "four edges, 1.5 samples wide: one or two rows";
    }
}

TEST(Points, are_cast_when_asked_for) {
    const CastRun run = cast("cloud", {{"GLCAST_INCLUDE", "points"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const glm::dvec3 centre(1, 1, 1);
    for (const ViewImage& image : run.capture->images)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const std::size_t at = std::size_t(j) * n + i;
                if (!image.covered(at)) continue;
                const auto p =
                    lattice_point(run.capture->info.box, n, image.view.axis, i, j, image.depth[at]);
                EXPECT_NEAR(glm::length(p - centre), 1, 2.0 * run.capture->info.box.size / n);
            }
    const CastRun without = cast("cloud");
    EXPECT_FALSE(without.capture);
}

TEST(Signal, asks_for_a_frame_and_the_programs_handler_runs) {
    const CastRun run = cast("signals", {{"GLCAST_SIGNAL", "USR1"}});
    expect_the_body(run);
    EXPECT_EQ(run.capture->info.frame, 2); // it came during the second, which was recorded beforehand
    EXPECT_EQ(run.outcome.out, "handled 1\n");
}

TEST(Textures, that_change_and_go_in_a_frame_are_seen_as_each_draw_saw_them) {
    const Outcome plain = run_program({SCENES, "refilled"}, {}, false);
    const CastRun run = cast("refilled", {{"GLCAST_FRAME_MATRIX", "base"}});
    EXPECT_EQ(run.outcome.out, plain.out); // pixels and errors
    ASSERT_TRUE(run.capture) << run.outcome.err;
    std::set<std::tuple<int, int, int>> colours;
    for (const ViewImage& image : run.capture->images)
        for (std::size_t i = 0; i < image.depth.size(); ++i)
            if (image.covered(i) && image.view.layer == 0)
                colours.emplace(image.colour[i].r * 255, image.colour[i].g * 255, image.colour[i].b * 255);
    const std::set<std::tuple<int, int, int>> drawn = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    EXPECT_EQ(colours, drawn);
}

} // namespace
} // namespace glcast::test
