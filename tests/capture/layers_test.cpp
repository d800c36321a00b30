// Depth layers: every hit of every ray, found once.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/capture/layers_of.h"

namespace glcast::test {
namespace {

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

/// What is seen of the inner ones shrinks and moves from layer to layer.
void draw_leaning_bodies(const GlTable& gl) {
    set_lit(gl);
    gl.Rotated(40, 1, 0.3, 0.2);
    set_diffuse(gl, red);
    draw_box(gl, glm::dvec3(-0.55), glm::dvec3(0.55));
    set_diffuse(gl, green);
    draw_sphere(gl, glm::dvec3(0.2, 0.1, 0.15), 0.3);
    set_diffuse(gl, blue);
    draw_box(gl, {0.2, 0.1, 0.1}, {0.3, 0.2, 0.2});
}

/// A gear's walls, in the primitive and the shading asked for.
void draw_rings(const GlTable& gl, GLenum primitive, GLenum shading) {
    set_lit(gl);
    gl.Rotated(35, 1, 0.7, 0.2);
    gl.ShadeModel(shading);
    for (const double radius : {0.9, 0.6, 0.4}) {
        constexpr int sides = 29;
        const auto wall = [&](int i, double z) {
            const double angle = i * 2 * 3.14159265358979 / sides, r = radius * (i % 2 ? 1 : 0.9);
            gl.Vertex3d(r * std::cos(angle), r * std::sin(angle), z);
        };
        gl.Begin(primitive);
        for (int i = 0; i <= sides; ++i) {
            const double angle = i * 2 * 3.14159265358979 / sides;
            gl.Normal3d(std::cos(angle), std::sin(angle), 0);
            if (primitive == GL_QUADS) {
                wall(i, 0.3), wall(i, -0.3), wall(i + 1, -0.3), wall(i + 1, 0.3);
            } else {
                wall(i, 0.3), wall(i, -0.3);
            }
        }
        gl.End();
    }
    gl.ShadeModel(GL_SMOOTH);
}

/// A hit that the fixed fragment stage sees elsewhere would be taken for a hole, looked behind of in draws of
/// its own, and lost.
TEST_F(LayersOf, QuadsHaveNoHoles) {
    options.n = 128;
    for (const GLenum primitive : {GL_QUADS, GL_QUAD_STRIP})
        for (const GLenum shading : {GL_FLAT, GL_SMOOTH}) {
            const Cast cast =
                complete_cast_of([&](const GlTable& gl) { draw_rings(gl, primitive, shading); });
            int expected = 0;
            for (const int count : cast.report.layer_count) expected += 3 * (count - 1) + 1;
            EXPECT_GE(cast.report.layer_count[0], 3);
            EXPECT_EQ(cast.report.layer_draws, expected) << primitive << " " << shading;
        }
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

/// The receiver may leave an image where it is; its memory then holds the next one.
TEST_F(LayersOf, ImagesThatAreNotTakenAreTheSame) {
    const Cast taken = cast_of(draw_leaning_bodies);
    std::vector<ViewImage> copies;
    run_capture(gl, draw_leaning_bodies, options, [&](ViewImage&& image) {
        copies.push_back(std::as_const(image));
        return true;
    });
    ASSERT_EQ(copies.size(), taken.images.size());
    EXPECT_GE(taken.report.layer_count[0], 4);
    for (std::size_t k = 0; k < copies.size(); ++k) {
        EXPECT_EQ(copies[k].view, taken.images[k].view);
        EXPECT_EQ(copies[k].depth, taken.images[k].depth);
        EXPECT_EQ(copies[k].colour, taken.images[k].colour);
        EXPECT_EQ(copies[k].normal, taken.images[k].normal);
    }
}

TEST_F(LayersOf, AsManyAsAreAskedFor) {
    const Cast all = cast_of(nested_spheres);
    for (const int most : {1, 2, 4, 5}) {
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

/// Square sheets across z with a texture whose left or right half is cut out by the alpha test, in a shell.
class Leaves : public LayersOf {
  protected:
    GLuint left = texture(true), right = texture(false);

    GLuint texture(bool left_half) {
        GLuint name = 0;
        gl.GenTextures(1, &name);
        gl.BindTexture(GL_TEXTURE_2D, name);
        const GLubyte full[] = {0, 255, 0, 255}, hole[] = {255, 0, 0, 0};
        GLubyte texels[8];
        std::copy(full, full + 4, texels + (left_half ? 0 : 4));
        std::copy(hole, hole + 4, texels + (left_half ? 4 : 0));
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        return name;
    }
    static void leaf(const GlTable& gl, GLuint texture, double z) {
        gl.BindTexture(GL_TEXTURE_2D, texture);
        gl.Begin(GL_QUADS);
        gl.Normal3d(0, 0, 1);
        gl.TexCoord2d(0, 0), gl.Vertex3d(-0.6, -0.6, z);
        gl.TexCoord2d(1, 0), gl.Vertex3d(0.6, -0.6, z);
        gl.TexCoord2d(1, 1), gl.Vertex3d(0.6, 0.6, z);
        gl.TexCoord2d(0, 1), gl.Vertex3d(-0.6, 0.6, z);
        gl.End();
    }
    static void leaves(const GlTable& gl, const std::vector<std::pair<GLuint, double>>& all) {
        set_lit(gl);
        set_diffuse(gl, glm::vec3(1));
        draw_box(gl, glm::dvec3(-0.9), glm::dvec3(0.9));
        gl.Enable(GL_TEXTURE_2D);
        gl.Enable(GL_ALPHA_TEST);
        gl.AlphaFunc(GL_GREATER, 0.5f);
        for (const auto& [texture, z] : all) leaf(gl, texture, z);
        gl.Disable(GL_TEXTURE_2D);
        gl.Disable(GL_ALPHA_TEST);
    }
    /// Depths (along z, in the model) of the inner hits of the ray there.
    std::vector<double> inner(const Cast& cast, double x) {
        std::vector<Hit> hits = cast_hits(cast, Axis::z, pixel_of(view_box, options.n, Axis::z, {x, 0.1, 0}));
        std::vector<double> z;
        for (std::size_t k = 1; k + 1 < hits.size(); ++k) {
            EXPECT_LT(glm::distance(hits[k].colour, glm::vec3(0, 1, 0)), 1.0 / 255)
                << "never the hole's colour";
            EXPECT_LT(glm::distance(hits[k].normal, glm::dvec3(0, 0, 1)), 1e-5);
            z.push_back(std::round((view_box.lo.z + hits[k].depth * view_box.size) * 1e4) / 1e4);
        }
        return z;
    }
    void expect_leaves() {
        using List = std::vector<double>;
        const Cast apart = complete_cast_of([&](const GlTable& table) {
            leaves(table, {{left, 0.3}, {right, 0.5}, {right, -0.2}, {left, -0.4}, {left, 0.7}});
        });
        EXPECT_EQ(inner(apart, -0.3), (List{-0.4, 0.3, 0.7}));
        EXPECT_EQ(inner(apart, 0.3), (List{-0.2, 0.5}));
        EXPECT_EQ(apart.report.layer_count[2], 4);
        // In one place, and one behind the other by less than the tolerance: a hole never hides what is
        // there.
        const double near = 0.5 * SameHit::flat * view_box.size / options.n;
        const Cast together = complete_cast_of([&](const GlTable& table) {
            leaves(table, {{left, 0}, {right, 0}, {right, 0.4}, {left, 0.4 + near}});
        });
        for (const double x : {-0.3, 0.3}) {
            ASSERT_EQ(inner(together, x).size(), 2u) << x;
            EXPECT_NEAR(inner(together, x)[0], 0, 1e-3);
            EXPECT_NEAR(inner(together, x)[1], 0.4, 1e-3);
        }
    }
};

TEST_F(Leaves, HolesOfTexturesAreNoHits) { expect_leaves(); }

/// More holes than hits in the first layer: it is then tested whether the driver is to be trusted, in the
/// same target.
TEST_F(Leaves, MostlyHolesHaveNormalsToo) {
    const Cast cast = complete_cast_of([&](const GlTable& table) {
        table.MatrixMode(GL_TEXTURE);
        table.Translated(0.25, 0, 0);
        table.Scaled(1.5, 1, 1);
        table.MatrixMode(GL_MODELVIEW);
        leaves(table, {{left, 0.3}});
    });
    EXPECT_EQ(inner(cast, -0.55), std::vector<double>{0.3});
    EXPECT_EQ(inner(cast, -0.2), std::vector<double>{});
}

TEST_F(Leaves, HolesOfTexturesAreNoHitsInSlabsEither) {
    options.layer_method = LayerMethod::slab;
    expect_leaves();
}

} // namespace
} // namespace glcast::test
