// What a capture of a shape known in closed form must give.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

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

constexpr int parallels = 96;

void sphere(const GlTable& gl) {
    set_lit(gl);
    set_diffuse(gl, {0.2f, 0.6f, 0.4f});
    draw_sphere(gl, sphere_centre, sphere_radius, parallels);
}

/// How far the middle of a quad lies inside the sphere.
double sagitta() {
    const double half_step = std::numbers::pi / (2 * parallels);
    return sphere_radius * half_step * half_step; // twice, along both curves, half of its square
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
    const double inside = sagitta() / cast.report.box.size * cast.images[0].n; // samples
    EXPECT_GT(e.pixels, 6 * 2000);
    EXPECT_EQ(e.miscovered, 0);
    EXPECT_EQ(e.without_normal, 0);
    EXPECT_EQ(cast.report.pixels_without_normal, 0);
    EXPECT_LT(e.depth_mean, 0.7 * inside + 1e-3); // the mean over a quad is 2/3 of its middle
    EXPECT_LT(e.depth_max, inside + 2e-3);
    EXPECT_LT(e.normal_mean, mean_angle);
    EXPECT_LT(e.normal_max, max_angle);
    EXPECT_LT(e.colour_max, 1.0 / 255);
}

TEST_F(Engine, SphereIsExact) {
    const Cast cast = capture(gl, sphere, small_options(128));
    EXPECT_TRUE(cast.report.float_targets);
    expect_sphere(cast, 0.1, 0.3);
}

const Box sphere_box{sphere_centre - 0.85, 1.7};

TEST_F(Engine, SixLightsGiveTheSameNormals) {
    EngineOptions options = small_options(64);
    options.box = sphere_box;
    const Cast one = capture(gl, sphere, options);
    options.normals = NormalMethod::six_lights;
    const Cast six = capture(gl, sphere, options);
    expect_sphere(six, 0.1, 0.3);
    EXPECT_EQ(six.report.draws, 6 * (1 + 6));
    const Difference d = difference(one, six);
    EXPECT_EQ(d.coverage, 0);
    EXPECT_LT(d.normal, glm::radians(0.1));
}

TEST_F(Engine, EightBitTargetsAreNearlyAsGood) {
    EngineOptions options = small_options(64);
    options.box = sphere_box;
    options.use_float_targets = false;
    for (NormalMethod method : {NormalMethod::signed_lights, NormalMethod::six_lights}) {
        options.normals = method;
        const Cast cast = capture(gl, sphere, options);
        EXPECT_FALSE(cast.report.float_targets);
        expect_sphere(cast, 0.5, 1.0);
    }
}

