// The camera in a matrix: random ones found again, and matrices that hold none.
#include "capture/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

namespace glcast {
namespace {

constexpr int rounds = 2000;

class Random {
  public:
    double between(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(engine); }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
            if (glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
        }
    }
    glm::dmat4 rotation() { return glm::rotate(glm::dmat4(1.0), between(0, 6.28), direction()); }
    glm::dmat4 similarity(double scale) {
        const glm::dvec3 to(between(-5, 5), between(-5, 5), between(-20, -2));
        return glm::translate(glm::dmat4(1.0), to) * rotation() *
               glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
    }
    Lens lens() {
        return {true, between(0.3, 5), between(0.3, 5), between(-0.5, 0.5), between(-0.5, 0.5), 1};
    }

  private:
    std::mt19937 engine{20061};
};

double apart(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

void expect_lens(const Lens& found, const Lens& truth, double tolerance) {
    EXPECT_NEAR(found.fx, truth.fx, tolerance);
    EXPECT_NEAR(found.fy, truth.fy, tolerance);
    EXPECT_NEAR(found.sx, truth.sx, tolerance);
    EXPECT_NEAR(found.sy, truth.sy, tolerance);
}

glm::dmat4 as_floats(const glm::dmat4& m) { return glm::dmat4(glm::mat4(m)); }

DepthLine planes(double near, double far) {
    return {(far + near) / (far - near), -2 * far * near / (far - near)};
}

glm::dmat4 perspective(const Lens& lens) { return projection_of(lens, planes(1, 50)); }

TEST(Camera, plain_projections_are_found_exactly_whatever_their_depth_row) {
    Random random;
    for (int i = 0; i < rounds; ++i) {
        const Lens lens = random.lens();
        // Reversed, infinite, oblique, flattened: any row.
        glm::dmat4 p = projection_of(lens, {random.between(-2, 2), random.between(-9, 9)});
        p[0][2] = random.between(-1, 1), p[1][2] = random.between(-1, 1);
        p *= random.between(0.1, 10);
        const auto camera = find_camera(p);
        ASSERT_TRUE(camera);
        EXPECT_TRUE(camera->plain);
        EXPECT_EQ(camera->to_eye, glm::dmat4(1.0));
        EXPECT_FALSE(is_mirrored(*camera));
        expect_lens(camera->lens, lens, 1e-12);
    }
}

TEST(Camera, combined_with_a_similarity_is_taken_apart) {
    Random random;
    for (int i = 0; i < rounds; ++i) {
        const Lens lens = random.lens();
        const glm::dmat4 view = random.similarity(random.between(0.01, 100));
        const auto camera = find_camera(perspective(lens) * view);
        ASSERT_TRUE(camera);
        EXPECT_FALSE(camera->plain);
        expect_lens(camera->lens, lens, 1e-10);
        EXPECT_LT(apart(camera->to_eye, view), 1e-9);
        const auto rounded = find_camera(as_floats(perspective(lens) * view));
        ASSERT_TRUE(rounded);
        expect_lens(rounded->lens, lens, 1e-5);
    }
}

TEST(Camera, which_hand_it_is_shows_in_the_determinant) {
    Random random;
    for (int i = 0; i < rounds; ++i) {
        const glm::dmat4 view = random.similarity(1),
                         turn = glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1));
        const glm::dmat4 p = perspective(random.lens());
        EXPECT_FALSE(is_mirrored(*find_camera(p * view)));
        EXPECT_TRUE(is_mirrored(*find_camera(turn * p * view)));
        EXPECT_TRUE(is_mirrored(*find_camera(turn * p)));
        EXPECT_TRUE(is_mirrored(*find_camera(p * view * turn)));
        EXPECT_FALSE(is_mirrored(*find_camera(turn * p * turn)));
    }
    glm::dmat4 left = perspective({}); // z goes into the screen
    left[2] = -left[2];
    ASSERT_TRUE(find_camera(left)->plain);
    EXPECT_TRUE(is_mirrored(*find_camera(left)));
}

