// Depth layers: every hit of every ray, found once.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "capture/engine_peel.h"
#include "tests/capture/layer_truth.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

const Box view_box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};
const glm::vec3 red(0.8f, 0.1f, 0.2f), green(0.1f, 0.7f, 0.3f), blue(0.15f, 0.25f, 0.9f);

class LayersOf : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();
    EngineOptions options = small_options(64);

    void SetUp() override {
        options.box = view_box;
        options.most_layers = 32;
    }
    Cast cast_of(const DrawFunction& draw) { return capture(gl, draw, options); }
    Cast complete_cast_of(const DrawFunction& draw) {
        Cast cast = cast_of(draw);
        EXPECT_TRUE(cast.report.ok) << cast.report.error;
        EXPECT_EQ(cast.report.layers, Layers::complete);
        EXPECT_EQ(cast.report.layer_method, options.layer_method);
        return cast;
    }
};

void nested_spheres(const GlTable& gl) {
    set_lit(gl);
    set_diffuse(gl, red);
    draw_sphere(gl, glm::dvec3(0.01), 0.9, 64);
    set_diffuse(gl, green);
    draw_sphere(gl, glm::dvec3(0.1, 0.05, -0.1), 0.6, 64);
    set_diffuse(gl, blue);
    draw_sphere(gl, glm::dvec3(0.2, 0.02, -0.1), 0.3, 64);
}
const std::vector<BodyPtr> nested_bodies{sphere(glm::dvec3(0.01), 0.9, red),
                                         sphere({0.1, 0.05, -0.1}, 0.6, green),
                                         sphere({0.2, 0.02, -0.1}, 0.3, blue)};

TEST_F(LayersOf, SpheresOneInTheOther) {
    const Cast cast = complete_cast_of(nested_spheres);
    EXPECT_EQ(cast.report.layer_count, (std::array<int, 3>{5, 5, 5}));
    const LayerErrors e = layer_errors(cast, nested_bodies);
    EXPECT_GT(e.hits, e.rays * 3);
    EXPECT_LT(e.wrong_count, e.rays / 100); // rays along a silhouette
    EXPECT_LT(e.depth_mean, 0.01);          // samples; facets lie inside the spheres
    EXPECT_LT(e.depth_max, 0.05);
    EXPECT_LT(e.normal_max, 2); // beside a silhouette, where a facet is far from the sphere along it
    EXPECT_LT(e.colour_max, 1.0 / 255);
}

TEST_F(LayersOf, NothingIsDrawnTwice) {
    int calls = 0;
    const Cast cast = complete_cast_of([&](const GlTable& table) { ++calls, nested_spheres(table); });
    // An axis: two views of two passes; four layers of depth, colour, normal; and the pass that draws
    // nothing.
    EXPECT_EQ(calls, 3 * (2 * 2 + 4 * 3 + 1));
    EXPECT_EQ(cast.report.draws, calls);
    EXPECT_EQ(cast.report.layer_draws, 3 * (4 * 3 + 1));
}

TEST_F(LayersOf, ImagesComeAxisByAxis) {
    const Cast cast = cast_of(nested_spheres);
    std::size_t at = 0;
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        EXPECT_EQ(cast.images.at(at++).view, (View{axis, Side::minus, 0}));
        EXPECT_EQ(cast.images.at(at++).view, (View{axis, Side::plus, 0}));
        for (int layer = 1; layer < 5; ++layer)
            EXPECT_EQ(cast.images.at(at++).view, (View{axis, Side::minus, layer}));
    }
    EXPECT_EQ(cast.images.size(), at);
}

TEST_F(LayersOf, AsManyAsAreAskedFor) {
    const Cast all = cast_of(nested_spheres);
    for (const int most : {1, 2, 4, 5, 6}) {
        SCOPED_TRACE(most);
        options.most_layers = most;
        const Cast cast = cast_of(nested_spheres);
        EXPECT_EQ(cast.report.layer_count[1], std::min(most, 5));
        EXPECT_EQ(cast.report.layers, most == 1  ? Layers::outer
                                      : most < 5 ? Layers::incomplete
                                                 : Layers::complete);
        for (const ViewImage& image : cast.images) EXPECT_EQ(image.depth, all.find(image.view)->depth);
    }
}