/// Where a ray along an axis enters (minus) or leaves (plus) the cube of half edge h about the origin, in its
/// own frame.
bool cross_cube(glm::dvec3 origin, glm::dvec3 direction, double h, Side side, double& t) {
    double enter = -1e9, leave = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (-h - origin[axis]) / direction[axis], b = (h - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    t = side == Side::minus ? enter : leave;
    return enter < leave;
}

TEST_F(Engine, TiltedCubeIsExact) {
    const auto draw = [](const GlTable& gl) {
        set_lit(gl);
        gl.Rotated(40, 1, 2, 3);
        draw_box(gl, glm::dvec3(-0.5), glm::dvec3(0.5));
    };
    const Cast cast = capture(gl, draw, small_options(128));
    const Box& box = cast.report.box;
    const glm::dmat3 turn(
        glm::rotate(glm::dmat4(1), glm::radians(40.0), glm::normalize(glm::dvec3(1, 2, 3))));
    long pixels = 0, wrong = 0;
    double worst = 0, sum = 0;
    for (const ViewImage& image : cast.images) {
        for (std::size_t pixel = 0; pixel < image.depth.size(); ++pixel) {
            const Axis axis = image.view.axis;
            glm::dvec3 along(0);
            along[static_cast<int>(axis)] = box.size;
            const glm::dvec3 start = lattice_point(box, 128, axis, int(pixel % 128), int(pixel / 128), 0);
            double t = 0;
            const bool hit =
                cross_cube(start * turn, along * turn, 0.5, image.view.side, t); // transposed: into its frame
            wrong += hit != image.covered(pixel);
            if (!hit || !image.covered(pixel)) continue;
            const double error = std::abs(t - image.depth[pixel]) * 128;
            worst = std::max(worst, error);
            sum += error;
            ++pixels;
        }
    }
    EXPECT_GT(pixels, 6 * 5000);
    EXPECT_LT(wrong, pixels / 2000); // rays along an edge
    EXPECT_LT(sum / double(pixels), 1e-4);
    EXPECT_LT(worst, 1e-3);
    RecordProperty("mean", std::to_string(sum / double(pixels)));
}

TEST_F(Engine, NothingIsDrawnTwice) {
    EngineOptions options = small_options();
    options.box = Box{glm::dvec3(-1), 2};
    int calls = 0;
    const Cast cast = capture(
        gl, [&](const GlTable& table) { ++calls, sphere(table); }, options);
    EXPECT_EQ(calls, 6 * 2);
    EXPECT_EQ(cast.report.draws, calls);
}

TEST_F(Engine, ImagesComeInOrder) {
    EngineOptions options = small_options(8);
    options.box = Box{glm::dvec3(-1), 2};
    const Cast cast = capture(
        gl, [](const GlTable& table) { draw_box(table, glm::dvec3(-0.5), glm::dvec3(0.5)); }, options);
    ASSERT_EQ(cast.images.size(), 6u);
    for (int k = 0; k < 6; ++k) {
        EXPECT_EQ(cast.images[k].view, (View{Axis(k / 2), Side(k % 2), 0}));
        EXPECT_EQ(cast.images[k].n, 8);
        EXPECT_EQ(cast.images[k].depth.size(), 64u);
    }
}

TEST_F(Engine, TheReceiverCanStop) {
    EngineOptions options = small_options(16);
    options.box = sphere_box;
    int images = 0;
    const EngineReport report = run_capture(gl, sphere, options, [&](ViewImage&&) { return ++images < 2; });
    EXPECT_FALSE(report.ok);
    EXPECT_EQ(images, 2);
    EXPECT_EQ(report.error, "stopped by the receiver of the images");
}

TEST_F(Engine, ResolutionsOutOfRangeAreRefused) {
    for (int n : {-1, 0, 7, 8193, 1 << 30}) {
        int calls = 0;
        const Cast cast = capture(
            gl, [&](const GlTable&) { ++calls; }, small_options(n));
        EXPECT_FALSE(cast.report.ok);
        EXPECT_NE(cast.report.error.find(std::to_string(n)), std::string::npos) << cast.report.error;
        EXPECT_EQ(calls, 0);
    }
}

TEST_F(Engine, ADriverWithSmallFramebuffersIsAsked) {
    static const GlTable& real = gl;
    GlTable small = gl;
    small.GetIntegerv = [](GLenum name, GLint* values) {
        real.GetIntegerv(name, values);
        if (name == GL_MAX_RENDERBUFFER_SIZE) values[0] = 32;
    };
    const Cast cast = capture(small, sphere, small_options(64));
    EXPECT_EQ(cast.report.error, "n is 64, this OpenGL draws at most 32");
}

TEST_F(Engine, NoFramebufferObjects) {
    GlTable old = gl;
    old.GenFramebuffers = nullptr;
    const Cast cast = capture(old, sphere, small_options());
    EXPECT_FALSE(cast.report.ok);
    EXPECT_EQ(cast.report.error, "no framebuffer objects in this OpenGL");
}

TEST_F(Engine, AGivenBoxThatMissesTheSceneIsAnError) {
    EngineOptions options = small_options();
    options.box = Box{glm::dvec3(50), 1};
    EXPECT_EQ(capture(gl, sphere, options).report.error,
              "nothing solid was drawn inside the box that was asked for, from (50, 50, 50) to (51, 51, 51)");
    options.box = Box{glm::dvec3(0), 0};
    EXPECT_EQ(capture(gl, sphere, options).report.error, "the box has no size");
}

TEST_F(Engine, TheSameTwiceIsTheSameToTheBit) {
    const auto draw = [](const GlTable& table) { draw_sphere(table, sphere_centre, sphere_radius, 24); };
    const Cast a = capture(gl, draw, small_options()), b = capture(gl, draw, small_options());
    const Difference d = difference(a, b);
    EXPECT_EQ(a.report.box.lo, b.report.box.lo);
    EXPECT_EQ(d.depth + d.colour + d.normal + double(d.coverage), 0);
}

} // namespace
} // namespace glcast::test
