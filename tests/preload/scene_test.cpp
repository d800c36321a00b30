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

} // namespace
} // namespace glcast::preload
