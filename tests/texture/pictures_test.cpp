// Pictures of textured levels: the normals that come out are those that were baked in.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/texture/baked.h"
#include "tools/render/raster.h"
#include "tools/texture/bake.h"

namespace glcast::test {
namespace {

const glm::dvec3 half(0.6, 0.5, 0.4);
const glm::dmat3 turn = turned({1, 2, 3}, 12);

OrthoView view_along(const glm::dvec3& towards) {
    OrthoView view;
    view.back = glm::normalize(towards);
    view.right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), view.back));
    view.up = glm::cross(view.back, view.right);
    view.width = view.height = 256;
    view.pixel = 2.0 / view.width;
    return view;
}

/// Where a ray from the camera meets the turned box, and the box's normal there; how far from its nearest
/// edge.
struct Met {
    bool any = false;
    glm::dvec3 normal{0};
    double from_edge = 0;
};
Met meet_box(const OrthoView& view, int x, int y) {
    const glm::dvec3 from = view.right * ((x + 0.5 - view.width / 2.0) * view.pixel) +
                            view.up * ((view.height / 2.0 - y - 0.5) * view.pixel);
    const glm::dvec3 p = from * turn, d = -view.back * turn; // in the box's own axes
    double enter = -1e9, leave = 1e9;
    int side = 0;
    for (int k = 0; k < 3; ++k) {
        const double near = (-std::copysign(half[k], d[k]) - p[k]) / d[k],
                     far = (std::copysign(half[k], d[k]) - p[k]) / d[k];
        if (near > enter) enter = near, side = k;
        leave = std::min(leave, far);
    }
    if (enter >= leave) return {};
    Met met{true, glm::dvec3(0), 1e9};
    met.normal[side] = d[side] < 0 ? 1 : -1;
    for (int k = 0; k < 3; ++k)
        if (k != side) met.from_edge = std::min(met.from_edge, half[k] - std::abs(p[k] + enter * d[k]));
    met.normal = turn * met.normal;
    return met;
}

/// Twelve big triangles and some at its corners have the means of three sides for vertex normals, so the
/// frames of the normal map are skewed and turn within each triangle: a picture that makes them otherwise
/// than the texture was made for has dark and bright wedges from every corner.
TEST(TexturedPicture, ShowsTheFlatSidesOfABoxFlat) {
    const int n = 96;
    const Source source = make_source(cast_body(*box({0, 0, 0}, half, turn), test_box, n));
    Level level;
    level.mesh = coarse(source.full, 12);
    level.texture = bake_texture(level.mesh, source.captured, {.size = 512});
    const double sample = source.captured.sample();
    std::size_t seen = 0, wrong = 0;
    double sum = 0;
    for (const glm::dvec3 towards :
         {glm::dvec3(1, 0.7, 0.4), glm::dvec3(-0.5, 1, -0.8), glm::dvec3(0.3, -0.6, 1)}) {
        const OrthoView view = view_along(towards);
        const SeenImage image = rasterise(level.mesh, level.texture, view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const std::size_t p = std::size_t(y) * view.width + x;
                const Met met = meet_box(view, x, y);
                if (!met.any || !image.covered[p] || met.from_edge < 2 * sample) continue;
                const double off = degrees_between(image.normal[p], glm::vec3(met.normal));
                ++seen, sum += off, wrong += off > 2;
            }
    }
    ASSERT_GT(seen, 30'000u);
    EXPECT_LT(sum / double(seen), 0.5);
    EXPECT_EQ(wrong, 0u) << "pixels two samples and more from an edge";
}

} // namespace
} // namespace glcast::test
