// Pictures that are read and never swapped are cast, and reads before a swap take nothing from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 48;

CastRun cast(const std::vector<std::string>& command, Environment environment = {}) {
    CastRun run = cast_program(command, n, std::move(environment));
    return run;
}

constexpr double body = 6; ///< of three boxes: 3 + 2 + 1 (programs/chiral.c)
constexpr double grid =
    0.04; ///< a side of 1 is 14.67 samples, and counts as 15; a box that is missing is 0.17 or more

/// The whole body, and the program sees what it sees without us.
void expect_the_body(const std::vector<std::string>& command, const Environment& environment = {}) {
    const Outcome plain = run_program(command, {}, false);
    ASSERT_EQ(plain.exit_code, 0) << "this driver has it not";
    const CastRun run = cast(command, environment);
    EXPECT_EQ(run.outcome.exit_code, 0);
    EXPECT_EQ(run.outcome.out, plain.out);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(volume(*run.capture), body, grid * body) << run.outcome.err;
    EXPECT_TRUE(run.capture->info.not_understood.empty()) << run.outcome.err;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

class Read : public testing::TestWithParam<std::string> {};
TEST_P(Read, ends_a_frame_that_is_never_swapped) { expect_the_body({READS, GetParam()}); }
TEST_P(Read, ends_the_only_frame) { expect_the_body({READS, GetParam(), "1"}); }
INSTANTIATE_TEST_SUITE_P(Reads, Read,
                         testing::Values("pbuffer", "pbuffer-rows", "back-buffer", "framebuffer", "texture",
                                         "surfaceless", "surfaceless-texture", "pixmap-wait", "pixmap-leave"),
                         test_name);

class ReadEgl : public testing::TestWithParam<std::string> {};
TEST_P(ReadEgl, ends_a_frame_that_is_never_swapped) { expect_the_body({READS_EGL, GetParam()}); }
INSTANTIATE_TEST_SUITE_P(Reads, ReadEgl, testing::Values("pbuffer", "surfaceless"), test_name);

class ReadOsmesa : public testing::TestWithParam<std::string> {};
TEST_P(ReadOsmesa, ends_a_frame) { expect_the_body({READS_OSMESA, GetParam()}); }
TEST_P(ReadOsmesa, ends_the_only_frame) { expect_the_body({READS_OSMESA, GetParam(), "1"}); }
INSTANTIATE_TEST_SUITE_P(Reads, ReadOsmesa,
                         testing::Values("finish", "read", "leave", "buffer", "attributes"), test_name);
TEST(Reads, of_osmesa_that_is_opened_later_end_frames) { expect_the_body({READS_OSMESA_OPENED, "finish"}); }

// Two OpenGLs in one process: the one that is not recorded draws as ever.
TEST(Reads, of_osmesa_beside_another_opengl_are_let_alone) {
    const Outcome plain = run_program({READS_OSMESA_BESIDE, "finish"}, {}, false);
    const CastRun run = cast({READS_OSMESA_BESIDE, "finish"});
    EXPECT_EQ(run.outcome.exit_code, 0);
    EXPECT_EQ(run.outcome.out, plain.out);
    EXPECT_FALSE(run.capture);
    EXPECT_NE(run.outcome.err.find("OSMesa"), std::string::npos) << run.outcome.err;
}

class ReadBeforeSwap : public testing::TestWithParam<std::string> {};
TEST_P(ReadBeforeSwap, takes_nothing_from_the_frame) { expect_the_body({READS, GetParam()}); }
TEST_P(ReadBeforeSwap, takes_nothing_from_the_only_frame) { expect_the_body({READS, GetParam(), "1"}); }
INSTANTIATE_TEST_SUITE_P(Reads, ReadBeforeSwap, testing::Values("pick-swap", "read-swap", "preview-swap"),
                         test_name);

// JOGL's GLJPanel.
TEST(Reads, of_a_picture_that_a_shader_turns_over_cast_the_scene) {
    const CastRun run = cast({READS, "surfaceless-turned"});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(volume(*run.capture), body, grid * body) << run.outcome.err;
}

TEST(Reads, of_a_swapping_program_end_no_frame) {
    expect_the_body({READS, "read-swap"}, {{"GLCAST_FRAME", "3"}});
}

TEST(Reads, of_an_empty_picture_are_waited_out) { expect_the_body({READS, "empty-first"}); }

// The second picture is richer by far.
TEST(Reads, of_several_pictures_leave_the_first) { expect_the_body({READS, "two-pictures"}); }

TEST(Reads, are_counted_as_frames) {
    const CastRun run = cast({READS, "two-pictures"}, {{"GLCAST_FRAME", "2"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->info.frame, 2);
    EXPECT_GT(volume(*run.capture), 1.5 * body);
}

TEST(Reads, of_several_pictures_can_all_be_cast) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_program({READS, "pbuffer", "5"},
                    {{"GLCAST_OUT", folder / "%f.exr"}, {"GLCAST_N", "16"}, {"GLCAST_EVERY", "2"}}, true);
    EXPECT_EQ(outcome.exit_code, 0);
    for (int frame = 1; frame <= 5; ++frame)
        EXPECT_EQ(std::filesystem::exists(folder / (std::to_string(frame) + ".exr")), frame % 2 == 1)
            << frame;
}

// The time has come, and nothing new is drawn.
TEST(Rest, is_cast_as_it_was_drawn_last) { expect_the_body({READS, "rest", "1"}, {{"GLCAST_AFTER", "0.5"}}); }

TEST(Reads, that_never_come_lead_to_a_reason) {
    const CastRun run = cast({READS, "pbuffer-unread"});
    EXPECT_FALSE(run.capture);
    EXPECT_NE(run.outcome.err.find("pbuffer"), std::string::npos) << run.outcome.err;
}

} // namespace
} // namespace glcast::test
