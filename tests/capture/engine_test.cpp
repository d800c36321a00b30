// What a capture of a shape known in closed form must give.
#include <gtest/gtest.h>

#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

class Engine : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();
};

constexpr double sphere_radius = 0.8;
const glm::dvec3 sphere_centre(0.3, -0.2, 0.1);

void fine_sphere(const GlTable& gl) {
    set_lit(gl);
    set_diffuse(gl, {0.2f, 0.6f, 0.4f});
    draw_sphere(gl, sphere_centre, sphere_radius, 256);
}

struct SphereErrors {
    double depth_mean = 0, depth_max = 0;   ///< samples
    double normal_mean = 0, normal_max = 0; ///< degrees
    double colour_max = 0;
    long pixels = 0, miscovered = 0, without_normal = 0;
};

/// Against the sphere itself, one sample in from its silhouette, where neither tessellation nor pixel edges
/// count.
SphereErrors sphere_errors(const Cast& cast, glm::vec3 colour) {
    SphereErrors errors;
    for (const ViewImage& image : cast.images) {
        const Box& box = cast.report.box;
        const ImageAxes axes = image_axes(image.view.axis);
        for (int j = 0; j < image.n; ++j) {
            for (int i = 0; i < image.n; ++i) {
                const std::size_t pixel = std::size_t(j) * image.n + i;
                const glm::dvec3 ray = lattice_point(box, image.n, image.view.axis, i, j, 0) - sphere_centre;
                const double off = std::hypot(ray[axes.u], ray[axes.v]), sample = box.size / image.n;
                if (std::abs(off - sphere_radius) < sample) continue;
                errors.miscovered += image.covered(pixel) != (off < sphere_radius);
                if (off > sphere_radius || !image.covered(pixel)) continue;
                const double along = std::sqrt(sphere_radius * sphere_radius - off * off);
                glm::dvec3 truth = ray;
                truth[axes.depth] = image.view.side == Side::minus ? -along : along;
                const double depth =
                    (truth[axes.depth] + sphere_centre[axes.depth] - box.lo[axes.depth]) / box.size;
                const double error = std::abs(depth - image.depth[pixel]) * image.n;
                const double slope = along / sphere_radius; // error along the normal, not along the ray
                errors.depth_mean += error * slope;
                errors.depth_max = std::max(errors.depth_max, error * slope);
                errors.without_normal += image.normal[pixel].w == 0;
                const double angle = angle_between(truth, glm::dvec3(image.normal[pixel]));
                errors.normal_mean += angle;
                errors.normal_max = std::max(errors.normal_max, angle);
                errors.colour_max = std::max(errors.colour_max,
                                             double(glm::distance(glm::vec3(image.colour[pixel]), colour)));
                ++errors.pixels;
            }
        }
    }
    errors.depth_mean /= double(std::max(errors.pixels, 1L));
    errors.normal_mean /= double(std::max(errors.pixels, 1L));
    return errors;
}

void expect_sphere(const Cast& cast, double mean_angle, double max_angle) {
    ASSERT_TRUE(cast.report.ok) << cast.report.error;
    ASSERT_EQ(cast.images.size(), 6u);
    const SphereErrors e = sphere_errors(cast, {0.2f, 0.6f, 0.4f});
    testing::Test::RecordProperty("depth_mean", std::to_string(e.depth_mean));
    testing::Test::RecordProperty("normal_mean", std::to_string(e.normal_mean));
    EXPECT_GT(e.pixels, 6 * 3000);
    EXPECT_EQ(e.miscovered, 0);
    EXPECT_EQ(e.without_normal, 0);
    EXPECT_EQ(cast.report.pixels_without_normal, 0);
    EXPECT_LT(e.depth_mean, 3e-3);
    EXPECT_LT(e.depth_max, 1e-2);
    EXPECT_LT(e.normal_mean, mean_angle);
    EXPECT_LT(e.normal_max, max_angle);
    EXPECT_LT(e.colour_max, 1.0 / 255);
    printf("depth mean %g max %g samples, normal mean %g max %g deg, colour %g, %ld pixels, %d draws, box %g "
           "n %g\n",
           e.depth_mean, e.depth_max, e.normal_mean, e.normal_max, e.colour_max, e.pixels, cast.report.draws,
           cast.report.box_seconds, cast.report.normal_seconds);
}

TEST_F(Engine, SphereIsExact) {
    const Cast cast = capture(gl, fine_sphere, small_options(128));
    EXPECT_TRUE(cast.report.float_targets);
    expect_sphere(cast, 0.1, 0.3);
}

TEST_F(Engine, SixLightsGiveTheSameNormals) {
    EngineOptions options = small_options(128);
    const Cast one = capture(gl, fine_sphere, options);
    options.normals = NormalMethod::six_lights;
    options.box = one.report.box;
    const Cast six = capture(gl, fine_sphere, options);
    expect_sphere(six, 0.1, 0.3);
    EXPECT_EQ(six.report.draws, 6 * (1 + 6));
    const Difference d = difference(one, six);
    EXPECT_EQ(d.coverage, 0);
    EXPECT_LT(d.normal, glm::radians(0.1));
}

TEST_F(Engine, EightBitTargetsAreNearlyAsGood) {
    EngineOptions options = small_options(128);
    options.use_float_targets = false;
    const Cast cast = capture(gl, fine_sphere, options);
    EXPECT_FALSE(cast.report.float_targets);
    expect_sphere(cast, 0.5, 1.0);
}

TEST_F(Engine, NothingIsDrawnTwice) {
    EngineOptions options = small_options();
    options.box = Box{glm::dvec3(-1), 2};
    int calls = 0;
    const Cast cast = capture(
        gl, [&](const GlTable& table) { ++calls, fine_sphere(table); }, options);
    EXPECT_EQ(calls, 6 * 2);
    EXPECT_EQ(cast.report.draws, calls);
}

} // namespace
} // namespace glcast::test
