// What is drawn between glBegin and glEnd, played from arrays: the same to the bit as call by call, or not
// from arrays.
#include <cmath>

#include "tests/record/rig.h"

namespace glcast::test {
namespace {

long begins = 0;
void(APIENTRYP real_begin)(GLenum) = nullptr;
void APIENTRY count_begin(GLenum mode) { ++begins, real_begin(mode); }

/// A replay of the rig's frame, and how many glBegin there were.
Picture replay(Rig& rig, long& number) {
    const Picture picture = [&] {
        rig.replayer.make_current();
        GlTable table = rig.replayer.gl();
        real_begin = table.Begin;
        table.Begin = count_begin;
        begins = 0;
        record::replay(*rig.frame, table);
        number = begins;
        return rig.replayed();
    }();
    return picture;
}

struct Drawing {
    std::string name;
    bool from_arrays;
    Calls frame;
};
void PrintTo(const Drawing& drawing, std::ostream* out) { *out << drawing.name; }

constexpr int points = 60;

/// Of a band that winds round the axis, in and out.
void place(int i, float (&p)[3]) {
    const float angle = 0.21f * static_cast<float>(i / 2), side = i % 2 ? 0.9f : -0.7f;
    p[0] = std::cos(angle) * (1 + 0.1f * static_cast<float>(i % 5)),
    p[1] = side + 0.02f * static_cast<float>(i);
    p[2] = std::sin(angle);
}

void light(const GlTable& gl) {
    begin_scene(gl);
    gl.Enable(GL_LIGHTING);
    gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
    gl.Enable(GL_COLOR_MATERIAL);
}

void band(const GlTable& gl, GLenum mode, int count = points) {
    gl.Begin(mode);
    for (int i = 0; i < count; ++i) {
        float p[3];
        place(i, p);
        gl.Color3ub(static_cast<GLubyte>(4 * i), static_cast<GLubyte>(255 - 3 * i), 40);
        gl.Normal3d(p[0], 0.3, p[2]);
        gl.Vertex3fv(p);
    }
    gl.End();
}

Drawing of_mode(const char* name, GLenum mode) {
    return {name, true, [mode](const GlTable& gl) { light(gl), band(gl, mode); }};
}

std::vector<Drawing> drawings() {
    std::vector<Drawing> all = {
        of_mode("points", GL_POINTS),
        of_mode("lines", GL_LINES),
        of_mode("line_strip", GL_LINE_STRIP),
        of_mode("line_loop", GL_LINE_LOOP),
        of_mode("triangles", GL_TRIANGLES),
        of_mode("triangle_strip", GL_TRIANGLE_STRIP),
        of_mode("triangle_fan", GL_TRIANGLE_FAN),
        of_mode("quads", GL_QUADS),
        of_mode("quad_strip", GL_QUAD_STRIP),
        of_mode("polygon", GL_POLYGON),
    };
    const auto add = [&](const char* name, bool from_arrays, Calls frame) {
        all.push_back({name, from_arrays, std::move(frame)});
    };
    for (const GLenum mode :
         {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_QUADS, GL_QUAD_STRIP, GL_POLYGON, GL_TRIANGLE_FAN})
        all.push_back({"flat_" + std::to_string(mode), true, [mode](const GlTable& gl) {
                           light(gl);
                           gl.ShadeModel(GL_FLAT);
                           band(gl, mode);
                       }});
    add("stippled_lines", true, [](const GlTable& gl) {
        light(gl);
        gl.Enable(GL_LINE_STIPPLE);
        gl.LineStipple(2, 0x3C5A);
        gl.LineWidth(3);
        band(gl, GL_LINE_STRIP);
    });
    add("outlines", true, [](const GlTable& gl) {
        light(gl);
        gl.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        band(gl, GL_QUADS);
    });
    add("long_strip", true, [](const GlTable& gl) { // longer than a driver's own buffer
        light(gl);
        for (const GLenum mode : {GL_TRIANGLE_STRIP, GL_QUAD_STRIP, GL_POLYGON, GL_TRIANGLES})
            band(gl, mode, 60000);
    });
    add("incomplete", true,
        [](const GlTable& gl) { light(gl), band(gl, GL_TRIANGLES, 59), band(gl, GL_QUADS, 58); });
    add("what_stays_current", true, [](const GlTable& gl) {
        light(gl);
        gl.Color3f(1, 0, 0);
        band(gl, GL_TRIANGLES);
        gl.Begin(GL_TRIANGLES); // with the colour and the normal of the last vertex before
        gl.Vertex3f(-1, -1, 1.5f), gl.Vertex3f(1, -1, 1.5f), gl.Vertex3f(0, 1, 1.5f);
        gl.End();
    });
    add("mixed_sizes", false, [](const GlTable& gl) {
        light(gl);
        gl.Begin(GL_TRIANGLE_STRIP);
        for (int i = 0; i < points; ++i) {
            float p[3];
            place(i, p);
            i % 2 ? gl.Color4d(0.3, 0.02 * i, 0.7, 0.5)
                  : gl.Color3f(0.9f, 0.1f, 0.01f * static_cast<float>(i));
            if (i % 3 == 0) gl.Normal3f(p[0], 0, p[2]);
            i % 2   ? gl.Vertex2d(p[0], p[1])
            : i % 4 ? gl.Vertex4f(p[0], p[1], p[2], 1.25f)
                    : gl.Vertex3d(p[0], p[1], p[2]);
        }
        gl.End();
    });
    add("textured", true, [](const GlTable& gl) {
        begin_scene(gl);
        GLubyte texels[8 * 8 * 3];
        for (int i = 0; i < 192; ++i) texels[i] = static_cast<GLubyte>(i * 37);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
        gl.Enable(GL_TEXTURE_2D);
        gl.Begin(GL_QUAD_STRIP);
        for (int i = 0; i < points; ++i) {
            float p[3];
            place(i, p);
            gl.TexCoord2d(0.1 * i, 0.3 * (i % 2));
            gl.MultiTexCoord2f(GL_TEXTURE1, p[0], p[1]);
            gl.Vertex3fv(p);
        }
        gl.End();
    });
    add("in_a_list", true, [](const GlTable& gl) {
        light(gl);
        gl.NewList(7, GL_COMPILE);
        band(gl, GL_TRIANGLES);
        gl.EndList();
        gl.Color3f(0, 1, 0);
        gl.CallList(7);
        gl.Rotatef(80, 0, 1, 0);
        gl.CallList(7);
    });
    add("few", false, [](const GlTable& gl) { light(gl), band(gl, GL_TRIANGLES, 12); });
    add("colour_from_the_second_vertex_on", false, [](const GlTable& gl) {
        light(gl);
        gl.Color3f(1, 0, 1);
        gl.Begin(GL_TRIANGLES);
        for (int i = 0; i < points; ++i) {
            float p[3];
            place(i, p);
            if (i == 1) gl.Color3f(0, 1, 0);
            gl.Vertex3fv(p);
        }
        gl.End();
    });
    add("materials_between", false, [](const GlTable& gl) {
        light(gl);
        gl.Disable(GL_COLOR_MATERIAL);
        gl.Begin(GL_TRIANGLES);
        for (int i = 0; i < points; ++i) {
            float p[3];
            place(i, p);
            const GLfloat colour[] = {0.01f * static_cast<float>(i), 0.5f, 0.2f, 1};
            gl.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, colour);
            gl.Normal3f(p[0], 0, p[2]);
            gl.Vertex3fv(p);
        }
        gl.End();
    });
    add("edge_flags", false, [](const GlTable& gl) {
        light(gl);
        gl.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        gl.Begin(GL_TRIANGLES);
        for (int i = 0; i < points; ++i) {
            float p[3];
            place(i, p);
            gl.EdgeFlag(i % 2 ? GL_TRUE : GL_FALSE);
            gl.Vertex3fv(p);
        }
        gl.End();
    });
    return all;
}

class Preparing : public testing::TestWithParam<Drawing> {};

TEST_P(Preparing, draws_the_same_to_the_bit) {
    Rig rig;
    rig.begin();
    GetParam().frame(rig.gl());
    rig.end();
    long by_calls = 0, prepared = 0;
    const Picture expected = replay(rig, by_calls);
    EXPECT_GT(Rig::covered(expected), 20u) << "it draws nothing";
    record::prepare(*rig.frame);
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(replay(rig, prepared) == expected) << "replay " << i;
    EXPECT_GT(by_calls, 0);
    EXPECT_EQ(prepared < by_calls, GetParam().from_arrays) << prepared << " of " << by_calls;
}
INSTANTIATE_TEST_SUITE_P(Drawings, Preparing, testing::ValuesIn(drawings()),
                         [](const auto& info) { return info.param.name; });

TEST(Preparing, leaves_what_does_not_fit_into_memory_as_it_is) {
    Rig rig;
    rig.begin();
    light(rig.gl());
    band(rig.gl(), GL_TRIANGLES, 300000);
    rig.end();
    long by_calls = 0, prepared = 0;
    const Picture expected = replay(rig, by_calls);
    record::set_memory_limit(1 << 20);
    record::prepare(*rig.frame);
    record::set_memory_limit(SIZE_MAX);
    EXPECT_TRUE(replay(rig, prepared) == expected);
    EXPECT_EQ(prepared, by_calls);
}

} // namespace
} // namespace glcast::test
