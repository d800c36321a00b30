// Every shape, drawn in every way, cast from a running GLX program: the ways give the same images, and the
// program draws the same pixels and sees the same errors as without us.
#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

using fixtures::Way;

std::vector<std::string> fixture(const std::string& shape, Way way) {
    return {FIXTURE_GLX, "--shape", shape,    "--way",  fixtures::way_names()[static_cast<int>(way)],
            "--frames",  "2",       "--size", "160x120"};
}

void expect_complete(const FixtureRun& cast) {
    ASSERT_TRUE(cast.capture) << cast.outcome.err;
    EXPECT_GE(cast.capture->images.size(), 6u);
    EXPECT_EQ(cast.capture->info.layers, Layers::complete);
    EXPECT_EQ(cast.capture->info.n, 64);
    EXPECT_EQ(cast.capture->info.frame, 1);
    EXPECT_EQ(cast.outcome.exit_code, 0) << cast.outcome.err;
    EXPECT_TRUE(cast.capture->info.not_understood.empty())
        << cast.capture->info.not_understood.begin()->first;
}

void expect_unnoticed(const FixtureRun& plain, const FixtureRun& cast) {
    EXPECT_EQ(plain.outcome.out, cast.outcome.out); // a hash a frame
    EXPECT_TRUE(plain.pixels == cast.pixels) << "the window's pixels differ";
    EXPECT_FALSE(plain.pixels.empty());
    EXPECT_EQ(plain.errors, cast.errors);
    EXPECT_EQ(plain.state, cast.state);
}

/// Float noise: depth in 1/64 of a sample of n = 64; a pixel may flip only where a silhouette runs through
/// its centre.
void expect_same(const Capture& reference, const Capture& other) {
    const CaptureDifference d = compare(reference, other);
    EXPECT_GT(d.covered, 500);
    EXPECT_LE(d.coverage, d.covered / 200);
    EXPECT_LT(d.depth, 1e-4);
    EXPECT_LT(d.normal, 4e-3); // half floats in the file
    EXPECT_LT(d.colour, 4e-3);
}

class Shape : public testing::TestWithParam<std::string> {};

TEST_P(Shape, is_the_same_in_every_way_of_drawing_and_the_program_sees_nothing) {
    std::optional<Capture> reference;
    for (int w = 0; w < static_cast<int>(fixtures::way_names().size()); ++w) {
        const Way way = static_cast<Way>(w);
        if (!fixtures::can_draw(GetParam(), way)) continue;
        SCOPED_TRACE(fixtures::way_names()[w]);
        const FixtureRun plain = run_fixture(fixture(GetParam(), way), {}, false);
        const FixtureRun cast = cast_fixture(fixture(GetParam(), way));
        ASSERT_NO_FATAL_FAILURE(expect_complete(cast));
        expect_unnoticed(plain, cast);
        if (!reference) reference = cast.capture;
        expect_same(*reference, *cast.capture);
    }
}
INSTANTIATE_TEST_SUITE_P(Fixtures, Shape, testing::ValuesIn(fixtures::shape_names()),
                         [](const auto& info) { return info.param; });

TEST(Transparency, errors_state_and_overlay_stay_as_they_are) {
    const std::vector<std::string> arguments = {
        FIXTURE_GLX, "--shape", "torus",         "--way",     "nested_lists", "--frames", "4",
        "--size",    "160x120", "--make-errors", "--overlay", "--angle-step", "10"};
    const FixtureRun plain = run_fixture(arguments, {}, false);
    const FixtureRun cast = cast_fixture(arguments, {{"GLCAST_FRAME", "3"}});
    EXPECT_FALSE(plain.state.empty());
    EXPECT_NE(plain.errors.find("0x"), std::string::npos) << plain.errors; // there are errors to be kept
    expect_unnoticed(plain, cast);
    ASSERT_TRUE(cast.capture) << cast.outcome.err;
    EXPECT_EQ(cast.capture->info.frame, 3);
}

struct LayersCase {
    const char* layers;
    const char* shaders;
    Layers known;
    LayerMethod method;
};

TEST(Transparency, however_layers_are_found) {
    const LayersCase cases[] = {{"auto", "", Layers::complete, LayerMethod::peel},
                                {"3", "", Layers::incomplete, LayerMethod::peel},
                                {"slab", "", Layers::complete, LayerMethod::slab},
                                {"auto", "0", Layers::complete, LayerMethod::slab},
                                {"1", "", Layers::outer, LayerMethod::none}};
    const std::vector<std::string> arguments = {
        FIXTURE_GLX, "--shape", "twopot",  "--way",         "nested_lists", "--frames",
        "3",         "--size",  "160x120", "--make-errors", "--angle-step", "10"};
    const FixtureRun plain = run_fixture(arguments, {}, false);
    std::optional<Capture> peeled;
    for (const LayersCase& c : cases) {
        SCOPED_TRACE(std::string(c.layers) + " shaders " + c.shaders);
        const FixtureRun cast =
            cast_fixture(arguments, {{"GLCAST_LAYERS", c.layers}, {"GLCAST_SHADERS", c.shaders}});
        expect_unnoticed(plain, cast);
        ASSERT_TRUE(cast.capture) << cast.outcome.err;
        EXPECT_EQ(cast.capture->info.layers, c.known);
        EXPECT_EQ(cast.capture->info.layer_method, c.method);
        if (!peeled) peeled = cast.capture;
        const CaptureDifference difference = compare(*peeled, *cast.capture);
        EXPECT_LE(difference.coverage, difference.covered / 1000);
        EXPECT_LT(difference.depth * 64, 0.01);
    }
    EXPECT_GE(peeled->info.layer_count[0], 6); // a pot in a pot
}

TEST(Transparency, overlay_is_not_cast) {
    const std::vector<std::string> plain = {FIXTURE_GLX, "--shape", "cube", "--frames", "1"};
    std::vector<std::string> with_overlay = plain;
    with_overlay.push_back("--overlay");
    const FixtureRun a = cast_fixture(plain), b = cast_fixture(with_overlay);
    ASSERT_TRUE(a.capture && b.capture) << a.outcome.err << b.outcome.err;
    EXPECT_EQ(compare(*a.capture, *b.capture).coverage, 0);
}

TEST(Transparency, six_lights_give_the_normals_of_signed_ones) {
    const std::vector<std::string> arguments = {FIXTURE_GLX, "--shape", "torus", "--frames", "1"};
    const FixtureRun one = cast_fixture(arguments),
                     six = cast_fixture(arguments, {{"GLCAST_NORMALS", "six"}});
    ASSERT_TRUE(one.capture && six.capture) << one.outcome.err << six.outcome.err;
    EXPECT_EQ(six.capture->info.normals, "six");
    EXPECT_LT(compare(*one.capture, *six.capture).normal, 0.02);
}

} // namespace
} // namespace glcast::test
