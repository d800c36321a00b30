// Faces that are drawn into the depth buffer alone, and draws that are missing: a cast of what the window
// shows, or the reason that holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr double body = 6, grid = 0.04; // as in reads_test.cpp

CastRun cast(const std::string& way, Environment environment = {}) {
    CastRun run = cast_program({HIDDEN, way}, 48, std::move(environment));
    EXPECT_EQ(run.outcome.exit_code, 0);
    EXPECT_NE(run.outcome.out.find("error 0"), std::string::npos) << run.outcome.out;
    return run;
}

/// Of all hits in all views.
double share_of_colour(const Capture& capture, const glm::vec3& colour) {
    long hits = 0, alike = 0;
    for (const ViewImage& image : capture.images)
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
            if (!image.covered(i)) continue;
            ++hits;
            alike += glm::distance(glm::vec3(image.colour[i]), colour) < 0.01f;
        }
    return hits > 0 ? double(alike) / hits : 0;
}

const glm::vec3 background(0.125f, 0.25f, 0.5f), orange(1, 0.5f, 0), white(1);

class HiddenLine : public testing::TestWithParam<std::string> {};
TEST_P(HiddenLine, is_cast_in_the_colour_of_the_background) {
    const CastRun run = cast(GetParam());
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(volume(*run.capture), body, grid * body);
    EXPECT_EQ(share_of_colour(*run.capture, background), 1);
    EXPECT_EQ(run.capture->info.not_understood.size(), 1u);
    EXPECT_NE(run.outcome.err.find("colour of the background"), std::string::npos) << run.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Hidden, HiddenLine,
                         testing::Values("mask-outlines", "mask-lines", "equal-outlines", "lit-textured",
                                         "arrays-lines", "colours-lines", "no-buffer-lines"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Hidden, lines_are_offered_and_cast_when_asked_for) {
    EXPECT_NE(cast("mask-lines").outcome.err.find("--include lines"), std::string::npos);
    const CastRun run = cast("mask-lines", {{"GLCAST_INCLUDE", "lines"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_GT(share_of_colour(*run.capture, white), 0.05);
    EXPECT_GT(share_of_colour(*run.capture, background), 0.5);
}

TEST(Hidden, faces_that_get_their_colours_later_have_these) {
    for (const char* way : {"depth-first", "no-buffer-first"}) {
        const CastRun run = cast(way);
        ASSERT_TRUE(run.capture) << run.outcome.err;
        EXPECT_NEAR(volume(*run.capture), body, grid * body);
        EXPECT_EQ(share_of_colour(*run.capture, orange), 1);
        EXPECT_TRUE(run.capture->info.not_understood.empty()) << run.outcome.err;
    }
}

TEST(Hidden, faces_beside_others_are_counted) {
    for (const char* way : {"mask-beside", "no-buffer-beside"}) {
        const CastRun run = cast(way);
        ASSERT_TRUE(run.capture) << run.outcome.err;
        EXPECT_NEAR(volume(*run.capture), body, grid * body);
        EXPECT_EQ(share_of_colour(*run.capture, orange), 1);
        ASSERT_EQ(run.capture->info.not_understood.size(), 1u) << run.outcome.err;
        EXPECT_EQ(run.capture->info.not_understood.begin()->second, 12);
        EXPECT_NE(run.outcome.err.find("beside others with colours: not cast"), std::string::npos)
            << run.outcome.err;
    }
}

/// However the frame is replayed.
TEST(Hidden, faces_leave_the_colour_that_the_program_set) {
    for (const char* replay : {"", "calls"}) {
        const CastRun run = cast("colour-left", {{"GLCAST_REPLAY", replay}});
        ASSERT_TRUE(run.capture) << run.outcome.err;
        EXPECT_GT(share_of_colour(*run.capture, glm::vec3(1, 0, 0)), 0.5) << replay;
        EXPECT_EQ(share_of_colour(*run.capture, white), 0) << replay;
    }
}

TEST(Hidden, faces_with_nothing_over_them_are_told_of) {
    const CastRun run = cast("mask-alone");
    EXPECT_FALSE(run.capture);
    EXPECT_NE(run.outcome.err.find("masked colours"), std::string::npos) << run.outcome.err;
}

// ctmviewer: lists shaded by GLSL, and lines and pixels beside them.
TEST(Hidden, lists_under_a_shader_are_told_of) {
    for (const char* way : {"shaded-list", "shading-list"}) {
        const CastRun run = cast(way);
        EXPECT_FALSE(run.capture);
        EXPECT_NE(run.outcome.err.find("draws with shaders of its own"), std::string::npos)
            << run.outcome.err;
    }
}

// A script starts one program after the other.
TEST(Hidden, reason_of_one_program_is_never_said_of_another) {
    const TemporaryFolder folder;
    const auto told_by = [&](const std::string& script) {
        const Outcome outcome = run_program(
            {GLCAST_RUN, "-o", folder / "cast.exr", "--timeout", "60", "--", "sh", "-c", script}, {}, false);
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        return outcome.err;
    };
    const std::string other = READS " pbuffer-unread", own = HIDDEN " mask-alone";
    for (const std::string& script : {other + "; " + own, own + "; " + other}) {
        const std::string told = told_by(script);
        EXPECT_NE(told.find("masked colours"), std::string::npos) << told;
        EXPECT_NE(told.find("in hidden"), std::string::npos) << told;
    }
    EXPECT_NE(
        told_by(other + "; true").find("GLX seen in reads, but no whole frame: it draws into a pbuffer"),
        std::string::npos);
    EXPECT_EQ(told_by("exec " + other).find("in reads"), std::string::npos);
}

} // namespace
} // namespace glcast::test
