// Whatever state a program sets, a pass stays what it is; and what shapes the surface stays the program's.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/capture/hostile_state.h"
#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

const Box unit_box{glm::dvec3(-1), 2};

class ForcedState : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();

    Cast cast_of(const DrawFunction& draw, int n = 32) {
        EngineOptions options = small_options(n);
        options.box = unit_box;
        return capture(gl, draw, options);
    }
    static bool covered_at(const Cast& cast, glm::dvec3 point) {
        return cast.view(Axis::z, Side::plus).covered(pixel_of(unit_box, cast.images[0].n, Axis::z, point));
    }
    static glm::vec4 normal_at(const Cast& cast, Axis axis, Side side, glm::dvec3 point) {
        return cast.view(axis, side).normal[pixel_of(unit_box, cast.images[0].n, axis, point)];
    }
};

void scene(const GlTable& gl) {
    set_lit(gl);
    set_diffuse(gl, {0.7f, 0.3f, 0.1f});
    draw_sphere(gl, glm::dvec3(0.1), 0.7, 24);
    gl.Disable(GL_LIGHTING);
    gl.Color3f(0, 1, 0);
    draw_box(gl, glm::dvec3(-0.9), glm::dvec3(-0.4));
    gl.Enable(GL_LIGHTING);
}

void expect_same(const Cast& a, const Cast& b) {
    ASSERT_TRUE(a.report.ok && b.report.ok);
    const Difference d = difference(a, b);
    EXPECT_EQ(d.coverage, 0);
    EXPECT_EQ(d.depth, 0);
    EXPECT_EQ(d.colour, 0);
    EXPECT_EQ(d.normal, 0);
}

TEST_F(ForcedState, EachHostileCallLeavesTheImagesAsTheyAre) {
    const Cast plain = cast_of(scene);
    for (const HostileCall& hostile : hostile_calls()) {
        SCOPED_TRACE(hostile.name);
        const auto draw = [&](const GlTable& table) {
            hostile.call(table);
            scene(table);
        };
        expect_same(plain, cast_of(draw));
        EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
    }
}

/// The test above is worth something only if the calls do harm when they come through.
TEST_F(ForcedState, HostileCallsThatComeThroughSpoilThem) {
    const Cast plain = cast_of(scene);
    for (const HostileCall& hostile : hostile_calls()) {
        if (hostile.harmless_here) continue;
        SCOPED_TRACE(hostile.name);
        const auto draw = [&](const GlTable& table) {
            hostile.call(gl);
            scene(table);
        };
        const Difference d = difference(plain, cast_of(draw));
        EXPECT_GT(double(d.coverage) + d.depth + d.colour + d.normal, 0);
    }
}

TEST_F(ForcedState, AllHostileCallsTogetherAndInTheMiddle) {
    const Cast plain = cast_of(scene);
    const auto all = [](const GlTable& table) {
        for (const HostileCall& hostile : hostile_calls()) hostile.call(table);
    };
    expect_same(plain, cast_of([&](const GlTable& table) { all(table), scene(table), all(table); }));
    expect_same(plain, cast_of([&](const GlTable& table) {
                    table.PushAttrib(GL_ALL_ATTRIB_BITS);
                    all(table);
                    table.PopAttrib();
                    scene(table);
                }));
}

TEST_F(ForcedState, TheBoxIsNotMovedByHostileState) {
    const auto box = find_box(gl, scene, small_options(64));
    const auto again = find_box(
        gl,
        [](const GlTable& table) {
            for (const HostileCall& hostile : hostile_calls()) hostile.call(table);
            scene(table);
        },
        small_options(64));
    ASSERT_TRUE(box && again);
    EXPECT_EQ(box->lo, again->lo);
    EXPECT_EQ(box->size, again->size);
}

TEST_F(ForcedState, TheProgramsProjectionDoesNotCount) {
    const Cast plain = cast_of(scene);
    expect_same(plain, cast_of([](const GlTable& gl) {
                    gl.MatrixMode(GL_PROJECTION);
                    gl.LoadIdentity();
                    gl.Frustum(-1, 1, -1, 1, 1, 10);
                    gl.PushMatrix();
                    gl.Translatef(3, 3, 3);
                    gl.PushAttrib(GL_TRANSFORM_BIT);
                    gl.MatrixMode(GL_MODELVIEW);
                    gl.LoadIdentity();
                    gl.PopAttrib();
                    gl.Rotated(30, 1, 1, 0); // still the projection
                    gl.PopMatrix();
                    GLint mode = 0;
                    gl.GetIntegerv(GL_MATRIX_MODE, &mode);
                    EXPECT_EQ(mode, GL_PROJECTION);
                    gl.MatrixMode(GL_MODELVIEW);
                    scene(gl);
                }));
}

