// The box is found by drawing alone.
#include <gtest/gtest.h>

#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

class FindBox : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();

    std::optional<Box> find(const DrawFunction& draw, const EngineOptions& options) {
        return find_box(gl, draw, options);
    }
};

DrawFunction brick(glm::dvec3 lo, glm::dvec3 hi) {
    return [=](const GlTable& gl) {
        gl.Enable(GL_DEPTH_TEST);
        draw_box(gl, lo, hi);
    };
}

/// The object is centred and, in its longest axis, ends 2 samples from the sides.
void expect_tight(const std::optional<Box>& box, glm::dvec3 lo, glm::dvec3 hi, int n,
                  double tolerance_samples = 0.1) {
    ASSERT_TRUE(box);
    const double sample = box->size / n;
    const glm::dvec3 extent = hi - lo, centre = box->lo + 0.5 * box->size;
    const double longest = std::max({extent.x, extent.y, extent.z});
    EXPECT_NEAR(longest / sample, n - 4, tolerance_samples);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR((centre[axis] - 0.5 * (lo + hi)[axis]) / sample, 0, tolerance_samples);
}

TEST_F(FindBox, OffCentre) {
    const glm::dvec3 lo(0.2, -0.9, 0.55), hi(0.6, -0.3, 0.6);
    expect_tight(find(brick(lo, hi), small_options(64)), lo, hi, 64);
}

TEST_F(FindBox, TinyInAHugeSearchVolume) {
    const glm::dvec3 lo(123.4, -77.7, 5.0), hi = lo + glm::dvec3(0.03, 0.01, 0.02);
    EngineOptions options = small_options(64);
    options.search = {glm::dvec3(-500), 1000};
    // The scene itself moves by a part in 2^24 of where it is: that is 1/20 sample here.
    expect_tight(find(brick(lo, hi), options), lo, hi, 64, 0.3);
}

TEST_F(FindBox, ThinNeedle) {
    const glm::dvec3 lo(-3, 0.101, 0.201), hi(4, 0.1011, 0.2011);
    EngineOptions options = small_options(64);
    options.search = {glm::dvec3(-50), 100};
    expect_tight(find(brick(lo, hi), options), lo, hi, 64);
}

TEST_F(FindBox, BiggerThanTheSearchVolume) {
    const glm::dvec3 lo(-30, -20, -10), hi(70, 20, 10);
    expect_tight(find(brick(lo, hi), small_options(64)), lo, hi, 64);
}

TEST_F(FindBox, OutsideTheSearchVolume) {
    const glm::dvec3 lo(5, 5, 5), hi(6, 7, 6);
    expect_tight(find(brick(lo, hi), small_options(64)), lo, hi, 64);
}

TEST_F(FindBox, FlatSheet) {
    const glm::dvec3 lo(-0.5, -0.25, 0.3), hi(0.5, 0.25, 0.3);
    const auto sheet = [=](const GlTable& gl) {
        gl.Begin(GL_QUADS);
        gl.Vertex3d(lo.x, lo.y, lo.z), gl.Vertex3d(hi.x, lo.y, lo.z);
        gl.Vertex3d(hi.x, hi.y, lo.z), gl.Vertex3d(lo.x, hi.y, lo.z);
        gl.End();
    };
    expect_tight(find(sheet, small_options(64)), lo, hi, 64);
}

TEST_F(FindBox, ClipPlanesCutTheObject) {
    const auto cut = [](const GlTable& gl) {
        const GLdouble plane[] = {-1, 0, 0, 0.25}; // x < 1/4
        gl.ClipPlane(GL_CLIP_PLANE0, plane);
        gl.Enable(GL_CLIP_PLANE0);
        draw_box(gl, glm::dvec3(-0.75, -0.1, -0.1), glm::dvec3(0.75, 0.1, 0.1));
        gl.Disable(GL_CLIP_PLANE0);
    };
    expect_tight(find(cut, small_options(64)), {-0.75, -0.1, -0.1}, {0.25, 0.1, 0.1}, 64, 1.0);
}

TEST_F(FindBox, IsInTheCaptureFrame) {
    EngineOptions options = small_options(64);
    options.eye_to_capture =
        glm::dmat4(0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 0, 0, 10, 20, 30, 1); // x y z -> y z x, twice as big
    const auto draw = brick({0.1, 0.2, 0.3}, {0.2, 0.5, 0.4});
    expect_tight(find(draw, options), {10.4, 20.6, 30.2}, {11.0, 20.8, 30.4}, 64);
}

TEST_F(FindBox, SettlesInFewDraws) {
    int calls = 0;
    const auto draw = brick(glm::dvec3(-0.5), glm::dvec3(0.5));
    find([&](const GlTable& table) { ++calls, draw(table); }, small_options(64));
    EXPECT_EQ(calls, 1 + 2 * 9); // once to note places, which this one does not know
}

TEST_F(FindBox, NothingDrawn) {
    EXPECT_FALSE(find([](const GlTable&) {}, small_options(64)));
    const Cast cast = capture(
        gl, [](const GlTable&) {}, small_options(64));
    EXPECT_FALSE(cast.report.ok);
    EXPECT_EQ(cast.report.error, "nothing solid was drawn");
    EXPECT_TRUE(cast.images.empty());
}

} // namespace
} // namespace glcast::test
