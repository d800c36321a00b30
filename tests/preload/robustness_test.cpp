// Whatever happens, the program runs on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/preload/program_run.h"

extern char** environ;

namespace glcast::test {
namespace {

const bool sanitized = *GLCAST_SANITIZER_RUNTIME != 0;

bool says(const Outcome& outcome, const std::string& start) {
    const auto lines = glcast_lines(outcome);
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.starts_with(start); });
}

struct Hardship {
    Outcome outcome;
    std::optional<Capture> capture;
};
Hardship run_hardship(const std::string& what, Environment environment = {}) {
    const TemporaryFolder folder;
    environment.insert({{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}});
    Hardship result;
    result.outcome = run_program({HARDSHIPS, what}, environment, true);
    if (std::filesystem::exists(folder / "cast.exr")) result.capture = read_capture(folder / "cast.exr");
    return result;
}

TEST(Robustness, a_capture_is_on_disk_when_its_frame_ends) {
    const Hardship run = run_hardship("exit");
    EXPECT_EQ(run.outcome.exit_code, 7) << run.outcome.err;
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->images.size(), 6u);
}

TEST(Robustness, deep_streams) {
    const Hardship run = run_hardship("deep");
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(run.capture) << run.outcome.err;
}

TEST(Robustness, a_million_draws) {
    const Hardship run = run_hardship("tiny", {{"GLCAST_N", "8"}, {"GLCAST_BOX", "-2,-2,-2,2,2,2"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(run.capture) << run.outcome.err;
}

TEST(Robustness, a_frame_beyond_the_memory_limit_is_dropped_and_the_next_one_cast) {
    const Hardship run = run_hardship("tiny", {{"GLCAST_MEMORY", "8"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(says(run.outcome, "a frame cannot be recorded: out of memory")) << run.outcome.err;
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->info.frame, 3);
}

TEST(Robustness, no_memory_left) {
    if (sanitized) GTEST_SKIP() << "the sanitizer needs the address space";
    const Outcome plain = run_program({HARDSHIPS, "starved"}, {}, false);
    ASSERT_EQ(plain.exit_code, 0) << plain.err;
    const Hardship run = run_hardship("starved");
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(says(run.outcome, "a frame cannot be recorded: out of memory")) << run.outcome.err;
}

/// The recording is small, its images are not.
TEST(Robustness, no_memory_left_for_the_capture) {
    if (sanitized) GTEST_SKIP() << "the sanitizer needs the address space";
    const Hardship run = run_hardship("narrow", {{"GLCAST_N", "2048"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(says(run.outcome, "nothing captured: ")) << run.outcome.err;
    EXPECT_FALSE(run.capture);
}

/// In the middle of captures, whose writer has a thread of its own.
TEST(Robustness, children_are_forked_while_frames_are_cast) {
    const Hardship run = run_hardship("forks", {{"GLCAST_EVERY", "1"}, {"GLCAST_N", "64"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(run.capture) << run.outcome.err;
}

TEST(Robustness, threads_draw_while_frames_are_cast) {
    const Hardship run = run_hardship("threads", {{"GLCAST_EVERY", "1"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(run.capture) << run.outcome.err;
}

/// A part of a frame may come from a context that another thread destroys while it is cast.
TEST(Robustness, contexts_are_destroyed_while_they_are_cast) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({PASSING},
                                        {{"GLCAST_OUT", folder / "%f.exr"},
                                         {"GLCAST_N", "8"},
                                         {"GLCAST_LAYERS", "1"},
                                         {"GLCAST_EVERY", "1"},
                                         {"GLCAST_CAPTURES", "0"}},
                                        true);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.signal << " " << outcome.err;
    EXPECT_TRUE(says(outcome, "captured")) << outcome.err;
    EXPECT_FALSE(says(outcome, "nothing captured")) << outcome.err;
}

TEST(Robustness, nothing_is_left_of_a_capture_that_is_killed) {
    const TemporaryFolder folder;
    const std::string status = folder / "status";
    ASSERT_EQ(mkfifo(status.c_str(), 0600), 0);
    const int pipe = open(status.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(pipe, 0);
    std::vector<std::string> variables = {"DISPLAY=" + x_server().display(),
                                          "LIBGL_ALWAYS_SOFTWARE=1",
                                          "GLCAST_N=2048",
                                          "GLCAST_OUT=" + folder / "cast.exr",
                                          "GLCAST_STATUS=" + status,
                                          std::string("LD_PRELOAD=") + GLCAST_SANITIZER_RUNTIME +
                                              " " GLCAST_SHIM,
                                          "ASAN_OPTIONS=detect_leaks=0"};
    std::vector<char*> environment;
    for (std::string& variable : variables) environment.push_back(variable.data());
    environment.push_back(nullptr);
    std::string program = FIXTURE_GLX;
    char* arguments[] = {program.data(), nullptr};
    pid_t child = 0;
    ASSERT_EQ(posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments, environment.data()), 0);
    std::string heard;
    pollfd wait = {pipe, POLLIN, 0};
    while (heard.find("casting") == std::string::npos && poll(&wait, 1, 60'000) > 0) {
        char text[512];
        const ssize_t got = read(pipe, text, sizeof text);
        if (got > 0) heard.append(text, std::size_t(got));
        if (got == 0 && waitpid(child, nullptr, WNOHANG) == child) break;
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(pipe);
    EXPECT_NE(heard.find("casting"), std::string::npos) << heard;
    EXPECT_EQ(heard.find("captured"), std::string::npos) << "too fast to be killed";
    for (const auto& entry : std::filesystem::directory_iterator(folder.string()))
        EXPECT_EQ(entry.path().filename(), "status");
}

class OtherPreload : public testing::TestWithParam<bool> {};
TEST_P(OtherPreload, is_no_obstacle) {
    if (sanitized) GTEST_SKIP() << "the sanitizer wants to be first";
    const std::string ours = GLCAST_SHIM, other = OTHER_PRELOAD;
    const TemporaryFolder folder;
    const Outcome outcome =
        run_program({FIXTURE_GLX, "--shape", "cube", "--frames", "2"},
                    {{"GLCAST_OUT", folder / "cast.exr"},
                     {"GLCAST_N", "32"},
                     {"LD_PRELOAD", GetParam() ? ours + " " + other : other + " " + ours}},
                    false);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome, "captured")) << outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Order, OtherPreload, testing::Bool(),
                         [](const auto& info) { return info.param ? "ours_first" : "ours_last"; });

class Masked : public testing::TestWithParam<const char*> {};
TEST_P(Masked, is_cast_all_the_same) {
    const std::vector<std::string> program = {FIXTURE_GLX, "--shape", "teapot", "--frames",
                                              "1",         "--size",  "160x120"};
    const FixtureRun whole = cast_fixture(program),
                     less = cast_fixture(program, {{"GLCAST_MASK", GetParam()}});
    ASSERT_TRUE(whole.capture && less.capture) << less.outcome.err;
    EXPECT_EQ(whole.pixels, less.pixels);
    const CaptureDifference difference = compare(*whole.capture, *less.capture);
    EXPECT_GT(difference.covered, 1000);
    EXPECT_EQ(difference.coverage, 0);
    EXPECT_LT(difference.depth, 1e-5); // under a thousandth of a sample
    EXPECT_LT(difference.colour, 0.01);
    EXPECT_LT(difference.normal, 0.05); // 8 bits
}
INSTANTIATE_TEST_SUITE_P(Features, Masked, testing::Values("float", "glsl", "float,glsl"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::replace(name.begin(), name.end(), ',', '_');
                             return name;
                         });

TEST(Robustness, without_framebuffers_it_is_refused) {
    const FixtureRun run =
        cast_fixture({FIXTURE_GLX, "--shape", "cube", "--frames", "2"}, {{"GLCAST_MASK", "fbo"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_FALSE(run.capture);
    EXPECT_TRUE(says(run.outcome, "nothing captured: this OpenGL has no framebuffer objects"))
        << run.outcome.err;
}

} // namespace
} // namespace glcast::test
