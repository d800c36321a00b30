// Programs with several windows (programs/windows.c): the window that shows most is cast, or the one that is
// asked for.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 64;
constexpr double box_edge = 2, body_edge = 3;

struct WindowRun {
    Outcome outcome;
    double extent = -1; ///< edge of what was cast; -1: nothing was
    bool perspective = false;
};

WindowRun cast(const std::string& kind, Environment environment = {}, int signal = 0) {
    const TemporaryFolder folder;
    environment["GLCAST_OUT"] = folder / "cast.exr";
    environment["GLCAST_N"] = std::to_string(n);
    WindowRun result;
    result.outcome = run_program({WINDOWS, kind}, environment, true);
    EXPECT_EQ(result.outcome.signal, signal) << result.outcome.err;
    EXPECT_EQ(result.outcome.exit_code, signal ? -1 : 0) << result.outcome.err;
    if (std::filesystem::exists(folder / "cast.exr"))
        result.extent = read_capture(folder / "cast.exr").info.box.size * (n - 4) / n;
    return result;
}

bool says(const WindowRun& run, const std::string& text) {
    return run.outcome.err.find(text) != std::string::npos;
}

class SeveralWindows : public testing::TestWithParam<const char*> {};

TEST_P(SeveralWindows, the_one_that_shows_most_is_cast) {
    const WindowRun run = cast(GetParam());
    EXPECT_NEAR(run.extent, body_edge, 0.02) << run.outcome.err;
    EXPECT_TRUE(says(run, "of window 2 \"Model\"")) << run.outcome.err;
}

TEST_P(SeveralWindows, one_is_asked_for) {
    const std::pair<const char*, double> wanted[] = {
        {"1", box_edge}, {"2", body_edge}, {"Tool", box_edge}, {"Model", body_edge}};
    for (const auto& [window, edge] : wanted) {
        SCOPED_TRACE(window);
        const WindowRun run = cast(GetParam(), {{"GLCAST_WINDOW", window}});
        EXPECT_NEAR(run.extent, edge, 0.02) << run.outcome.err;
    }
}
INSTANTIATE_TEST_SUITE_P(Kinds, SeveralWindows, testing::Values("two", "late", "threads"),
                         [](const auto& info) { return info.param; });

TEST(Window, is_asked_for_by_the_id_that_the_list_of_windows_shows) {
    const WindowRun none = cast("two", {{"GLCAST_WINDOW", "Picture"}});
    EXPECT_EQ(none.extent, -1);
    EXPECT_TRUE(says(none, "no window that was drawn to is --window Picture, there are: 1 \"Tool box\" (0x"))
        << none.outcome.err;
    const std::string& text = none.outcome.err;
    const std::size_t at = text.find("(0x", text.find("2 \"Model\""));
    ASSERT_NE(at, std::string::npos);
    const std::string id = text.substr(at + 1, text.find(')', at) - at - 1);
    const WindowRun run = cast("two", {{"GLCAST_WINDOW", id}}); // ids repeat from run to run
    EXPECT_NEAR(run.extent, body_edge, 0.02) << id << run.outcome.err;
}

TEST(Window, of_four_views_is_the_perspective_one) {
    const WindowRun run = cast("quad");
    EXPECT_NEAR(run.extent, body_edge, 0.02) << run.outcome.err;
    EXPECT_TRUE(says(run, "of window 4 \"Perspective\"")) << run.outcome.err;
}

TEST(Window, s_of_a_program_are_all_listed) {
    const TemporaryFolder folder;
    const WindowRun run = cast("quad", {{"GLCAST_LIST", folder / "list.png"}});
    const char* titles[] = {"Top", "Front", "Side", "Perspective"};
    for (int i = 0; i < 4; ++i) {
        const std::string line = std::string(i == 3 ? "perspective" : "orthographic with depth test") +
                                 ", viewport 0 0 120 120, window " + std::to_string(i + 1) + " \"" +
                                 titles[i] + "\"";
        EXPECT_TRUE(says(run, line)) << run.outcome.err;
    }
    EXPECT_GT(std::filesystem::file_size(folder / "list.png"), 4000u);
}

TEST(Window, that_is_never_drawn_to_keeps_nobody_waiting) {
    const auto start = std::chrono::steady_clock::now();
    const WindowRun run = cast("idle", {{"GLCAST_QUIT", "1"}}, SIGTERM);
    EXPECT_NEAR(run.extent, box_edge, 0.02) << run.outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15))
        << "it would have run for 20 s";
}

TEST(Window, has_the_title_of_the_one_that_it_is_in) {
    const WindowRun run = cast("nested", {{"GLCAST_WINDOW", "Main"}});
    EXPECT_NEAR(run.extent, body_edge, 0.02) << run.outcome.err;
    EXPECT_TRUE(says(run, "\"Main window\"")) << run.outcome.err;
}

class WhileTheServerIsHeld : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(WhileTheServerIsHeld, the_program_runs_on) {
    const auto& [variable, value] = GetParam();
    const TemporaryFolder folder;
    const Environment environment = {{variable, *value ? value : folder / "list.png"}};
    for (const char* kind : {"grabs", "grabs_alone"}) {
        SCOPED_TRACE(kind);
        const WindowRun run = cast(kind, environment);
        EXPECT_TRUE(says(run, "the X server does not answer while the program swaps") ||
                    (std::string(kind) == "grabs_alone" && std::string(variable) == "GLCAST_N"))
            << run.outcome.err;
        if (std::string(variable) == "GLCAST_LIST")
            EXPECT_TRUE(says(run, "group 1 ")) << run.outcome.err;
        else
            EXPECT_NEAR(run.extent, body_edge, 0.02) << run.outcome.err;
    }
}
INSTANTIATE_TEST_SUITE_P(Questions, WhileTheServerIsHeld,
                         testing::Values(std::pair("GLCAST_N", "64"), std::pair("GLCAST_LIST", ""),
                                         std::pair("GLCAST_WINDOW", "Model")),
                         [](const auto& info) { return std::string(info.param.first); });

TEST(Window, the_server_s_silence_is_counted) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program(
        {WINDOWS, "grabs"}, {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}, {"GLCAST_WINDOW", "Model"}}, true);
    ASSERT_TRUE(std::filesystem::exists(folder / "cast.exr")) << outcome.err;
    const auto counted = read_capture(folder / "cast.exr").info.not_understood;
    EXPECT_TRUE(counted.contains("questions about windows that the X server did not answer in time"));
}

} // namespace
} // namespace glcast::test