TEST(Camera, other_planes_and_fields_of_view_are_of_the_same_eye_and_other_centres_are_not) {
    Random random;
    for (int i = 0; i < rounds; ++i) {
        Lens lens = random.lens();
        const glm::dmat4 view = random.similarity(random.between(0.1, 10));
        const glm::dmat4 moved = random.similarity(random.between(0.1, 10));
        const auto reference = find_camera(perspective(lens) * view);
        Lens zoomed = lens;
        zoomed.fx *= 2.5, zoomed.fy *= 2.5;
        const auto other = find_camera(projection_of(zoomed, planes(0.01, 3)) * moved);
        const auto between = to_space_of(*reference, *other);
        ASSERT_TRUE(between);
        EXPECT_LT(apart(view * *between, moved), 1e-6);
        EXPECT_EQ(to_space_of(*reference, *find_camera(projection_of(zoomed, planes(3, 4)) * view)),
                  glm::dmat4(1.0));
        Lens shifted = lens;
        shifted.sx += 0.01;
        EXPECT_FALSE(to_space_of(*reference, *find_camera(perspective(shifted) * view)));
        Lens wide = lens;
        wide.fx *= 1.02;
        EXPECT_FALSE(to_space_of(*reference, *find_camera(perspective(wide) * view)));
    }
}

TEST(Camera, of_a_model_that_is_scaled_unevenly_is_found_by_columns_or_by_the_depth_row) {
    Random random;
    int found = 0;
    for (int i = 0; i < rounds; ++i) {
        Lens lens = random.lens();
        lens.sx = lens.sy = 0;
        const glm::dmat4 model = random.similarity(1) * glm::scale(glm::dmat4(1.0), glm::dvec3(1, 2, 0.5));
        const glm::dmat4 whole = perspective(lens) * model;
        EXPECT_FALSE(find_camera(whole));
        const auto line = find_depth_line(whole);
        ASSERT_TRUE(line);
        EXPECT_TRUE(same_line(*line, planes(1, 50)));
        EXPECT_FALSE(same_line(*line, planes(1, 60)));
        EXPECT_LT(apart(with_lens(whole, lens).to_eye, model), 1e-9);
        const auto camera = find_camera_of_stretched(whole);
        if (!camera) continue;
        ++found;
        expect_lens(camera->lens, lens, 1e-4);
    }
    EXPECT_GT(found, rounds * 9 / 10);
}

TEST(Camera, along_an_axis_of_a_stretched_model_columns_say_nothing) {
    const glm::dmat4 model =
        glm::translate(glm::dmat4(1.0), {0, 0, -5}) * glm::scale(glm::dmat4(1.0), {1, 2, 0.5});
    EXPECT_FALSE(find_camera_of_stretched(perspective({}) * model));
}

TEST(Camera, parallel_ones_are_of_one_eye_where_the_picture_has_the_same_frame) {
    const glm::dmat4 near = glm::ortho(-2.0, 3.0, -1.0, 4.0, 1.0, 10.0),
                     far = glm::ortho(-2.0, 3.0, -1.0, 4.0, -50.0, 90.0);
    const glm::dmat4 wide = glm::ortho(-4.0, 6.0, -1.0, 4.0, 1.0, 10.0);
    EXPECT_TRUE(find_camera(near)->plain);
    EXPECT_EQ(to_space_of(*find_camera(near), *find_camera(far)), glm::dmat4(1.0));
    EXPECT_FALSE(to_space_of(*find_camera(near), *find_camera(wide)));
    EXPECT_FALSE(to_space_of(*find_camera(near), *find_camera(perspective({}))));
    Random random;
    for (int i = 0; i < rounds; ++i) {
        const glm::dmat4 view = random.similarity(1), moved = random.similarity(random.between(0.2, 5));
        const auto reference = find_camera(near * view), other = find_camera(near * moved);
        ASSERT_TRUE(reference && other);
        EXPECT_FALSE(is_mirrored(*reference));
        const auto between = to_space_of(*reference, *other);
        ASSERT_TRUE(between);
        EXPECT_LT(apart(view * *between, moved), 1e-8);
        EXPECT_EQ(to_space_of(*reference, *find_camera(far * view)), glm::dmat4(1.0));
    }
}

TEST(Camera, scale_before_the_view_shows_in_rows_and_that_of_a_model_in_columns) {
    Random random;
    for (int i = 0; i < rounds; ++i) {
        const glm::dvec3 size(random.between(0.1, 0.9), random.between(1, 3), random.between(4, 9));
        const glm::dmat4 scale = glm::scale(glm::dmat4(1.0), size);
        const glm::dmat4 away = glm::translate(glm::dmat4(1.0), {1, 2, -3}), turned = random.rotation();
        glm::dmat4 flipped = scale;
        flipped[2] = -flipped[2];
        const auto found = find_scale_of_rows(scale * away * turned),
                   turns = find_scale_of_rows(flipped * turned);
        ASSERT_TRUE(found && turns);
        EXPECT_LT(glm::length(*found - size), 1e-9);
        EXPECT_LT(glm::length(*turns - size * glm::dvec3(1, 1, -1)), 1e-9);
        EXPECT_FALSE(find_scale_of_rows(away * turned * scale));
        EXPECT_FALSE(find_scale_of_rows(away * turned * glm::scale(glm::dmat4(1.0), glm::dvec3(3))));
        EXPECT_FALSE(find_scale_of_rows(turned * scale * random.rotation()));
    }
}