TEST_F(ForcedState, TheModelviewCounts) {
    const Cast cast = cast_of([](const GlTable& gl) {
        set_lit(gl);
        gl.MatrixMode(GL_MODELVIEW);
        gl.PushMatrix();
        gl.Translatef(0.5f, 0.5f, 0);
        draw_box(gl, glm::dvec3(-0.25), glm::dvec3(0.25));
        gl.PopMatrix();
    });
    EXPECT_TRUE(covered_at(cast, {0.5, 0.5, 0}));
    EXPECT_FALSE(covered_at(cast, {-0.1, -0.1, 0}));
}

TEST_F(ForcedState, UnlitDrawsHaveNoNormal) {
    const Cast cast = cast_of(scene);
    EXPECT_EQ(normal_at(cast, Axis::z, Side::minus, glm::dvec3(-0.65)), glm::vec4(0));
    EXPECT_EQ(normal_at(cast, Axis::z, Side::plus, glm::dvec3(0.1)).w, 1);
    EXPECT_GT(cast.report.pixels_without_normal, 6 * 10);
}

TEST_F(ForcedState, PopAttribBringsLightingBack) {
    for (GLbitfield mask : {GL_ENABLE_BIT, GL_LIGHTING_BIT}) {
        const Cast cast = cast_of([mask](const GlTable& gl) {
            set_lit(gl);
            gl.PushAttrib(mask);
            gl.Disable(GL_LIGHTING);
            draw_box(gl, {-0.8, -0.3, -0.3}, {-0.2, 0.3, 0.3});
            gl.PopAttrib();
            draw_box(gl, {0.2, -0.3, -0.3}, {0.8, 0.3, 0.3});
        });
        EXPECT_EQ(normal_at(cast, Axis::z, Side::plus, {-0.5, 0, 0}).w, 0);
        EXPECT_EQ(normal_at(cast, Axis::z, Side::plus, {0.5, 0, 0}), glm::vec4(0, 0, 1, 1));
    }
}

/// Left half of the picture is alpha 0.3, right half 0.7.
void two_alphas(const GlTable& gl) {
    gl.Color4f(1, 1, 1, 0.3f);
    draw_box(gl, {-0.8, -0.3, -0.3}, {-0.2, 0.3, 0.3});
    gl.Color4f(1, 1, 1, 0.7f);
    draw_box(gl, {0.2, -0.3, -0.3}, {0.8, 0.3, 0.3});
}

struct AlphaCase {
    const char* name;
    void (*set)(const GlTable& gl);
    bool left, right;
};

TEST_F(ForcedState, AlphaTestAndBlending) {
    const AlphaCase cases[] = {
        {"opaque", [](const GlTable&) {}, true, true},
        {"alpha test", [](const GlTable& gl) { gl.Enable(GL_ALPHA_TEST), gl.AlphaFunc(GL_LESS, 0.5f); }, true,
         false},
        {"blending",
         [](const GlTable& gl) { gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA), gl.Enable(GL_BLEND); },
         false, true},
        {"blending that replaces", [](const GlTable& gl) { gl.Enable(GL_BLEND); }, true, true},
        {"both",
         [](const GlTable& gl) {
             gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
             gl.Enable(GL_BLEND);
             gl.AlphaFunc(GL_GREATER, 0.1f);
             gl.Enable(GL_ALPHA_TEST);
         },
         false, true},
        {"both, the other way round",
         [](const GlTable& gl) {
             gl.BlendFunc(GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA);
             gl.Enable(GL_BLEND);
             gl.AlphaFunc(GL_LESS, 0.2f);
             gl.Enable(GL_ALPHA_TEST);
         },
         false, false},
        {"the other way round", [](const GlTable& gl) { gl.BlendFunc(GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA), gl.Enable(GL_BLEND); },
         true, false},
        {"glows", [](const GlTable& gl) { gl.BlendFunc(GL_SRC_ALPHA, GL_ONE), gl.Enable(GL_BLEND); }, false, false},
        {"logic in the place of blending",
         [](const GlTable& gl) {
             gl.PushAttrib(GL_ALL_ATTRIB_BITS);
             gl.LogicOp(GL_XOR), gl.BlendColor(0, 0, 0, 0);
             gl.PopAttrib();
             gl.BlendFunc(GL_SRC_ALPHA, GL_ONE), gl.Enable(GL_BLEND), gl.Enable(GL_COLOR_LOGIC_OP);
         },
         true, true},
        {"pushed and popped",
         [](const GlTable& gl) {
             gl.PushAttrib(GL_COLOR_BUFFER_BIT);
             gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
             gl.Enable(GL_BLEND);
             gl.ColorMask(0, 0, 0, 0);
             gl.PopAttrib();
         },
         true, true},
        {"popped into blending",
         [](const GlTable& gl) {
             gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
             gl.Enable(GL_BLEND);
             gl.PushAttrib(GL_ENABLE_BIT);
             gl.Disable(GL_BLEND);
             gl.Enable(GL_ALPHA_TEST);
             gl.AlphaFunc(GL_NEVER, 0);
             gl.PopAttrib();
         },
         false, true},
    };
    for (const AlphaCase& c : cases) {
        SCOPED_TRACE(c.name);
        const Cast cast = cast_of([&](const GlTable& gl) {
            gl.BlendFunc(GL_ONE, GL_ZERO);
            c.set(gl);
            two_alphas(gl);
            gl.Disable(GL_BLEND), gl.Disable(GL_COLOR_LOGIC_OP);
        });
        EXPECT_EQ(covered_at(cast, {-0.5, 0, 0}), c.left);
        EXPECT_EQ(covered_at(cast, {0.5, 0, 0}), c.right);
    }
}

