// Random calls, valid and not, with fixed seeds: whatever comes out of Mesa must come out of a replay.
#include <random>

#include "tests/record/rig.h"

namespace glcast::test {
namespace {

class Monkey {
  public:
    Monkey(const GlTable& table, unsigned seed) : gl(table), random(seed) {
        // Mesa 22.3 may follow a null pointer at the end of a list that calls one which does not exist.
        for (GLuint list = 20; list < 23; ++list) gl.NewList(list, GL_COMPILE), colour(), gl.EndList();
    }

    void act() {
        static constexpr void (Monkey::*actions[])() = {
            &Monkey::primitive, &Monkey::primitive, &Monkey::matrix,   &Monkey::matrix,  &Monkey::stacks,
            &Monkey::colour,    &Monkey::toggle,    &Monkey::light,    &Monkey::compile, &Monkey::call,
            &Monkey::call,      &Monkey::arrays,    &Monkey::elements, &Monkey::buffer,  &Monkey::state,
            &Monkey::mesh,      &Monkey::nonsense,  &Monkey::texture,
        };
        (this->*actions[below(std::size(actions))])();
    }

  private:
    unsigned below(std::size_t n) { return unsigned(random() % n); }
    float number(float from, float to) { return from + (to - from) * float(random() % 1000) / 999.f; }

