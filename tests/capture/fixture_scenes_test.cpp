// The fixtures through the engine: every direct way of drawing gives the same images, and their box is that
// of the truth. What lists hold reaches the forced table only through the replayer, so lists are tested
// there.
#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

using fixtures::Way;

class FixtureScenes : public testing::TestWithParam<std::string> {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();

    Cast cast_of(Way way, const EngineOptions& options) {
        fixtures::Scene scene(gl, GetParam(), way);
        return capture(
            gl, [&](const GlTable& table) { scene.draw_shape(table); }, options);
    }
};

TEST_P(FixtureScenes, EveryWayOfDrawingGivesTheSameImages) {
    EngineOptions options = small_options(64);
    const Cast plain = cast_of(Way::immediate, options);
    ASSERT_TRUE(plain.report.ok) << plain.report.error;
    EXPECT_EQ(plain.report.pixels_without_normal, 0);
    options.box = plain.report.box;
    for (Way way : {Way::client_arrays, Way::interleaved_arrays, Way::buffers, Way::evaluators}) {
        if (!fixtures::can_draw(GetParam(), way)) continue;
        SCOPED_TRACE(fixtures::way_names()[static_cast<std::size_t>(way)]);
        const Cast cast = cast_of(way, options);
        ASSERT_TRUE(cast.report.ok) << cast.report.error;
        long covered = 0, off = 0;
        for (std::size_t k = 0; k < 6; ++k) {
            const ViewImage &a = plain.images[k], &b = cast.images[k];
            for (std::size_t i = 0; i < a.depth.size(); ++i) {
                covered += a.covered(i);
                off += a.covered(i) != b.covered(i) || std::abs(a.depth[i] - b.depth[i]) * options.n > 0.01 ||
                       glm::distance(a.colour[i], b.colour[i]) > 0.5f / 255 ||
                       glm::distance(a.normal[i], b.normal[i]) > 0.01f;
            }
        }
        EXPECT_GT(covered, 1000);
        EXPECT_LE(off, covered / 500); // rays along an edge
    }
}

TEST_P(FixtureScenes, TheBoxIsThatOfTheTruth) {
    const int n = 128;
    fixtures::Scene scene(gl, GetParam(), Way::immediate);
    const auto box = find_box(
        gl, [&](const GlTable& table) { scene.draw_shape(table); }, small_options(n));
    ASSERT_TRUE(box);
    glm::dvec3 lo(1e9), hi(-1e9);
    for (const auto& position : fixtures::truth(GetParam()).positions) {
        lo = glm::min(lo, glm::dvec3(position));
        hi = glm::max(hi, glm::dvec3(position));
    }
    const double sample = box->size / n;
    const glm::dvec3 extent = hi - lo, centre = box->lo + 0.5 * box->size;
    EXPECT_NEAR(std::max({extent.x, extent.y, extent.z}) / sample, n - 4, 0.05);
    EXPECT_LT(glm::distance(centre, 0.5 * (lo + hi)) / sample, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FixtureScenes, testing::ValuesIn(fixtures::shape_names()),
                         [](const auto& info) { return info.param; });

} // namespace
} // namespace glcast::test
