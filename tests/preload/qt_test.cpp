// A Qt 5 program of ours (programs/qt_widget.cpp): the scene is drawn into a framebuffer object, and Qt
// composes the window.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

class QtWidget : public testing::TestWithParam<const char*> {};

TEST_P(QtWidget, s_body_is_cast) {
    constexpr int n = 64;
    const TemporaryFolder folder;
    const std::string kind = GetParam();
    const std::vector<std::string> command =
        kind == "one" ? std::vector<std::string>{QT_WIDGET} : std::vector<std::string>{QT_WIDGET, kind};
    const Outcome outcome = run_program(command,
                                        {{"GLCAST_OUT", folder / "cast.exr"},
                                         {"GLCAST_N", std::to_string(n)},
                                         {"QT_QPA_PLATFORM", "xcb"},
                                         {"QT_LOGGING_RULES", "*=false"}},
                                        true);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_TRUE(std::filesystem::exists(folder / "cast.exr")) << outcome.err;
    const Capture capture = read_capture(folder / "cast.exr");
    EXPECT_NEAR(capture.info.box.size * (n - 4) / n, 3, 0.02);
    long covered = 0; // of three boxes seen along z: 4 of 9 unit squares
    for (const ViewImage& image : capture.images)
        if (image.view == View{Axis::z, Side::plus, 0})
            for (std::size_t i = 0; i < image.depth.size(); ++i) covered += image.covered(i);
    const double square = capture.info.box.size / n;
    EXPECT_NEAR(covered * square * square, 4, 0.3);
}
INSTANTIATE_TEST_SUITE_P(Kinds, QtWidget, testing::Values("one", "two"),
                         [](const auto& info) { return info.param; });

} // namespace
} // namespace glcast::test
