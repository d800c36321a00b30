// Programs that draw nothing new: what stands in their window is cast, when the time has come, at a signal,
// at a key.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/preload/key_presser.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 48;
constexpr double body = 6, grid = 0.04; // as in reads_test.cpp

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

void expect_the_body(const CastRun& run) {
    EXPECT_FALSE(run.outcome.timed_out) << run.outcome.err;
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(volume(*run.capture), body, grid * body) << run.outcome.err;
    for (const auto& [what, times] : run.capture->info.not_understood)
        EXPECT_TRUE(what.starts_with("a draw under")) << what; // the composite's
}

class AtRest : public testing::TestWithParam<std::string> {};
TEST_P(AtRest, is_cast_when_the_time_has_come) {
    expect_the_body(cast_program({RESTS, GetParam()}, n, {{"GLCAST_AFTER", "0.5"}, {"GLCAST_QUIT", "1"}}));
}
TEST_P(AtRest, is_cast_at_each_signal) {
    const CastRun run = cast_program({RESTS, GetParam(), "signals", "3"}, n, {{"GLCAST_SIGNAL", "USR1"}});
    expect_the_body(run);
    EXPECT_EQ(run.outcome.out, "cast 3 times\n") << run.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Rest, AtRest,
                         testing::Values("swap", "expose", "front", "front-marks", "picture-marks",
                                         "composite", "egl"),
                         test_name);

/// The toolkit goes on to show its picture, faster than is recorded.
TEST(Rest, of_a_body_whose_picture_is_shown_again_and_again_is_cast_with_a_line) {
    const CastRun run = cast_program({RESTS, "composites"}, n, {{"GLCAST_AFTER", "1"}, {"GLCAST_QUIT", "1"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(volume(*run.capture), body, grid * body);
    const auto says = [&](const char* what) { return run.outcome.err.find(what) != std::string::npos; };
    EXPECT_EQ(says("the window may show another picture"), says("too fast to be recorded\n"))
        << run.outcome.err;
}

/// Runs until the line comes, or the program ends.
std::string told_at_rest(const std::string& way, Environment environment) {
    const TemporaryFolder folder;
    environment["GLCAST_OUT"] = folder / "cast.exr";
    environment["GLCAST_N"] = "16";
    const Outcome outcome = run_program({"timeout", "4", RESTS, way}, environment, true);
    EXPECT_FALSE(std::filesystem::exists(folder / "cast.exr")) << outcome.err;
    return outcome.err;
}

TEST(Rest, casts_nothing_that_has_been_cleared_away) { told_at_rest("cleared", {{"GLCAST_AFTER", "0.5"}}); }

TEST(Rest, after_many_frames_at_once_casts_none_of_the_first_and_says_why) {
    const TemporaryFolder folder;
    std::ofstream(folder / "told");
    const CastRun run = cast_program({RESTS, "burst", "told"}, 16,
                                     {{"GLCAST_AFTER", "1"}, {"GLCAST_STATUS", folder / "told"}});
    EXPECT_FALSE(run.capture) << run.outcome.err;
    std::ifstream file(folder / "told");
    const std::string told{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(told.find("--nudge makes it draw"), std::string::npos) << told;
}

TEST(Nudge, brings_windows_back_to_the_screen) {
    expect_the_body(cast_program({RESTS, "mapped"}, n, {{"GLCAST_NUDGE", "1"}, {"GLCAST_QUIT", "1"}}));
}

TEST(Rest, is_cast_at_each_press_of_the_key) {
    x_server();
    const KeyPresser presser;
    const CastRun run = cast_program({RESTS, "swap"}, n,
                                     {{"GLCAST_KEY", "F12"}, {"GLCAST_CAPTURES", "2"}, {"GLCAST_QUIT", "1"}});
    expect_the_body(run);
    const auto lines = glcast_lines(run.outcome);
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [](const std::string& line) { return line.starts_with("captured frame 1 "); }),
              2)
        << run.outcome.err;
}

/// What the program does while it is cast.
class Meanwhile : public testing::TestWithParam<std::string> {};
TEST_P(Meanwhile, the_program_sees_nothing_of_it) {
    const std::vector<std::string> command = {RESTS, "swap", GetParam()};
    const TemporaryFolder folder;
    const auto environment = [&](const std::string& told) {
        std::ofstream(folder / told);
        return Environment{{"GLCAST_SIGNAL", "USR1"}, {"GLCAST_STATUS", folder / told}};
    };
    std::ofstream(folder / "plain") << "casting@";
    const Outcome plain = run_program(command, {{"GLCAST_STATUS", folder / "plain"}}, false);
    const CastRun run = cast_program(command, 128, environment("told"));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_EQ(run.outcome.out, plain.out);
    expect_the_body(run);
}
INSTANTIATE_TEST_SUITE_P(Rest, Meanwhile, testing::Values("exit", "close", "draw"), test_name);

} // namespace
} // namespace glcast::test
