// What a recorded frame is taken for: its base modelview. Through OSMesa, with no preloading.
#include "shim/preload/scene.h"

#include <gtest/gtest.h>

#include "shim/record/record.h"
#include "tests/support/osmesa_context.h"

namespace glcast::preload {
namespace {

void draw_under_a_view(const GlTable& gl) {
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadIdentity();
    gl.Frustum(-1, 1, -1, 1, 1, 10);
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadIdentity();
    gl.Translatef(0, 0, -5);
    gl.PushMatrix();
    gl.Rotatef(30, 0, 0, 1);
    gl.Begin(GL_TRIANGLES);
    gl.Vertex3f(-1, -1, 0);
    gl.Vertex3f(1, -1, 0);
    gl.Vertex3f(0, 1, 0);
    gl.End();
    gl.PopMatrix();
}

// A program may leave matrices on its stack from one frame to the next; the prologue of the frame pushes as
// many.
TEST(Scene, BaseModelviewIsTheFramesOwnWhateverLiesOnTheStack) {
    test::OsmesaContext program;
    test::OsmesaContext sibling(64, 64, &program);
    program.make_current();
    const auto context = record::make_context(program.gl(), nullptr);
    record::set_current(context.get(), program.gl());
    const GlTable& gl = record::table();
    gl.MatrixMode(GL_MODELVIEW);
    gl.PushMatrix();
    gl.PushMatrix();

    record::begin_frame(*context);
    draw_under_a_view(gl);
    const auto frame = record::end_frame(*context);
    record::set_current(nullptr, program.gl());
    ASSERT_TRUE(frame);

    sibling.make_current();
    const Scene scene = analyse(*frame, sibling.gl());
    ASSERT_EQ(scene.groups.size(), 1u);
    EXPECT_EQ(scene.groups[0].triangles, 1);
    const auto& base = scene.groups[0].base_modelview;
    ASSERT_TRUE(base);
    EXPECT_EQ((*base)[3], glm::dvec4(0, 0, -5, 1));
    EXPECT_EQ((*base)[0], glm::dvec4(1, 0, 0, 0));
}

/// A triangle in one quarter of the picture, reached by a scale; clockwise or not is left to the scale.
void draw_triangle(const GlTable& gl, float x, float y) {
    gl.PushMatrix();
    gl.Scalef(x, y, 1);
    gl.Begin(GL_TRIANGLES);
    gl.Vertex3f(0.1f, 0.1f, 0);
    gl.Vertex3f(0.9f, 0.1f, 0);
    gl.Vertex3f(0.1f, 0.9f, 0);
    gl.End();
    gl.PopMatrix();
}

struct Quarters {
    bool right_up, left_up, left_down, right_down;
    bool operator==(const Quarters&) const = default;
};

/// A frame of one group, drawn with the depth test on, and what is found out about it. Current afterwards is
/// a context that shares the program's objects, its buffers clear.
class Played {
  public:
    template <class Draw> explicit Played(const Draw& draw) {
        program.make_current();
        const auto context = record::make_context(program.gl(), nullptr);
        record::set_current(context.get(), program.gl());
        record::begin_frame(*context);
        record::table().Enable(GL_DEPTH_TEST);
        draw(record::table());
        frame = record::end_frame(*context);
        record::set_current(nullptr, program.gl());
        sibling.make_current();
        scene = analyse(*frame, sibling.gl());
        EXPECT_EQ(scene.groups.size(), 1u);
    }

    /// What a replay leaves of the picture's quarters.
    Quarters quarters(const Wanted& wanted = {}) {
        sibling.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        replay_group(*frame, scene, 0, wanted, sibling.gl());
        const auto pixels = sibling.read_rgba();
        const auto lit = [&](int x, int y) { return pixels[(y * 64 + x) * 4] > 0; };
        return {lit(40, 40), lit(24, 40), lit(24, 24), lit(40, 24)};
    }

    Scene scene;