TEST_F(LayersOf, TwoBoxesFacingEachOther) {
    const glm::dmat3 turn = turned({1, 2, 3}, 25);
    const glm::dvec3 a = turn * glm::dvec3(-0.5, 0, 0), b = turn * glm::dvec3(0.4, 0, 0);
    const Cast cast = complete_cast_of([&](const GlTable& gl) {
        set_lit(gl);
        gl.Rotated(25, 1, 2, 3);
        set_diffuse(gl, red);
        draw_box(gl, {-0.7, -0.4, -0.4}, {-0.3, 0.4, 0.4});
        set_diffuse(gl, blue);
        draw_box(gl, {0.2, -0.4, -0.4}, {0.6, 0.4, 0.4});
    });
    const LayerErrors e =
        layer_errors(cast, {box(a, {0.2, 0.4, 0.4}, turn, red), box(b, {0.2, 0.4, 0.4}, turn, blue)});
    EXPECT_EQ(cast.report.layer_count[0], 3);
    EXPECT_LE(e.wrong_count, e.rays / 500); // rays along an edge
    EXPECT_LT(e.depth_max, 1e-3);
    EXPECT_LT(e.normal_max, 0.1);
    EXPECT_LT(e.colour_max, 1.0 / 255);
}

/// Natvig 2006, section 3: with clip planes between them, B took the colour of A's back.
TEST_F(LayersOf, ACylinderBehindACylinder) {
    const auto draw = [](const GlTable& gl) {
        set_lit(gl);
        set_diffuse(gl, red);
        draw_cylinder(gl, {0.02, -0.55, -0.6}, 0.3, 1.2);
        set_diffuse(gl, blue);
        draw_cylinder(gl, {0.02, 0.45, -0.6}, 0.3, 1.2);
    };
    const Cast cast = complete_cast_of(draw);
    EXPECT_EQ(cast.report.layer_count, (std::array<int, 3>{1, 3, 1}));
    const LayerErrors e = layer_errors(
        cast, {cylinder({0.02, -0.55, -0.6}, 0.3, 1.2, red), cylinder({0.02, 0.45, -0.6}, 0.3, 1.2, blue)});
    EXPECT_LT(e.wrong_count, e.rays / 100);
    EXPECT_LT(e.depth_max, 0.05);
    EXPECT_LT(e.normal_max, 0.2); // interpolated around
    EXPECT_LT(e.colour_max, 1.0 / 255);
}

void quad(const GlTable& gl, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    const glm::dvec3 n = glm::cross(b - a, d - a);
    gl.Normal3d(n.x, n.y, n.z);
    for (const glm::dvec3& p : {a, b, c, d}) gl.Vertex3d(p.x, p.y, p.z);
}

/// An open box with walls of 0.1 and half edge 0.6, its opening at +z.
void draw_cup(const GlTable& gl) {
    constexpr double o = 0.6, i = 0.5;
    gl.Begin(GL_QUADS);
    for (int side = 0; side < 4; ++side) {
        const auto at = [side](double r, double across, double z) {
            const glm::dvec2 p[] = {{r, across}, {-across, r}, {-r, -across}, {across, -r}};
            return glm::dvec3(p[side], z);
        };
        quad(gl, at(o, -o, -o), at(o, o, -o), at(o, o, o), at(o, -o, o));
        quad(gl, at(i, i, -i), at(i, -i, -i), at(i, -i, o), at(i, i, o));
        quad(gl, at(o, -o, o), at(o, o, o), at(i, i, o), at(i, -i, o));
    }
    quad(gl, {-o, o, -o}, {o, o, -o}, {o, -o, -o}, {-o, -o, -o});
    quad(gl, {-i, -i, -i}, {i, -i, -i}, {i, i, -i}, {-i, i, -i});
    gl.End();
}

TEST_F(LayersOf, ACupTiltedBy40Degrees) {
    const glm::dmat3 turn = turned({1, 1, 0.2}, 40);
    const Cast cast = complete_cast_of([](const GlTable& gl) {
        set_lit(gl);
        set_diffuse(gl, green);
        gl.Rotated(40, 1, 1, 0.2);
        draw_cup(gl);
    });
    const BodyPtr cup = subtract(box(glm::dvec3(0), glm::dvec3(0.6), turn, green),
                                 box(turn * glm::dvec3(0, 0, 0.25), {0.5, 0.5, 0.75}, turn, green));
    const LayerErrors e = layer_errors(cast, {cup});
    EXPECT_LE(e.wrong_count, e.rays / 200);
    EXPECT_LT(e.depth_max, 1e-3);
    EXPECT_LT(e.normal_max, 0.1);
    EXPECT_LT(e.colour_max, 1.0 / 255);
}

