// Views that a capture does not have: where they look from, and that the engine draws the same scene from
// there.
#include <gtest/gtest.h>

#include <algorithm>

#include "capture/reference_views.h"
#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

TEST(ReferenceViews, AreRotationsThatLookFromEverywhere) {
    std::vector<glm::dmat3> frames = {glm::dmat3(1.0)};
    for (const glm::dmat4& rotation : reference_rotations(max_reference_views)) {
        frames.emplace_back(rotation);
        EXPECT_NEAR(glm::determinant(frames.back()), 1, 1e-12);
        const glm::dmat3 unit = frames.back() * glm::transpose(frames.back());
        for (int k = 0; k < 9; ++k) EXPECT_NEAR(unit[k / 3][k % 3], k % 4 == 0, 1e-12);
    }
    ASSERT_EQ(frames.size(), 7u);
    double nearest = 90; // degrees between lines of sight, in the capture frame
    for (std::size_t a = 0; a < frames.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const glm::dmat3 between =
                frames[a] * glm::transpose(frames[b]); // row by row: dot products of axes
            for (int k = 0; k < 9; ++k)
                nearest = std::min(nearest,
                                   glm::degrees(std::acos(std::min(1.0, std::abs(between[k / 3][k % 3])))));
        }
    EXPECT_GE(nearest, 27);
}

TEST(ReferenceViews, AsManyAsAskedFor) {
    EXPECT_EQ(reference_rotations(1).size(), 1u);
    EXPECT_EQ(reference_rotations(6).size(), 1u);
    EXPECT_EQ(reference_rotations(7).size(), 2u);
    EXPECT_EQ(reference_rotations(32).size(), 6u);
    EXPECT_EQ(reference_rotations(7)[1], reference_rotations(36)[1]);
    EXPECT_EQ(reference_name("/a.b/c.exr", 2), "/a.b/c.reference-2.exr");
    EXPECT_EQ(reference_name("c", 2), "c.reference-2.exr");
}

/// Every pixel of a turned capture lies on the box, where its colour says.
TEST(ReferenceViews, TheEngineDrawsTheSameSceneTurned) {
    OsmesaContext context;
    const glm::dvec3 lo(-1, -0.5, 0.25), hi(2, 1, 1);
    const std::vector<glm::vec3> colours = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    const DrawFunction draw = [&](const GlTable& gl) {
        gl.Enable(GL_DEPTH_TEST);
        draw_box(gl, lo, hi, colours);
    };
    EngineOptions options = small_options(64);
    const Cast straight = capture(context.gl(), draw, options);
    ASSERT_TRUE(straight.report.ok);
    for (const glm::dmat4& rotation : reference_rotations(max_reference_views)) {
        options.eye_to_capture = rotation;
        options.search = turned_box(straight.report.box, rotation);
        const Cast turned = capture(context.gl(), draw, options);
        ASSERT_TRUE(turned.report.ok) << turned.report.error;
        EXPECT_GT(turned.report.box.size, 2) << "found, not as large as the search";
        EXPECT_LT(turned.report.box.size, 3.7);
        long seen = 0;
        for (const ViewImage& image : turned.images)
            for (int j = 0; j < image.n; ++j)
                for (int i = 0; i < image.n; ++i) {
                    const std::size_t p = std::size_t(j) * image.n + i;
                    if (!image.covered(p)) continue;
                    const glm::dvec3 at =
                        glm::transpose(glm::dmat3(rotation)) *
                        lattice_point(turned.report.box, image.n, image.view.axis, i, j, image.depth[p]);
                    const double off[] = {at.x - lo.x, hi.x - at.x, at.y - lo.y,
                                          hi.y - at.y, at.z - lo.z, hi.z - at.z};
                    const auto face = std::min_element(
                        off, off + 6, [](double a, double b) { return std::abs(a) < std::abs(b); });
                    EXPECT_LT(std::abs(*face), 1e-4);
                    ++seen;
                    if (std::count_if(off, off + 6, [](double d) { return std::abs(d) < 1e-3; }) != 1)
                        continue;
                    EXPECT_LT(glm::distance(glm::vec3(image.colour[p]), colours[std::size_t(face - off)]),
                              0.01f);
                }
        EXPECT_GT(seen, 2000);
    }
}

} // namespace
} // namespace glcast::test