  private:
    test::OsmesaContext program, sibling{64, 64, &program};
    std::shared_ptr<const record::Frame> frame;
};

void keep_to_stencil(const GlTable& gl) {
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_EQUAL, 0, ~0u);
}

// Games and screen savers draw a scene once more, mirrored, where the stencil buffer says that the floor
// shines.
TEST(Scene, ReflectionsKeptToAMirrorByStencilAreNotPlayed) {
    Played played([](const GlTable& gl) {
        keep_to_stencil(gl);
        draw_triangle(gl, 1, -1);
        gl.Disable(GL_STENCIL_TEST);
        draw_triangle(gl, 1, 1);
        draw_triangle(gl, -1, -1); // turned by half a turn, not mirrored
    });
    EXPECT_EQ(played.quarters(), (Quarters{true, false, true, false}));
    EXPECT_EQ(played.quarters({.everything = true}), (Quarters{true, false, true, true}));
}

TEST(Scene, WhatIsMirroredWithoutAStencilTestOrCutByOneUnmirroredIsPlayed) {
    Played played([](const GlTable& gl) {
        for (int i = 0; i < 3; ++i) draw_triangle(gl, 1, 1);
        draw_triangle(gl, -1, 1);
        keep_to_stencil(gl);
        draw_triangle(gl, -1, -1);
        gl.StencilFunc(GL_ALWAYS, 0, ~0u);
        draw_triangle(gl, 1, -1);
    });
    EXPECT_EQ(played.quarters(), (Quarters{true, true, true, true}));
}

// A shadow thrown by a matrix into the stencil buffer may have any hand, and as many triangles as what throws
// it.
TEST(Scene, WhatOnlyMarksTheStencilBufferSaysNothingOfHands) {
    Played played([](const GlTable& gl) {
        draw_triangle(gl, 1, 1);
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        for (int i = 0; i < 5; ++i) draw_triangle(gl, 1, -1);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl.Clear(GL_DEPTH_BUFFER_BIT);
        keep_to_stencil(gl);
        draw_triangle(gl, -1, -1);
        draw_triangle(gl, -1, 1);
    });
    EXPECT_EQ(played.quarters(), (Quarters{true, false, true, false}));
}

// Hands are those of most that is drawn, whatever the view does.
TEST(Scene, UnderAViewThatMirrorsAllReflectionsAreThoseOfTheOtherHand) {
    Played played([](const GlTable& gl) {
        draw_triangle(gl, -1, 1);
        draw_triangle(gl, 1, -1);
        keep_to_stencil(gl);
        draw_triangle(gl, 1, 1);
    });
    EXPECT_EQ(played.quarters(), (Quarters{false, true, false, true}));
}

TEST(Scene, WhereAllIsKeptByStencilAllIsPlayed) {
    Played played([](const GlTable& gl) {
        keep_to_stencil(gl); // a toolkit's clip
        draw_triangle(gl, -1, 1);
        draw_triangle(gl, 1, 1);
    });
    EXPECT_EQ(played.quarters(), (Quarters{true, true, false, false}));
}

// Reflections come before what they reflect; with the axes of a mirror the cast would be of the other hand.
TEST(Scene, ReflectionsDoNotGiveTheAxes) {
    const auto mirrored_first = [](bool reflection) {
        return Played([=](const GlTable& gl) {
            gl.MatrixMode(GL_MODELVIEW);
            if (reflection) keep_to_stencil(gl);
            gl.Scalef(1, -1, 1);
            draw_triangle(gl, 1, 1);
            gl.Scalef(1, -1, 1);
            gl.Disable(GL_STENCIL_TEST);
            gl.Translatef(0, 0, 0.5f);
            draw_triangle(gl, 1, 1);
        });
    };
    const auto base = [](const Played& played) { return *played.scene.groups.at(0).base_modelview; };
    EXPECT_EQ(base(mirrored_first(true))[1], glm::dvec4(0, 1, 0, 0));
    EXPECT_EQ(base(mirrored_first(true))[3], glm::dvec4(0, 0, 0.5, 1));
    EXPECT_EQ(base(mirrored_first(false))[1], glm::dvec4(0, -1, 0, 0));
}

/// As OpenCSG subtracts: which fragments of the subtracted solid's back lie behind the front of the other is marked
/// in the stencil buffer, and the colours are drawn at the depths that are left.
void subtract(const GlTable& gl) {
    gl.DepthFunc(GL_LESS);
    draw_triangle(gl, 1, 1);
    keep_to_stencil(gl);
    gl.DepthFunc(GL_GREATER);
    for (int i = 0; i < 3; ++i) draw_triangle(gl, -1, 1);
    gl.Disable(GL_STENCIL_TEST);
}

TEST(Scene, SolidsCutInTheDepthBufferAreNoticed) {
    const Played cut([](const GlTable& gl) {
        subtract(gl);
        gl.DepthFunc(GL_EQUAL);
        draw_triangle(gl, 1, 1);
    });
    EXPECT_EQ(cutting_draws({cut.scene}, cut.scene.groups.at(0)), 3);
    Scene elsewhere = cut.scene; // what is cut in a buffer of its own, then shown in this one
    elsewhere.groups[0].at_equal_depth = 0;
    Group shown = cut.scene.groups[0];
    shown.at_greater_depth = 0;
    EXPECT_EQ(cutting_draws({elsewhere}, shown), 3);
    shown.projection[0][0] = 2;
    EXPECT_EQ(cutting_draws({elsewhere}, shown), 0);
}

TEST(Scene, FurtherLightsAndWhatShinesThroughAreNotCutting) {
    const auto cuts = [](const auto& draw) {
        const Played played(draw);
        return cutting_draws({played.scene}, played.scene.groups.at(0));
    };
    EXPECT_EQ(cuts([](const GlTable& gl) {
                  draw_triangle(gl, 1, 1);
                  gl.DepthFunc(GL_EQUAL); // a further light, where there is no shadow
                  keep_to_stencil(gl);
                  draw_triangle(gl, 1, 1);
                  gl.Enable(GL_BLEND); // a hidden unit's outline
                  gl.DepthFunc(GL_GREATER);
                  draw_triangle(gl, 1, 1);
              }),
              0);
    EXPECT_EQ(cuts(subtract), 0); // nothing is shown at what was left
    EXPECT_EQ(cuts([](const GlTable& gl) {
                  gl.DepthFunc(GL_GREATER); // the greater depth is in front
                  keep_to_stencil(gl);
                  draw_triangle(gl, 1, 1);
                  gl.DepthFunc(GL_EQUAL);
                  draw_triangle(gl, 1, 1);
              }),
              0);
}

} // namespace
} // namespace glcast::preload