    /// In a list Mesa cuts quads along the other diagonal, and closes loops of lines from the other end.
    GLenum mode() {
        static constexpr GLenum in_lists[] = {GL_POINTS,    GL_LINES,          GL_LINE_STRIP,
                                              GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN};
        return compiling ? in_lists[below(std::size(in_lists))] : below(10);
    }
    void primitive() {
        gl.Begin(mode());
        for (unsigned i = 0, n = below(12); i < n; ++i) {
            if (i == 0 || below(3) == 0) gl.Color3f(number(0, 1), number(0, 1), number(0, 1));
            if (i == 0 || below(3) == 0) gl.Normal3f(number(-1, 1), number(-1, 1), number(0, 1));
            gl.TexCoord2f(number(0, 2), number(0, 2));
            if (below(8) == 0 && !compiling) gl.CallList(20 + below(3)); // attributes alone
            gl.Vertex3f(number(-1.5f, 1.5f), number(-1.5f, 1.5f), number(-1, 1));
        }
        gl.End();
        // Mesa's lists forget what the vertices of an incomplete last primitive have set.
        gl.Color3f(number(0, 1), number(0, 1), number(0, 1)), gl.Normal3f(0, 0.6f, 0.8f), gl.TexCoord2f(0, 1);
    }
    void matrix() {
        switch (below(6)) {
        case 0:
            gl.Translatef(number(-0.3f, 0.3f), number(-0.3f, 0.3f), 0);
            break;
        case 1:
            gl.Rotatef(number(0, 90), 0.2f, 0.3f, 1);
            break;
        case 2:
            gl.Scalef(number(0.8f, 1.2f), 1, 1);
            break;
        case 3:
            gl.PushMatrix();
            break;
        case 4:
            gl.PopMatrix();
            break;
        default:
            gl.LoadIdentity(), gl.Translatef(0, 0, -5);
            break;
        }
    }
    void stacks() {
        static constexpr GLbitfield masks[] = {GL_ALL_ATTRIB_BITS, GL_ENABLE_BIT, GL_LIGHTING_BIT,
                                               GL_CURRENT_BIT, GL_LIST_BIT | GL_TRANSFORM_BIT};
        if (below(2))
            gl.PushAttrib(masks[below(std::size(masks))]);
        else
            gl.PopAttrib();
    }
    void colour() { gl.Color4ub(GLubyte(below(256)), GLubyte(below(256)), GLubyte(below(256)), 255); }
    void toggle() {
        static constexpr GLenum names[] = {GL_LIGHTING,       GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND,
                                           GL_COLOR_MATERIAL, GL_NORMALIZE,  GL_LIGHT1,    GL_FOG,
                                           GL_TEXTURE_2D,     GL_CLIP_PLANE0};
        const GLenum name = names[below(std::size(names))];
        if (below(2))
            gl.Enable(name);
        else
            gl.Disable(name);
    }
    void light() {
        const GLfloat values[] = {number(-1, 1), number(0, 1), number(0, 1), float(below(2))};
        const GLdouble plane[] = {values[0], values[1], 0.5, 1};
        switch (below(5)) {
        case 0:
            gl.Lightfv(GL_LIGHT0 + below(2), GL_POSITION, values);
            break;
        case 1:
            gl.Lightfv(GL_LIGHT0 + below(2), GL_DIFFUSE, values);
            break;
        case 2:
            gl.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, values);
            break;
        case 3:
            gl.ClipPlane(GL_CLIP_PLANE0, plane);
            break;
        default:
            gl.Lightf(GL_LIGHT1, GL_SPOT_CUTOFF, number(0, 90));
            break;
        }
    }
    void compile() {
        if (compiling) return;
        compiling = true;
        const bool attributes = below(3) == 0;
        gl.NewList(attributes ? 20 + below(3) : 1 + below(8),
                   !attributes && below(3) == 0 ? GL_COMPILE_AND_EXECUTE : GL_COMPILE);
        if (attributes)
            colour();
        else
            for (unsigned i = 0, n = below(10); i < n; ++i) act();
        gl.EndList();
        compiling = false;
    }
    /// A list may only call lists of lower names: else replays, and Mesa, would run for ever.
    void call() {
        if (compiling) return;
        const GLubyte names[] = {GLubyte(below(9)), GLubyte(below(9)), GLubyte(below(9))};
        if (below(10) == 0)
            gl.DeleteLists(1 + below(8), 1);
        else if (below(2))
            gl.CallList(1 + below(8));
        else
            gl.CallLists(3, GL_UNSIGNED_BYTE, names);
    }
    void fill() {
        for (GLfloat& v : vertices) v = number(-1.5f, 1.5f);
        for (GLubyte& c : colours) c = GLubyte(below(256));
    }
    void draw_with_arrays(bool indexed) {
        gl.BindBuffer(GL_ARRAY_BUFFER, 0);
        gl.VertexPointer(3, GL_FLOAT, 0, vertices);
        gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours);
        gl.EnableClientState(GL_VERTEX_ARRAY);
        if (below(2)) gl.EnableClientState(GL_COLOR_ARRAY);
        const GLushort indices[] = {GLushort(below(30)), GLushort(below(30)), GLushort(below(30)),
                                    GLushort(below(30))};
        if (indexed)
            gl.DrawElements(GL_TRIANGLE_STRIP, 4, GL_UNSIGNED_SHORT, indices);
        else
            gl.DrawArrays(mode(), GLint(below(10)), GLsizei(below(20)));
        gl.DisableClientState(GL_COLOR_ARRAY);
        gl.DisableClientState(GL_VERTEX_ARRAY);
        colour(); // GL leaves it undefined
    }
    void arrays() { fill(), draw_with_arrays(false); }
    void elements() { fill(), draw_with_arrays(true); }
    void buffer() {
        if (!name) gl.GenBuffers(1, &name);
        gl.BindBuffer(GL_ARRAY_BUFFER, name);
        fill();
        if (below(2))
            gl.BufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STREAM_DRAW), filled = true;
        else if (filled)
            gl.BufferSubData(GL_ARRAY_BUFFER, 12, 60, vertices);
        if (!filled) return;
        gl.VertexPointer(3, GL_FLOAT, 12, nullptr);
        gl.EnableClientState(GL_VERTEX_ARRAY);
        gl.DrawArrays(GL_TRIANGLES, 3, 9);
        gl.DisableClientState(GL_VERTEX_ARRAY);
    }
    void state() {
        switch (below(7)) {
        case 0:
            gl.ShadeModel(below(2) ? GL_FLAT : GL_SMOOTH);
            break;
        case 1:
            gl.PolygonMode(GL_FRONT_AND_BACK, below(3) ? GL_FILL : GL_LINE);
            break;
        case 2:
            gl.BlendFunc(GL_ONE, below(2) ? GL_ONE : GL_ZERO);
            break;
        case 3:
            gl.DepthFunc(GL_LESS + below(2) * 2);
            break;
        case 4:
            gl.FrontFace(below(2) ? GL_CW : GL_CCW);
            break;
        case 5:
            gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, GLint(below(2)));
            break;
        default:
            gl.LineWidth(number(1, 4));
            break;
        }
    }
    void mesh() {
        fill();
        gl.Map2f(GL_MAP2_VERTEX_3, 0, 1, 9, 3, 0, 1, 3, 3, vertices);
        gl.Enable(GL_MAP2_VERTEX_3);
        gl.MapGrid2f(4, 0, 1, 3, 0, 1);
        gl.EvalMesh2(GL_FILL, 0, 4, 0, 3);
    }
    void texture() {
        fill();
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colours);
    }
    void nonsense() {
        switch (below(6)) {
        case 0:
            gl.Begin(77);
            break;
        case 1:
            gl.End();
            break;
        case 2:
            gl.Enable(0xABCD);
            break;
        case 3:
            gl.Map1f(GL_MAP1_VERTEX_3, 0, 0, 1, -5, vertices);
            break;
        case 4:
            gl.DrawElements(GL_TRIANGLES, -3, GL_FLOAT, vertices);
            break;
        default:
            gl.MatrixMode(GL_BLEND);
            break;
        }
    }

    const GlTable& gl;
    std::mt19937 random;
    GLfloat vertices[90];
    GLubyte colours[128];
    GLuint name = 0;
    bool compiling = false, filled = false;
};

class Fuzz : public testing::TestWithParam<unsigned> {};
TEST_P(Fuzz, replays_as_drawn) {
    Rig rig;
    Monkey monkey(rig.gl(), GetParam());
    begin_scene(rig.gl());
    for (int i = 0; i < 60; ++i) monkey.act();
    while (rig.gl().GetError() != GL_NO_ERROR) {
    }
    rig.begin();
    rig.gl().ClearColor(0.2f, 0.2f, 0.2f, 1);
    rig.gl().DepthMask(GL_TRUE);
    rig.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (int i = 0; i < 150; ++i) monkey.act();
    rig.end();
    const Picture direct = rig.direct();
    // Where faces lie in one another, or corners are dull, the last bits decide what is seen.
    constexpr std::size_t few = Rig::size * Rig::size / 200;
    for (int i = 0; i < 2; ++i)
        EXPECT_LE(different_pixels(rig.replayed(), direct, 3, 256 * last_bits_of_depth), few);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Fuzz, testing::Range(1u, 41u));

} // namespace
} // namespace glcast::test
