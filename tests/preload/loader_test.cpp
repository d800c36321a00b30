// The ways by which programs reach GL, and the processes and threads they do it in.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct Road {
    const char* name;
    std::vector<std::string> arguments;
};

void PrintTo(const Road& road, std::ostream* out) { *out << road.name; }

const Road roads[] = {
    {"glx_linked", {FIXTURE_GLX, "--loader", "linked"}},
    {"glx_getproc", {FIXTURE_GLX, "--loader", "getproc"}},
    {"glx_dlopen", {FIXTURE_GLX_DLOPEN, "--loader", "dlopen"}},
    {"glx_dlopen_deepbind", {FIXTURE_GLX_DLOPEN, "--loader", "dlopen-deepbind"}},
    {"egl_linked", {FIXTURE_EGL, "--loader", "linked"}},
    {"egl_getproc", {FIXTURE_EGL, "--loader", "getproc"}},
    {"egl_dlopen", {FIXTURE_EGL_DLOPEN, "--loader", "dlopen"}},
    {"egl_dlopen_deepbind", {FIXTURE_EGL_DLOPEN, "--loader", "dlopen-deepbind"}},
    {"glx_split", {FIXTURE_GLX_SPLIT, "--loader", "dlopen"}},
    {"glx_split_deepbind", {FIXTURE_GLX_SPLIT, "--loader", "dlopen-deepbind"}},
    {"egl_split", {FIXTURE_EGL_SPLIT, "--loader", "dlopen"}},
    {"egl_split_deepbind", {FIXTURE_EGL_SPLIT, "--loader", "dlopen-deepbind"}},
    {"second_thread", {FIXTURE_GLX, "--thread"}},
    {"egl_second_thread", {FIXTURE_EGL, "--thread"}},
    {"egl_two_windows", {FIXTURE_EGL, "--windows", "2"}},
    {"dlopen_in_second_thread", {FIXTURE_GLX_DLOPEN, "--loader", "dlopen", "--thread"}},
    {"egl_dlopen_in_second_thread", {FIXTURE_EGL_DLOPEN, "--loader", "dlopen", "--thread"}},
    {"deepbind_in_second_thread", {FIXTURE_GLX_DLOPEN, "--thread", "--loader", "dlopen-deepbind"}},
    {"two_windows", {FIXTURE_GLX, "--windows", "2"}},
    {"single_buffered", {FIXTURE_GLX, "--single-buffered"}},
};

/// AddressSanitizer refuses RTLD_DEEPBIND, and takes the place of the program when a library is looked for by
/// RUNPATH.
const bool sanitized = *GLCAST_SANITIZER_RUNTIME != 0;

class Loader : public testing::TestWithParam<Road> {};

TEST_P(Loader, is_cast_and_not_noticed) {
    std::vector<std::string> arguments = GetParam().arguments;
    if (sanitized && arguments.back() == "dlopen-deepbind")
        GTEST_SKIP() << "the sanitizer refuses RTLD_DEEPBIND";
    arguments.insert(arguments.end(),
                     {"--shape", "cube", "--way", "list", "--frames", "2", "--size", "160x120"});
    const FixtureRun plain = run_fixture(arguments, {}, false);
    const FixtureRun cast = cast_fixture(arguments);
    ASSERT_TRUE(cast.capture) << cast.outcome.err;
    EXPECT_EQ(cast.capture->images.size(), 6u);
    EXPECT_EQ(cast.outcome.exit_code, 0);
    EXPECT_EQ(plain.outcome.out, cast.outcome.out);
    EXPECT_TRUE(plain.pixels == cast.pixels);
    EXPECT_EQ(plain.errors, cast.errors);
    EXPECT_EQ(plain.state, cast.state);
}
INSTANTIATE_TEST_SUITE_P(Roads, Loader, testing::ValuesIn(roads),
                         [](const auto& info) { return info.param.name; });

/// Lines that say so; there must be one.
long captures(const Outcome& outcome) {
    const auto lines = glcast_lines(outcome);
    return std::count_if(lines.begin(), lines.end(),
                         [](const auto& line) { return line.starts_with("captured"); });
}

struct CastProgram {
    Outcome outcome;
    std::optional<Capture> capture;
};
CastProgram cast(const std::vector<std::string>& arguments) {
    const TemporaryFolder folder;
    CastProgram result;
    result.outcome = run_program(arguments, {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}}, true);
    if (captures(result.outcome)) result.capture = read_capture(folder / "cast.exr");
    return result;
}

/// A program, or a plugin, for each window system.
struct OnSystem {
    const char* name;
    const char* fixture;
    const char* forks;
    const char* plugin_name;
    const char* plugin;
};
void PrintTo(const OnSystem& system, std::ostream* out) { *out << system.name; }
const OnSystem systems[] = {{"GLX", FIXTURE_GLX, FORKS, "libcubes_plugin.so", CUBES_PLUGIN},
                            {"EGL", FIXTURE_EGL, FORKS_EGL, "libcubes_plugin_egl.so", CUBES_PLUGIN_EGL}};
class Process : public testing::TestWithParam<OnSystem> {};
class Plugin : public testing::TestWithParam<OnSystem> {};
INSTANTIATE_TEST_SUITE_P(Systems, Process, testing::ValuesIn(systems),
                         [](const auto& info) { return info.param.name; });
INSTANTIATE_TEST_SUITE_P(Systems, Plugin, testing::ValuesIn(systems),
                         [](const auto& info) { return info.param.name; });

TEST_P(Process, child_of_a_launcher_is_cast) {
    const std::string fixture = GetParam().fixture;
    const auto result = cast({"sh", "-c", fixture + " --shape cube --frames 1; exit 5"});
    EXPECT_TRUE(result.capture) << result.outcome.err;
    EXPECT_EQ(result.outcome.exit_code, 5);
}

/// The program has drawn before it becomes another, in the same process.
TEST_P(Process, what_a_program_becomes_is_cast) {
    const auto result = cast({GetParam().forks, "become"});
    EXPECT_TRUE(result.capture) << result.outcome.err;
    EXPECT_EQ(result.outcome.exit_code, 0) << result.outcome.err;
    EXPECT_EQ(captures(result.outcome), 1);
}

TEST_P(Process, forked_child_leaves_the_capture_alone) {
    const auto result = cast({GetParam().forks});
    ASSERT_TRUE(result.capture) << result.outcome.err;
    EXPECT_EQ(result.capture->info.frame, 2); // the first is empty
    EXPECT_EQ(result.outcome.exit_code, 0);
    EXPECT_EQ(captures(result.outcome), 1);
    EXPECT_EQ(result.outcome.err.find("nothing captured"), std::string::npos) << result.outcome.err;
}

TEST_P(Plugin, found_by_runpath_and_cast) {
    if (sanitized) GTEST_SKIP() << "the sanitizer is the caller of dlopen";
    const auto result = cast({PLUGIN_HOST, GetParam().plugin_name});
    EXPECT_TRUE(result.capture) << result.outcome.err;
    EXPECT_EQ(result.outcome.exit_code, 0) << result.outcome.err;
}

TEST_P(Plugin, bound_to_itself_is_cast_too) {
    if (sanitized) GTEST_SKIP() << "the sanitizer refuses RTLD_DEEPBIND";
    const auto result = cast({PLUGIN_HOST, GetParam().plugin, "deepbind"});
    EXPECT_TRUE(result.capture) << result.outcome.err;
    EXPECT_EQ(result.outcome.exit_code, 0) << result.outcome.err;
}

} // namespace
} // namespace glcast::test
