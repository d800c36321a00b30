// A cast that takes long is told of beforehand, tells how far it is, and ends in time.
#include "shim/preload/patience.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

using preload::Patience;

/// A cast whose every render takes so long, by a clock of its own.
struct SlowCast {
    std::vector<std::string> slow, progress;
    double time = 1e6, render = 0;
    Patience patience;

    SlowCast(double seconds_a_render, double most)
        : render(seconds_a_render), patience(most,
                                             {[this](const std::string& t) { slow.push_back(t); },
                                              [this](const std::string& t) { progress.push_back(t); }},
                                             [this] { return Patience::Seconds(time); }) {}
    void draw(int times) {
        for (int i = 0; i < times; ++i) patience.render_begins(), time += render;
    }
};

TEST(Patience, says_nothing_of_what_is_quick) {
    SlowCast cast(0.01, 0);
    cast.draw(1000);
    EXPECT_TRUE(cast.slow.empty());
    EXPECT_TRUE(cast.progress.empty());
}

TEST(Patience, says_beforehand_what_will_take_long) {
    SlowCast cast(2, 0);
    cast.draw(2);
    EXPECT_TRUE(cast.slow.empty()); // the first time tells of shaders being compiled, too
    cast.draw(1);
    ASSERT_EQ(cast.slow.size(), 1u);
    EXPECT_NE(cast.slow[0].find("takes 2 s to draw"), std::string::npos) << cast.slow[0];
    EXPECT_NE(cast.slow[0].find("40 s or more"), std::string::npos) << cast.slow[0];
    cast.draw(50);
    EXPECT_EQ(cast.slow.size(), 1u);
}

TEST(Patience, says_nothing_where_the_first_time_alone_is_slow) {
    SlowCast cast(3, 0);
    cast.draw(1);
    cast.render = 0.1;
    cast.draw(100);
    EXPECT_TRUE(cast.slow.empty());
}

TEST(Patience, says_at_once_where_the_first_time_is_very_slow) {
    SlowCast cast(6, 0);
    cast.draw(2);
    EXPECT_EQ(cast.slow.size(), 1u);
}

TEST(Patience, tells_how_far_it_is_once_a_second) {
    SlowCast cast(0.6, 0);
    cast.draw(4);
    ASSERT_FALSE(cast.progress.empty());
    EXPECT_TRUE(cast.progress.back().starts_with("the box, drawn ")) << cast.progress.back();
    cast.patience.image_is_done({Axis::y, Side::minus, 3});
    cast.draw(100);
    EXPECT_TRUE(cast.progress.back().starts_with("axis y, layer 3, drawn 10")) << cast.progress.back();
    EXPECT_GT(cast.progress.size(), 40u);
    EXPECT_LT(cast.progress.size(), 64u); // of 104 renders in 62 seconds
}

TEST(Patience, ends_in_time) {
    SlowCast cast(1, 10);
    EXPECT_NO_THROW(cast.draw(10));
    EXPECT_TRUE(cast.patience.over().empty());
    EXPECT_THROW(cast.draw(1), std::runtime_error);
    EXPECT_NE(cast.patience.over().find("gave up after 10 s"), std::string::npos) << cast.patience.over();
}

class MaxSeconds : public testing::TestWithParam<Environment> {};
TEST_P(MaxSeconds, ends_a_cast_and_not_the_program) {
    const TemporaryFolder folder;
    Environment environment = GetParam();
    environment.insert(
        {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}, {"GLCAST_MAX_SECONDS", "0.0001"}});
    const FixtureRun plain = run_fixture({FIXTURE_GLX, "--shape", "teapot", "--frames", "3"}, {}, false),
                     run =
                         run_fixture({FIXTURE_GLX, "--shape", "teapot", "--frames", "3"}, environment, true);
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_EQ(run.pixels, plain.pixels);
    EXPECT_EQ(run.errors, plain.errors);
    EXPECT_EQ(run.state, plain.state);
    const auto lines = glcast_lines(run.outcome);
    ASSERT_EQ(lines.size(), 2u) << run.outcome.err; // "hooked" is the other
    EXPECT_TRUE(lines[1].starts_with("nothing captured: gave up after 0.0001 s, as asked (--max-seconds)"))
        << lines[1];
    EXPECT_TRUE(std::filesystem::is_empty(folder.string()));
}
INSTANTIATE_TEST_SUITE_P(Patience, MaxSeconds,
                         testing::Values(Environment{}, Environment{{"GLCAST_BOX", "-9,-9,-40,9,9,0"}},
                                         Environment{{"GLCAST_INCLUDE", "lines"}}));

TEST(Patience, an_option_that_is_no_time_is_refused) {
    for (const char* odd : {"0", "-1", "nan", "inf", "1e999", "5 s"}) {
        const Outcome outcome =
            run_program({FIXTURE_GLX, "--shape", "cube", "--frames", "1"},
                        {{"GLCAST_OUT", "/tmp/no.exr"}, {"GLCAST_MAX_SECONDS", odd}}, true);
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_NE(outcome.err.find("expected seconds, more than 0"), std::string::npos) << outcome.err;
    }
}

} // namespace
} // namespace glcast::test
