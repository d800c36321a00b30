// Every way to give a vertex is seen by the gate, whatever extension it came with.
#include <gtest/gtest.h>

#include "shim/preload/scene_table.h"

namespace glcast::preload {
namespace {

int reached; ///< calls that came through

struct Gate final : DrawGate {
    Gate(const GlTable& gl, bool keeps_all) : DrawGate(gl), keeps(keeps_all) {}
    bool keep(GLenum, long) override { return keeps; }
    void add_primitives(long number) override { primitives += number; }
    const bool keeps;
    long primitives = 0;
};

GlTable driver() {
    reached = 0;
    GlTable gl{};
    gl.Begin = [](GLenum) {};
    gl.End = [] {};
    gl.Vertex3f = [](GLfloat, GLfloat, GLfloat) { ++reached; };
    gl.Vertex3hNV = [](GLhalfNV, GLhalfNV, GLhalfNV) { ++reached; };
    gl.VertexP3ui = [](GLenum, GLuint) { ++reached; };
    gl.VertexP4ui = [](GLenum, GLuint) { ++reached; };
    gl.VertexAttribP3ui = [](GLuint, GLenum, GLboolean, GLuint) { ++reached; };
    gl.VertexAttrib3hNV = [](GLuint, GLhalfNV, GLhalfNV, GLhalfNV) { ++reached; };
    return gl;
}

/// Six vertices, two triangles, each given in another way; and an attribute that is no vertex.
void draw(const GlTable& gl) {
    gl.Begin(GL_TRIANGLES);
    gl.Vertex3f(0, 0, 0);
    gl.Vertex3hNV(0, 0, 0);
    gl.VertexP3ui(GL_INT_2_10_10_10_REV, 0);
    gl.VertexP4ui(GL_INT_2_10_10_10_REV, 0);
    gl.VertexAttribP3ui(0, GL_INT_2_10_10_10_REV, GL_FALSE, 0);
    gl.VertexAttrib3hNV(0, 0, 0, 0);
    gl.VertexAttrib3hNV(1, 0, 0, 0);
    gl.End();
}

TEST(DrawGate, CountsVerticesOfEveryExtension) {
    const GlTable gl = driver();
    Gate gate(gl, true);
    draw(gated_table(gate));
    EXPECT_EQ(gate.primitives, 2);
    EXPECT_TRUE(gate.gives_w);
    EXPECT_EQ(reached, 7);
}

TEST(DrawGate, SwallowsVerticesOfEveryExtension) {
    const GlTable gl = driver();
    Gate gate(gl, false);
    draw(gated_table(gate));
    EXPECT_EQ(gate.primitives, 2);
    EXPECT_EQ(reached, 1);
}

} // namespace
} // namespace glcast::preload