/// A square through the origin, `parts` x `parts` quads, its normal turned from z by `degrees` about x.
void draw_sheet(const GlTable& gl, double degrees, int parts) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    const auto at = [&](int i, int j) {
        const double u = 1.4 * i / parts - 0.7, v = 1.4 * j / parts - 0.7;
        return glm::dvec3(u, v * c, v * s);
    };
    gl.Begin(GL_QUADS);
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) quad(gl, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    gl.End();
}

/// Two sheets in one place, tessellated differently so that their depths are rounded differently, inside a
/// shell.
TEST_F(LayersOf, CoincidentSheetsPeelOnce) {
    for (const double degrees : {0.0, 30.0, 80.0, 88.0, 89.5, 89.9, 89.99}) {
        SCOPED_TRACE(degrees);
        const auto draw = [&](const GlTable& gl, bool both) {
            set_lit(gl);
            draw_box(gl, glm::dvec3(-0.95), glm::dvec3(0.95));
            gl.Rotated(13, 0, 0, 1);
            draw_sheet(gl, degrees, 7);
            if (both) draw_sheet(gl, degrees, 11);
        };
        const Cast two = complete_cast_of([&](const GlTable& gl) { draw(gl, true); });
        const Cast one = complete_cast_of([&](const GlTable& gl) { draw(gl, false); });
        const LayerDifference d = layer_difference(two, one);
        EXPECT_EQ(two.report.layer_count, one.report.layer_count);
        EXPECT_EQ(*std::max_element(one.report.layer_count.begin(), one.report.layer_count.end()), 2);
        EXPECT_LE(d.wrong_count, degrees == 0 ? 0 : 4); // ends of the sheets, along a ray
        RecordProperty("depth", std::to_string(d.depth));
    }
}

/// Coincident with what is seen from outside: not a layer of its own.
TEST_F(LayersOf, WhatLiesOnTheOuterSurfaceIsNoLayer) {
    for (const double degrees : {0.0, 45.0, 85.0, 89.0}) {
        const Cast cast = complete_cast_of([&](const GlTable& gl) {
            set_lit(gl);
            draw_sheet(gl, degrees, 5);
            draw_sheet(gl, degrees, 9);
        });
        EXPECT_EQ(cast.report.layer_count, (std::array<int, 3>{1, 1, 1})) << degrees;
    }
}

/// Faces that pass through the centres of samples, as planes to hit and edge-on.
TEST_F(LayersOf, FacesThroughSampleCentres) {
    options.box = Box{glm::dvec3(-1), 2};
    const double sample = 2.0 / 64, lo = -1 + 20.5 * sample, hi = -1 + 41.5 * sample;
    const Cast cast = complete_cast_of([&](const GlTable& gl) {
        set_lit(gl);
        draw_box(gl, glm::dvec3(-0.95), glm::dvec3(0.95));
        draw_box(gl, glm::dvec3(lo), glm::dvec3(hi));
    });
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        long inner = 0;
        for (std::size_t p = 0; p < 64 * 64; ++p) {
            const std::size_t hits = cast_hits(cast, axis, p).size();
            EXPECT_TRUE(hits == 0 || hits == 2 || hits == 4) << hits;
            inner += hits == 4;
        }
        EXPECT_EQ(inner, 21 * 21); // an edge through a centre belongs to one side of it
    }
}

/// Sheets as far apart as `samples`, in a shell: hits of most rays along z.
TEST_F(LayersOf, SheetsApartByMoreThanTheToleranceAreTwo) {
    const auto hits_of = [&](double samples) {
        const Cast cast = complete_cast_of([&](const GlTable& gl) {
            set_lit(gl);
            draw_box(gl, glm::dvec3(-0.95), glm::dvec3(0.95));
            draw_sheet(gl, 0, 1);
            gl.Translated(0, 0, samples * view_box.size / 64);
            draw_sheet(gl, 0, 3);
        });
        return cast_hits(cast, Axis::z, 32 * 64 + 30).size();
    };
    EXPECT_EQ(hits_of(0.9 * SameHit::flat), 3u);
    EXPECT_EQ(hits_of(1.1 * SameHit::flat), 4u);
    EXPECT_EQ(hits_of(3), 4u);
}

} // namespace
} // namespace glcast::test
