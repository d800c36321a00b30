// What is drawn round the scene or behind it is not cast, and a line names it; floors and rooms are
// (programs/backdrops.c).
#include <gtest/gtest.h>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 48;
constexpr double body = 3; // wide
constexpr const char* told = "left out as a backdrop: ";

struct BackdropRun : CastRun {
    double width = 0; ///< of what was cast
    bool says(const std::string& text) const { return outcome.err.find(text) != std::string::npos; }
};

BackdropRun cast(const std::string& way, Environment environment = {}) {
    BackdropRun run{cast_program({BACKDROPS, way}, n, std::move(environment))};
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    if (run.capture) run.width = run.capture->info.box.size * (n - 4) / n;
    return run;
}

struct Kept {
    const char* way;
    double width; ///< of all; of backdrops that are kept, at least
};
class Backdrop : public testing::TestWithParam<Kept> {};

TEST_P(Backdrop, is_left_out_and_named) {
    const auto& [way, width] = GetParam();
    const BackdropRun run = cast(way);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(run.width, body, 0.02) << run.outcome.err;
    EXPECT_TRUE(run.says(told)) << run.outcome.err;
    EXPECT_TRUE(run.says("--backdrop keep")) << run.outcome.err;
    const BackdropRun kept = cast(way, {{"GLCAST_BACKDROP", "keep"}});
    ASSERT_TRUE(kept.capture) << kept.outcome.err;
    EXPECT_GT(kept.width, 0.99 * width);
    EXPECT_FALSE(kept.says(told)) << kept.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Kinds, Backdrop,
                         testing::Values(Kept{"sky_box", 120}, Kept{"plain_sky_box", 60},
                                         Kept{"near_sky_box", 26}, Kept{"dome", 120}, Kept{"half_dome", 120},
                                         Kept{"sky_plane", 200}, Kept{"photograph", 60},
                                         Kept{"vast_floor", 300}, Kept{"last", 120}, Kept{"masked", 40},
                                         Kept{"untested", 40}, Kept{"pinned", 6}),
                         [](const auto& info) { return std::string(info.param.way); });

class NoBackdrop : public testing::TestWithParam<Kept> {};

TEST_P(NoBackdrop, is_cast_without_a_word) {
    const auto& [way, width] = GetParam();
    const BackdropRun run = cast(way);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(run.width, width, width / 50) << run.outcome.err;
    EXPECT_FALSE(run.says(told)) << run.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Kinds, NoBackdrop,
                         testing::Values(Kept{"floor", 30}, Kept{"room", 15}, Kept{"relief", 80},
                                         Kept{"walls", 80}, Kept{"far_body", 50.67}, Kept{"alone", 120}),
                         [](const auto& info) { return std::string(info.param.way); });

TEST(Backdrops, over_a_ground_that_is_cast) {
    const BackdropRun run = cast("dome_and_ground");
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(run.width, 30, 0.2) << run.outcome.err;
    EXPECT_TRUE(run.says(told)) << run.outcome.err;
}

TEST(Backdrops, are_not_looked_for_in_a_box_that_is_asked_for) {
    const BackdropRun run = cast("vast_floor", {{"GLCAST_BOX", "-5,-5,-5,5,5,5"}});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->info.box.size, 10);
    EXPECT_FALSE(run.says(told)) << run.outcome.err;
}

} // namespace
} // namespace glcast::test
