// Opaque is what blending makes opaque: hulls through which a box is seen are not cast, and boxes that hide
// what is behind them are, whatever their alpha is (programs/blends.c).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 48;

CastRun cast(const std::vector<std::string>& way, Environment environment = {}) {
    std::vector<std::string> arguments = {BLENDS};
    arguments.insert(arguments.end(), way.begin(), way.end());
    CastRun run = cast_program(arguments, n, std::move(environment));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    return run;
}

/// Edge of what was drawn, without the two samples of margin about it.
double extent(const Capture& capture) { return capture.info.box.size * (n - 4) / n; }

/// Pixels seen from +z: of the red box, of what is blue, and others.
struct Seen {
    double red = 0, blue = 0, other = 0; ///< areas
    int layers = 0;
};
Seen from_above(const Capture& capture) {
    Seen seen;
    const double square = std::pow(capture.info.box.size / n, 2);
    for (const ViewImage& image : capture.images) {
        seen.layers = std::max(seen.layers, image.view.layer);
        if (image.view.axis != Axis::z || image.view.side != Side::plus || image.view.layer != 0) continue;
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
            if (!image.covered(i)) continue;
            const glm::vec4& c = image.colour[i];
            const bool red = c.r > 0.99f && c.b<0.01f, blue = c.b> 0.99f && c.r < 0.01f;
            (red ? seen.red : blue ? seen.blue : seen.other) += square;
        }
    }
    return seen;
}

class Hulls : public testing::TestWithParam<const char*> {};

TEST_P(Hulls, that_let_a_box_be_seen_are_not_cast) {
    const CastRun run = cast({GetParam()});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(extent(*run.capture), 2, 0.01);
    const Seen seen = from_above(*run.capture);
    EXPECT_NEAR(seen.red, 4, 0.2);
    EXPECT_EQ(seen.blue + seen.other, 0);
    EXPECT_EQ(seen.layers, 0);
}
INSTANTIATE_TEST_SUITE_P(Blends, Hulls,
                         testing::Values("constant_alpha", "constant_colour", "transparency", "glow",
                                         "glow_by_alpha", "premultiplied_glass", "tint", "xor", "noop",
                                         "greatest_over_light", "least_over_dark"),
                         [](const auto& info) { return std::string(info.param); });

class Solids : public testing::TestWithParam<const char*> {};

TEST_P(Solids, are_cast_whatever_their_alpha_is) {
    const CastRun run = cast({GetParam()});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(extent(*run.capture), 5, 0.02);
    const Seen seen = from_above(*run.capture);
    EXPECT_NEAR(seen.red, 4, 0.4);
    EXPECT_NEAR(seen.blue, 4, 0.4);
    EXPECT_EQ(seen.other, 0);
}
INSTANTIATE_TEST_SUITE_P(Blends, Solids,
                         testing::Values("opaque_without_alpha", "opaque_by_low_alpha",
                                         "opaque_premultiplied", "opaque_by_constant", "copied",
                                         "greatest_over_dark", "least_over_light"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Blends, of_which_nothing_is_solid_are_refused_with_the_option_that_keeps_them) {
    for (const char* way : {"glow", "transparency", "constant_alpha"}) {
        const CastRun run = cast({way, "alone"});
        EXPECT_FALSE(run.capture);
        EXPECT_NE(run.outcome.err.find("--transparent keep"), std::string::npos) << run.outcome.err;
        const CastRun kept = cast({way, "alone"}, {{"GLCAST_TRANSPARENT", "keep"}});
        ASSERT_TRUE(kept.capture) << kept.outcome.err;
        EXPECT_NEAR(extent(*kept.capture), 4, 0.02);
    }
}

TEST(Blends, by_colour_alone_are_told_of) {
    const CastRun run = cast({"greatest_over_dark"});
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_EQ(run.capture->info.not_understood.size(), 1u) << run.outcome.err;
}

} // namespace
} // namespace glcast::test