TEST(Camera, depths_of_clip_positions_lie_on_a_line) {
    Random random;
    for (int i = 0; i < rounds; ++i) {
        const double near = random.between(0.1, 2), far = near + random.between(1, 100);
        const DepthLine truth = planes(near, far);
        DepthLineFit fit, bent, behind;
        EXPECT_FALSE(fit.varies());
        for (int k = 0; k < 20; ++k) {
            const double w = random.between(near, far);
            fit.add(w, float(truth.slope * w + truth.shift));
            bent.add(w, truth.slope * w + truth.shift + 0.01 * w * w);
            behind.add(-w, -truth.slope * w + truth.shift);
        }
        ASSERT_TRUE(fit.line());
        EXPECT_NEAR(fit.line()->slope, truth.slope, 1e-5);
        EXPECT_NEAR(fit.line()->shift / truth.shift, 1, 1e-4);
        EXPECT_FALSE(bent.line());
        EXPECT_FALSE(behind.line());
    }
    DepthLineFit flat;
    for (int k = 0; k < 9; ++k) flat.add(1, k);
    EXPECT_FALSE(flat.varies());
}

TEST(Camera, a_nudge_of_the_depth_row_is_told_from_other_planes) {
    const DepthLine plain = planes(1, 50);
    EXPECT_NEAR(depth_nudge(plain, {plain.slope - 4e-4, plain.shift}, true), -2e-4, 1e-12);
    EXPECT_GT(depth_nudge(plain, {plain.slope * 1.0002, plain.shift}, true), 0);
    EXPECT_EQ(depth_nudge(plain, plain, true), 0);
    EXPECT_EQ(depth_nudge(plain, planes(0.5, 50), true), 0);
    EXPECT_EQ(depth_nudge(plain, planes(1, 500), true), 0);
    EXPECT_NEAR(depth_nudge({-0.2, 0.1}, {-0.2, 0.101}, false), 0.0005, 1e-12);
    EXPECT_EQ(depth_nudge({-0.2, 0.1}, {-0.3, 0.101}, false), 0);
}

TEST(Camera, a_field_of_view_gives_square_pixels) {
    const Lens lens = lens_of_view(90, 640, 480);
    EXPECT_NEAR(lens.fy, 1, 1e-12);
    EXPECT_NEAR(lens.fx, 0.75, 1e-12);
    EXPECT_TRUE(is_square(lens, 640, 480));
    EXPECT_FALSE(is_square(lens, 640, 490));
    EXPECT_FALSE(is_square(lens, 0, 0));
}

TEST(Camera, what_holds_none_is_told) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(find_camera(glm::dmat4(0.0)));
    EXPECT_FALSE(find_camera(glm::dmat4(nan)));
    for (const double bad : {nan, infinite, -infinite})
        for (int at = 0; at < 16; ++at) {
            glm::dmat4 m = perspective({});
            m[at / 4][at % 4] = bad;
            EXPECT_FALSE(find_camera(m)) << at;
            EXPECT_FALSE(find_camera_of_stretched(m)) << at;
            EXPECT_FALSE(find_scale_of_rows(m)) << at;
        }
    glm::dmat4 flat = perspective({});
    for (int c = 0; c < 4; ++c) flat[c][0] = 0; // no width
    EXPECT_FALSE(find_camera(flat));
    glm::dmat4 sheared = perspective({});
    sheared[1][0] = 0.3;
    EXPECT_FALSE(find_camera(sheared));
    glm::dmat4 cavalier = glm::ortho(-1.0, 1.0, -1.0, 1.0, 0.0, 10.0);
    cavalier[2][0] = 0.35, cavalier[2][1] = 0.35;
    EXPECT_FALSE(find_camera(cavalier));
    glm::dmat4 tilted = glm::ortho(-1.0, 1.0, -1.0, 1.0, 0.0, 10.0);
    tilted[3][3] = 0;
    EXPECT_FALSE(find_camera(tilted));
    EXPECT_FALSE(find_depth_line(glm::dmat4(0.0)));
    // A depth row that is nothing but w, as skies have it, is a camera all the same.
    EXPECT_TRUE(find_camera(projection_of({}, {1, 0})));
}

} // namespace
} // namespace glcast
