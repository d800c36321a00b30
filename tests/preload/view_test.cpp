// The axes of a cast: the model's own, and what is seen is never mirrored, however the program sets up its view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

// As in programs/window.c.
const glm::dvec3 boxes[3][2] = {{{0, 0, 0}, {1, 1, 3}}, {{1, 0, 0}, {3, 1, 1}}, {{0, 1, 2}, {1, 2, 3}}};

struct Way {
    const char* name;
    glm::dvec3 scale; ///< capture coordinates of a model point: this times it
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

// Where model and screen differ in handedness, z is turned round. The stretched one keeps its volume.
const Way ways[] = {
    {"look_at", {1, 1, 1}},
    {"look_at_pushed", {1, 1, 1}},
    {"own_product", {1, 1, 1}},
    {"view_in_projection", {1, 1, 1}},
    {"stretched", {1, 2, 0.5}},
    {"mirrored_modelview", {1, 1, -1}},
    {"mirrored_projection", {1, 1, -1}},
    {"left_handed", {1, 1, -1}},
};

double distance_to_box(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 lo = glm::min(a, b), hi = glm::max(a, b);
    const glm::dvec3 outside = glm::max(glm::max(lo - p, p - hi), 0.0);
    const glm::dvec3 inside = glm::min(p - lo, hi - p);
    const double depth = std::min({inside.x, inside.y, inside.z});
    return depth > 0 ? depth : glm::length(outside);
}

class ViewAxes : public testing::TestWithParam<Way> {};

TEST_P(ViewAxes, are_the_models_own_and_not_mirrored) {
    const TemporaryFolder folder;
    const std::string file = folder / "cast.exr";
    const Outcome outcome =
        run_program({VIEWS, GetParam().name}, {{"GLCAST_OUT", file}, {"GLCAST_N", "48"}}, true);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Capture capture = read_capture(file);
    const glm::dvec3 scale = GetParam().scale;
    const double sample = capture.info.box.size / capture.info.n;
    long hits[3] = {}, wrong_normals = 0, all = 0;
    for (const ViewImage& image : capture.images) {
        for (int j = 0; j < image.n; ++j) {
            for (int i = 0; i < image.n; ++i) {
                const std::size_t at = std::size_t(j) * image.n + i;
                if (!image.covered(at)) continue;
                const glm::dvec3 p =
                    lattice_point(capture.info.box, image.n, image.view.axis, i, j, image.depth[at]);
                double nearest = 1e9;
                for (int b = 0; b < 3; ++b) {
                    const double d = distance_to_box(p, boxes[b][0] * scale, boxes[b][1] * scale);
                    hits[b] += d < 1e-3;
                    nearest = std::min(nearest, d);
                }
                ASSERT_LT(nearest, 0.01 * sample) << p.x << ' ' << p.y << ' ' << p.z;
                ++all;
                // From outside, the drawn normal looks back along the ray: right side out.
                const double towards = image.normal[at][static_cast<int>(image.view.axis)] *
                                       (image.view.side == Side::plus ? 1 : -1);
                wrong_normals += image.view.layer == 0 && image.normal[at].w > 0 && towards < 0.9;
            }
        }
    }
    EXPECT_GT(all, 1000);
    EXPECT_EQ(wrong_normals, 0);
    for (const long hit : hits) EXPECT_GT(hit, 100);
}
INSTANTIATE_TEST_SUITE_P(Ways, ViewAxes, testing::ValuesIn(ways), [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
