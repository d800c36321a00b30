// Windows programs by OpenGL and by Direct3D's fixed functions, cast under Wine: every hit against the boxes
// that they draw.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/preload/chiral_truth.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {
namespace fs = std::filesystem;

struct Windows {
    const char* name;
    const char* program;
    std::vector<std::string> options, arguments;
    Environment environment;
    const char* says = "";
};
void PrintTo(const Windows& one, std::ostream* out) { *out << one.name; }

constexpr const char* again = "starting it again with --direct3d";
Environment offscreen(const char* mode) {
    return {{"WINE_D3D_CONFIG",
             std::string("MaxVersionGL=0x10000,shader_backend=none,OffscreenRenderingMode=") + mode}};
}
const Windows all_windows[] = {
    {"opengl", "boxes_gl", {}, {}, {}},
    {"child_window", "boxes_gl", {}, {"child"}, {}},
    {"two_contexts", "boxes_gl", {}, {"two"}, {}},
    {"thread", "boxes_gl", {}, {"thread"}, {}},
    {"launcher", "boxes_gl", {}, {"launcher"}, {}},
    {"direct3d_9", "boxes_d3d9", {"--direct3d"}, {}, {}},
    {"direct3d_9_by_itself", "boxes_d3d9", {}, {}, {}, again},
    {"direct3d_9_in_a_framebuffer", "boxes_d3d9", {"--direct3d"}, {}, offscreen("fbo")},
    {"direct3d_8", "boxes_d3d8", {"--direct3d"}, {}, {}},
    {"direct3d_8_by_itself", "boxes_d3d8", {}, {}, {}, again},
    {"direct3d_8_in_a_framebuffer", "boxes_d3d8", {"--direct3d"}, {}, offscreen("fbo")},
};
constexpr int widths[] = {WINE_WIDTHS};

/// glcast-run makes Wine's folder, once for all tests of a process.
Outcome cast(const std::string& file, std::vector<std::string> options, const std::string& program,
             const std::vector<std::string>& arguments, Environment environment) {
    options.insert(options.begin(),
                   {GLCAST_RUN, "--headless", "--quit", "--timeout", "100", "-n", "48", "-o", file});
    options.insert(options.end(), {"--", "wine", program});
    options.insert(options.end(), arguments.begin(), arguments.end());
    Command command;
    command.arguments = options;
    environment.insert({{"WINEPREFIX", WINE_PREFIX}, {"WINEDEBUG", "-all"}, {"LP_NUM_THREADS", "1"}});
    command.environment.insert(command.environment.end(), environment.begin(), environment.end());
    command.timeout_seconds = 280;
    return run(command);
}

class Wine : public testing::TestWithParam<std::tuple<int, Windows>> {};
TEST_P(Wine, boxes_are_cast_as_they_are_and_never_mirrored) {
    const auto& [width, one] = GetParam();
    const TemporaryFolder folder;
    const std::string name = std::string(one.program) + ".exe", file = folder / "cast.exr";
    const Outcome outcome =
        cast(file, one.options, std::string(WINE_PROGRAMS "/") + std::to_string(width) + "/" + name,
             one.arguments, one.environment);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("frame 1 of " + name + " is cast"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(one.says), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("no GL seen"), std::string::npos) << outcome.err;
    expect_chiral_boxes(read_capture(file), {1, 1, 1}, 0.05);
}
INSTANTIATE_TEST_SUITE_P(Width, Wine,
                         testing::Combine(testing::ValuesIn(widths), testing::ValuesIn(all_windows)),
                         [](const auto& info) {
                             return std::to_string(std::get<0>(info.param)) + "_" +
                                    std::get<1>(info.param).name;
                         });

TEST(WineFolder, is_made_before_the_time_of_the_program_begins) {
    const TemporaryFolder folder;
    const Outcome outcome =
        cast(folder / "cast.exr", {}, WINE_PROGRAMS "/64/boxes_gl.exe", {}, {{"WINEPREFIX", folder / "new"}});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("making Wine's folder " + folder / "new" + " first"), std::string::npos)
        << outcome.err;
    EXPECT_TRUE(fs::exists(folder / "new/.update-timestamp"));
}

TEST(WineHelpers, say_nothing_where_the_variables_alone_are_set) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"wine", WINE_PROGRAMS "/64/boxes_gl.exe"},
                                        {{"GLCAST_OUT", folder / "cast.exr"},
                                         {"GLCAST_N", "16"},
                                         {"GLCAST_QUIT", "1"},
                                         {"WINEDEBUG", "-all"},
                                         {"WINEPREFIX", WINE_PREFIX},
                                         {"WINEDLLOVERRIDES", "mscoree,mshtml="}},
                                        true);
    EXPECT_TRUE(fs::exists(folder / "cast.exr")) << outcome.err;
    EXPECT_EQ(outcome.err.find("no GL seen"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("captured frame 1 of boxes_gl.exe"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace glcast::test