TEST_F(ForcedState, WhatIsDrawnWithoutColourIsNotShown) {
    const auto draw_hidden = [](const GlTable& gl) {
        set_lit(gl);
        set_diffuse(gl, {1, 0, 0});
        gl.ColorMask(0, 0, 0, 0);
        draw_box(gl, glm::dvec3(-0.5), glm::dvec3(0.5));
        draw_box(gl, {-0.9, -0.9, -0.9}, {-0.6, -0.6, -0.6});
        gl.ColorMask(1, 1, 1, 1);
        set_diffuse(gl, {0, 1, 0});
        draw_box(gl, glm::dvec3(-0.5), glm::dvec3(0.5));
    };
    const Cast cast = cast_of(draw_hidden);
    EXPECT_FALSE(covered_at(cast, glm::dvec3(-0.75)));
    const std::size_t middle = pixel_of(unit_box, 32, Axis::z, glm::dvec3(0.01));
    EXPECT_EQ(glm::vec3(cast.view(Axis::z, Side::plus).colour[middle]), glm::vec3(0, 1, 0));
    EXPECT_EQ(cast.report.pixels_without_normal, 0);
}

TEST_F(ForcedState, ClipPlanesCut) {
    const Cast cast = cast_of([](const GlTable& gl) {
        set_lit(gl);
        const GLdouble plane[] = {-1, 0, 0, 0.01};
        gl.ClipPlane(GL_CLIP_PLANE2, plane);
        gl.Enable(GL_CLIP_PLANE2);
        draw_box(gl, glm::dvec3(-0.5), glm::dvec3(0.5));
    });
    EXPECT_TRUE(covered_at(cast, {-0.25, 0, 0}));
    EXPECT_FALSE(covered_at(cast, {0.25, 0, 0}));
}

TEST_F(ForcedState, SelectionDrawsNothing) {
    const Cast plain = cast_of(scene);
    expect_same(plain, cast_of([](const GlTable& gl) {
                    GLuint hits[64] = {};
                    gl.SelectBuffer(64, hits);
                    gl.RenderMode(GL_SELECT);
                    draw_box(gl, glm::dvec3(-0.99), glm::dvec3(0.99));
                    gl.RenderMode(GL_RENDER);
                    EXPECT_EQ(hits[0], 0u);
                    scene(gl);
                }));
}

TEST_F(ForcedState, GlErrorsOfTheSceneAreSwallowed) {
    const Cast plain = cast_of(scene);
    expect_same(plain, cast_of([](const GlTable& gl) {
                    gl.Enable(0x1234);
                    gl.PopAttrib();
                    gl.Materialf(GL_FRONT, 0x4321, 1);
                    scene(gl);
                    for (int i = 0; i < 40; ++i) gl.PushAttrib(GL_ALL_ATTRIB_BITS);
                    gl.MatrixMode(GL_MODELVIEW);
                    gl.PushMatrix();
                    gl.Scalef(2, 2, 2);
                    gl.Enable(GL_CLIP_PLANE0); // left so
                }));
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST_F(ForcedState, AnExceptionOfTheSceneBecomesAnError) {
    const Cast cast = cast_of([](const GlTable&) { throw std::runtime_error("no such frame"); });
    EXPECT_FALSE(cast.report.ok);
    EXPECT_EQ(cast.report.error, "no such frame");
}

} // namespace
} // namespace glcast::test
