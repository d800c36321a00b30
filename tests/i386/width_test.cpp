// The 32-bit library makes the same images of a 32-bit program as the 64-bit one of its twin.
#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

using fixtures::Way;

std::vector<std::string> arguments(const char* program, const std::string& shape, const std::string& way) {
    return {program, "--shape", shape, "--way", way, "--frames", "2", "--size", "160x120"};
}

/// Float noise: the fixture computes its vertices, and the driver its images, by other instructions.
void expect_same(const Capture& a, const Capture& b) {
    const CaptureDifference d = compare(a, b);
    EXPECT_GT(d.covered, 500);
    EXPECT_LE(d.coverage, d.covered / 200);
    EXPECT_LT(d.depth * a.info.n, 0.05); // samples
    EXPECT_LT(d.normal, 1e-2);
    EXPECT_LT(d.colour, 1e-2);
    EXPECT_NEAR(a.info.box.size, b.info.box.size, 1e-4 * a.info.box.size);
}

class Width : public testing::TestWithParam<std::string> {};
TEST_P(Width, changes_no_image_in_any_way_of_drawing_and_the_program_sees_nothing) {
    for (int w = 0; w < static_cast<int>(fixtures::way_names().size()); ++w) {
        if (!fixtures::can_draw(GetParam(), static_cast<Way>(w))) continue;
        const std::string way = fixtures::way_names()[w];
        SCOPED_TRACE(way);
        const FixtureRun plain = run_fixture(arguments(FIXTURE_GLX, GetParam(), way), {}, false);
        const FixtureRun narrow = cast_fixture(arguments(FIXTURE_GLX, GetParam(), way));
        const FixtureRun wide = cast_fixture(arguments(FIXTURE_GLX_64, GetParam(), way));
        ASSERT_TRUE(narrow.capture) << narrow.outcome.err;
        ASSERT_TRUE(wide.capture) << wide.outcome.err;
        EXPECT_EQ(narrow.outcome.err.find("ELF class"), std::string::npos);
        expect_same(*wide.capture, *narrow.capture);
        EXPECT_EQ(plain.outcome.exit_code, narrow.outcome.exit_code);
        EXPECT_EQ(plain.outcome.out, narrow.outcome.out);
        EXPECT_TRUE(plain.pixels == narrow.pixels);
        EXPECT_EQ(plain.errors, narrow.errors);
        EXPECT_EQ(plain.state, narrow.state);
    }
}
INSTANTIATE_TEST_SUITE_P(I386, Width, testing::ValuesIn(fixtures::shape_names()),
                         [](const auto& info) { return info.param; });

TEST(SmallStack, of_4_bytes_is_cast) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program(
        {SMALL_STACK}, {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "48"}, {"GLCAST_PRETEND", "1.5"}},
        true);
    EXPECT_EQ(outcome.signal, 0) << outcome.err;
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NEAR(volume(read_capture(folder / "cast.exr")), 6, 0.3); // three boxes (programs/chiral.c)
}

} // namespace
} // namespace glcast::test
