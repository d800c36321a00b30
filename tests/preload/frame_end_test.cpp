// The calls by which programs end a frame.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct End {
    const char* program;
    const char* how;
};
void PrintTo(const End& end, std::ostream* out) { *out << end.how; }

const End ends[] = {
    {ENDS, "swap"},
    {ENDS, "msc"},
    {ENDS, "copy"},
    {ENDS, "front flush"},
    {ENDS, "front finish"},
    {ENDS, "front wait"},
    {ENDS, "single flush"},
    {ENDS, "single finish"},
    {ENDS, "single wait"},
    {ENDS_EGL, "swap"},
    {ENDS_EGL, "damage-khr"},
    {ENDS_EGL, "damage-ext"},
    {ENDS_EGL, "front flush"},
    {ENDS_EGL, "front finish"},
    {ENDS_EGL, "front wait"},
    {ENDS_EGL, "front wait-client"},
};

class FrameEnd : public testing::TestWithParam<End> {};

/// The first frame is empty, the second is cast.
TEST_P(FrameEnd, is_seen) {
    const TemporaryFolder folder;
    const End& end = GetParam();
    const Outcome plain = run_program({end.program, end.how}, {}, false);
    ASSERT_EQ(plain.exit_code, 0) << "this driver has it not";
    const Outcome outcome =
        run_program({end.program, end.how}, {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}}, true);
    EXPECT_EQ(outcome.exit_code, 0);
    const auto lines = glcast_lines(outcome);
    ASSERT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& line) {
        return line.starts_with("captured");
    })) << outcome.err;
    EXPECT_EQ(read_capture(folder / "cast.exr").info.frame, 2);
}
INSTANTIATE_TEST_SUITE_P(Ends, FrameEnd, testing::ValuesIn(ends), [](const auto& info) {
    std::string name = std::string(info.param.program) == ENDS ? "glx_" : "egl_";
    name += info.param.how;
    for (char& c : name)
        if (c == ' ' || c == '-') c = '_';
    return name;
});

} // namespace
} // namespace glcast::test
