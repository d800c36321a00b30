// Display lists: Mesa's own execution of them is the oracle.
#include "tests/record/rig.h"

namespace glcast::test {
namespace {

void call_bytes(const GlTable& gl, GLenum type, const void* lists, GLsizei n) {
    begin_scene(gl);
    gl.Translatef(-1.5f, 0, 0);
    gl.CallLists(n, type, lists);
}

/// Lists first + 1 ... first + 4, each a triangle and a step aside.
void make_row(const GlTable& gl, GLuint first) {
    for (GLuint i = 1; i <= 4; ++i) {
        gl.NewList(first + i, GL_COMPILE);
        triangle(gl, 0, 0.3f * float(i) - 0.6f, 0, 0.4f);
        gl.Translatef(1, 0, 0.1f);
        gl.EndList();
    }
}

const GLfloat red[] = {1, 0, 0, 1}, green[] = {0.1f, 0.9f, 0.2f, 1};

const Case cases[] = {
    {"compile",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE);
         triangle(gl);
         gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
     }},
    {"compiled_in_the_frame", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.NewList(1, GL_COMPILE);
         triangle(gl);
         gl.EndList();
         gl.CallList(1);
     }},
    {"compile_and_execute", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.NewList(1, GL_COMPILE_AND_EXECUTE);
         gl.Translatef(-1, 0, 0);
         triangle(gl);
         gl.EndList();
         gl.Translatef(2, 0.5f, 0);
         gl.CallList(1);
     }},
    {"called_while_compiled_and_executed",
     [](auto& gl) {
         gl.NewList(2, GL_COMPILE);
         triangle(gl, 0.5f);
         gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.NewList(1, GL_COMPILE_AND_EXECUTE);
         gl.CallList(2);
         gl.EndList();
         gl.Translatef(-1, 0, 0);
         gl.CallList(1);
     }},
    {"nested_with_matrices",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), triangle(gl, 0, 0, 0, 0.5f), gl.EndList();
         gl.NewList(2, GL_COMPILE);
         for (int i = 0; i < 4; ++i) {
             gl.PushMatrix();
             gl.Rotatef(90.f * float(i), 0, 0, 1);
             gl.Translatef(1, 0, 0);
             gl.CallList(1);
             gl.PopMatrix();
         }
         gl.EndList();
         gl.NewList(3, GL_COMPILE), gl.Scalef(0.9f, 0.8f, 1), gl.CallList(2), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(3);
     }},
    {"inner_list_defined_later",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), gl.CallList(2), gl.EndList();
         gl.NewList(2, GL_COMPILE), triangle(gl), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
     }},
    {"redefined_in_the_frame",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), triangle(gl, -1), gl.EndList();
         gl.NewList(2, GL_COMPILE), gl.CallList(1), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(2);
         gl.NewList(1, GL_COMPILE), triangle(gl, 1, 0, 0, 0.5f), gl.EndList();
         gl.CallList(2);
     }},
    {"redefined_between_compile_and_call",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), triangle(gl, -1), gl.EndList();
         gl.NewList(2, GL_COMPILE), gl.CallList(1), gl.EndList();
         gl.NewList(1, GL_COMPILE), triangle(gl, 1, 0.5f, 0, 0.7f), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(2);
     }},
    {"deleted_between_compile_and_call",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), triangle(gl, -1), gl.EndList();
         gl.NewList(2, GL_COMPILE), gl.Rectf(-1, -1, 0, 0), gl.CallList(1), gl.Rectf(0.5f, 0.5f, 1, 1),
             gl.EndList();
         gl.DeleteLists(1, 1);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(2);
     }},
    {"redefined_while_it_is_compiled_and_executed",
     [](auto& gl) { gl.NewList(1, GL_COMPILE), triangle(gl, -1), gl.EndList(); },
     [](auto& gl) {
         begin_scene(gl);
         gl.NewList(1, GL_COMPILE_AND_EXECUTE);
         gl.CallList(1); // the one before: the new one takes its place at glEndList
         triangle(gl, 1, 0, 0, 0.5f);
         gl.EndList();
     }},
    {"errors_inside_begin", [](auto& gl) { gl.NewList(1, GL_COMPILE), triangle(gl, 0.5f), gl.EndList(); },
     [](auto& gl) {
         begin_scene(gl);
         gl.Begin(GL_TRIANGLES);
         gl.NewList(1, GL_COMPILE); // refused, and so are these
         gl.EndList(), gl.DeleteLists(1, 1);
         gl.Vertex2f(-1, -1), gl.Vertex2f(0, -1), gl.Vertex2f(-1, 0);
         gl.End();
         while (gl.GetError() != GL_NO_ERROR) {
         }
         gl.CallList(1);
     }},
    {"elements_of_a_buffer_that_goes", nullptr,
     [](auto& gl) {
         const GLfloat vertices[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
         const GLubyte indices[] = {0, 1, 2, 0, 2, 3};
         GLuint buffers[2] = {};
         begin_scene(gl);
         gl.Color3f(0, 1, 1);
         gl.GenBuffers(2, buffers);
         gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]),
             gl.BufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STATIC_DRAW);
         gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
         gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
         gl.VertexPointer(3, GL_FLOAT, 0, nullptr), gl.EnableClientState(GL_VERTEX_ARRAY);
         gl.NewList(1, GL_COMPILE), gl.DrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_BYTE, nullptr), gl.EndList();
         gl.DisableClientState(GL_VERTEX_ARRAY);
         gl.DeleteBuffers(2, buffers);
         gl.CallList(1);
     }},
    {"interleaved_elements_dereferenced", nullptr,
     [](auto& gl) {
         GLfloat vertices[3][6] = {{1, 0, 0, -1, -1, 0}, {0, 1, 0, 1, -1, 0}, {0, 0, 1, 0, 1, 0}};
         begin_scene(gl);
         gl.InterleavedArrays(GL_C3F_V3F, 0, vertices);
         gl.NewList(1, GL_COMPILE);
         gl.Begin(GL_TRIANGLES);
         for (GLint i = 0; i < 3; ++i) gl.ArrayElement(i);
         gl.End();
         gl.EndList();
         for (auto& vertex : vertices) vertex[3] *= 0.1f;
         gl.CallList(1);
         gl.DisableClientState(GL_VERTEX_ARRAY), gl.DisableClientState(GL_COLOR_ARRAY);
     }},
    {"deleted_in_the_frame", [](auto& gl) { gl.NewList(1, GL_COMPILE), triangle(gl), gl.EndList(); },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         gl.DeleteLists(1, 1000000);
         gl.Translatef(1, 0, 1);
         gl.CallList(1);
     }},
    // Rectangles, since Mesa 22.3 overflows its stack at the end of some lists that have vertices and call
    // themselves.
    {"calls_itself",
     [](auto& gl) {
         gl.NewList(7, GL_COMPILE);
         gl.Rectf(-1.5f, -1.5f, -1.2f, -1.3f);
         gl.Translatef(0.04f, 0.03f, 0.01f);
         gl.CallList(7);
         gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(7);
         gl.Color3f(1, 0, 0), gl.Rectf(-1.5f, -1.5f, -1, -1.3f);
     }},
    {"nested_deeper_than_gl_goes",
     [](auto& gl) {
         for (GLuint i = 80; i > 0; --i) {
             gl.NewList(i, GL_COMPILE);
             gl.Rectf(-1.5f, -1.5f, -1.3f, -1.3f);
             gl.Translatef(0.04f, 0.03f, 0.01f);
             gl.CallList(i + 1);
             gl.EndList();
         }
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         triangle(gl, -1.5f, -1, 0, 0.1f);
     }},
    {"materials_and_lights_inside",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE);
         gl.Enable(GL_LIGHTING);
         gl.Materialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, red);
         gl.Lightfv(GL_LIGHT0, GL_AMBIENT, green);
         gl.Normal3f(0, 0, 1);
         triangle(gl);
         gl.Disable(GL_LIGHTING);
         gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         triangle(gl, 1, 1, 0, 0.4f);
     }},
    {"state_left_by_a_list",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), gl.Color3f(1, 1, 0), gl.Translatef(0.5f, 0, 0), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         gl.Rectf(-1, -1, 0.5f, 0.5f);
     }},
    {"attributes_pushed_inside",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE);
         gl.PushAttrib(GL_ALL_ATTRIB_BITS);
         gl.Color3f(0, 1, 1);
         gl.ListBase(40);
         gl.Rectf(-1, -1, 0, 0);
         gl.PopAttrib();
         gl.EndList();
         gl.NewList(5, GL_COMPILE), gl.Rectf(0, 0, 1, 1), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Color3f(1, 0.5f, 0);
         gl.CallList(1);
         const GLubyte five = 5;
         gl.CallLists(1, GL_UNSIGNED_BYTE, &five);
     }},
    {"list_base_in_a_list",
     [](auto& gl) {
         make_row(gl, 100);
         gl.NewList(1, GL_COMPILE), gl.ListBase(100), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         gl.CallLists(2, GL_UNSIGNED_BYTE, "\1\3");
     }},
    {"list_base_at_frame_start",
     [](auto& gl) {
         make_row(gl, 100);
         gl.ListBase(100);
     },
     [](auto& gl) { call_bytes(gl, GL_UNSIGNED_BYTE, "\1\2\3\4", 4); }},
    {"call_lists_byte", [](auto& gl) { make_row(gl, 98), gl.ListBase(100); },
     [](auto& gl) {
         const GLbyte n[] = {-1, 0, 1, 2};
         call_bytes(gl, GL_BYTE, n, 4);
     }},
    {"call_lists_short", [](auto& gl) { make_row(gl, 1098), gl.ListBase(1100); },
     [](auto& gl) {
         const GLshort n[] = {-1, 0, 1, 2};
         call_bytes(gl, GL_SHORT, n, 4);
     }},
    {"call_lists_ushort", [](auto& gl) { make_row(gl, 60000); },
     [](auto& gl) {
         const GLushort n[] = {60001, 60002, 60003};
         call_bytes(gl, GL_UNSIGNED_SHORT, n, 3);
     }},
    {"call_lists_int", [](auto& gl) { make_row(gl, 98), gl.ListBase(100); },
     [](auto& gl) {
         const GLint n[] = {-1, 0, 1, 2};
         call_bytes(gl, GL_INT, n, 4);
     }},
    {"call_lists_uint", [](auto& gl) { make_row(gl, 100000); },
     [](auto& gl) {
         const GLuint n[] = {100001, 100002, 100003};
         call_bytes(gl, GL_UNSIGNED_INT, n, 3);
     }},
    {"call_lists_float", [](auto& gl) { make_row(gl, 98), gl.ListBase(100); },
     [](auto& gl) {
         const GLfloat n[] = {-1, 0.9f, 1, 2};
         call_bytes(gl, GL_FLOAT, n, 4);
     }},
    {"call_lists_2_bytes", [](auto& gl) { make_row(gl, 0x1FE); },
     [](auto& gl) {
         const GLubyte n[] = {1, 0xFF, 2, 0, 2, 1};
         call_bytes(gl, GL_2_BYTES, n, 3);
     }},
    {"call_lists_3_bytes", [](auto& gl) { make_row(gl, 0x1FE); },
     [](auto& gl) {
         const GLubyte n[] = {0, 1, 0xFF, 0, 2, 0};
         call_bytes(gl, GL_3_BYTES, n, 2);
     }},
    {"call_lists_4_bytes", [](auto& gl) { make_row(gl, 0x1FE); },
     [](auto& gl) {
         const GLubyte n[] = {0, 0, 1, 0xFF, 0, 0, 2, 0};
         call_bytes(gl, GL_4_BYTES, n, 2);
     }},
    {"begin_outside_vertices_inside",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE);
         gl.Color3f(1, 0, 1), gl.Vertex2f(-1, -1), gl.Vertex2f(1, -1), gl.Vertex2f(0, 1);
         gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Begin(GL_TRIANGLES);
         gl.CallList(1);
         gl.End();
     }},
    {"begin_inside_end_outside",
     [](auto& gl) {
         gl.NewList(1, GL_COMPILE), gl.Begin(GL_TRIANGLES), gl.Color3f(1, 1, 1), gl.Vertex2f(-1, -1),
             gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         gl.Vertex2f(1, -1), gl.Vertex2f(0, 1);
         gl.End();
         triangle(gl, 1, 1, -1);
     }},
    {"arrays_dereferenced_at_compile_time", nullptr,
     [](auto& gl) {
         GLfloat vertices[] = {-1, -1, 1, -1, 0, 1};
         begin_scene(gl);
         gl.Color3f(1, 1, 0);
         gl.VertexPointer(2, GL_FLOAT, 0, vertices);
         gl.EnableClientState(GL_VERTEX_ARRAY);
         gl.NewList(1, GL_COMPILE), gl.DrawArrays(GL_TRIANGLES, 0, 3), gl.EndList();
         for (GLfloat& v : vertices) v *= 0.2f;
         gl.CallList(1);
         gl.DisableClientState(GL_VERTEX_ARRAY);
     }},
    {"texture_uploaded_by_a_list",
     [](auto& gl) {
         const GLubyte image[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
         gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
         gl.NewList(1, GL_COMPILE);
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, image);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
         gl.Enable(GL_TEXTURE_2D);
         gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         gl.Begin(GL_QUADS);
         gl.TexCoord2f(0, 0), gl.Vertex2f(-1, -1), gl.TexCoord2f(1, 0), gl.Vertex2f(1, -1);
         gl.TexCoord2f(1, 1), gl.Vertex2f(1, 1), gl.TexCoord2f(0, 1), gl.Vertex2f(-1, 1);
         gl.End();
     }},
    {"bitmap_font",
     [](auto& gl) {
         const GLubyte glyph[] = {0xF0, 0x81, 0xA5, 0x81, 0x99, 0x81, 0xFF, 0x18};
         gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
         gl.NewList(100 + 'a', GL_COMPILE), gl.Bitmap(8, 8, 0, 0, 9, 1, glyph), gl.EndList();
         gl.PixelStorei(GL_UNPACK_LSB_FIRST, 1);
         gl.NewList(100 + 'b', GL_COMPILE), gl.Bitmap(5, 8, 0, 0, 9, -1, glyph), gl.EndList();
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.RasterPos2f(-1, 0);
         gl.ListBase(100);
         gl.CallLists(4, GL_UNSIGNED_BYTE, "abab");
     }},
};

class ListCase : public testing::TestWithParam<Case> {};
TEST_P(ListCase, replays_as_drawn) {
    Rig rig;
    expect_same_image(rig, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Lists, ListCase, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

TEST(Lists, defined_in_one_context_called_in_another) {
    Rig rig;
    OsmesaContext other(8, 8, &rig.program);
    auto other_shadow = record::make_context(other.gl(), rig.context);
    record::set_current(other_shadow.get(), other.gl());
    rig.gl().NewList(9, GL_COMPILE), triangle(rig.gl()), rig.gl().EndList();
    rig.begin();
    begin_scene(rig.gl());
    rig.gl().CallList(9);
    other.make_current();
    record::set_current(other_shadow.get(), other.gl());
    rig.gl().NewList(9, GL_COMPILE), triangle(rig.gl(), 1, 1, 0, 0.5f), rig.gl().EndList();
    rig.program.make_current();
    record::set_current(rig.context.get(), rig.program.gl());
    rig.gl().CallList(9);
    rig.end();
    const Picture direct = rig.direct();
    EXPECT_GT(Rig::covered(direct), 20u);
    EXPECT_TRUE(rig.replayed() == direct);
}

TEST(Lists, deleted_by_another_context) {
    Rig rig;
    OsmesaContext other(8, 8, &rig.program);
    auto other_shadow = record::make_context(other.gl(), rig.context);
    rig.gl().NewList(9, GL_COMPILE), triangle(rig.gl()), rig.gl().EndList();
    rig.gl().NewList(10, GL_COMPILE), rig.gl().CallList(9), rig.gl().EndList();
    rig.begin();
    begin_scene(rig.gl());
    rig.gl().CallList(10);
    other.make_current();
    record::set_current(other_shadow.get(), other.gl());
    rig.gl().DeleteLists(9, 1);
    rig.program.make_current();
    record::set_current(rig.context.get(), rig.program.gl());
    rig.gl().Translatef(1.5f, 0, 1);
    rig.gl().CallList(10);
    rig.end();
    const Picture direct = rig.direct();
    EXPECT_GT(Rig::covered(direct), 20u);
    EXPECT_TRUE(rig.replayed() == direct);
}

TEST(Lists, opaque_lists_are_counted_and_skipped) {
    Rig rig;
    record::note_opaque_lists(*rig.context, 50, 10);
    rig.begin();
    rig.gl().CallList(53);
    rig.end();
    EXPECT_EQ(record::not_understood(*rig.frame).at("a display list whose contents are unknown"), 1);
}

TEST(Lists, failed_calls_change_nothing) {
    Rig rig;
    const GlTable& gl = rig.gl();
    gl.NewList(1, GL_COMPILE), triangle(gl), gl.EndList();
    gl.NewList(0, GL_COMPILE);
    EXPECT_EQ(gl.GetError(), GLenum(GL_INVALID_VALUE));
    gl.NewList(1, GL_RENDER);
    EXPECT_EQ(gl.GetError(), GLenum(GL_INVALID_ENUM));
    gl.EndList();
    EXPECT_EQ(gl.GetError(), GLenum(GL_INVALID_OPERATION));
    EXPECT_EQ(record::active, 0u);
    gl.NewList(2, GL_COMPILE);
    EXPECT_EQ(record::active, 1u);
    gl.NewList(1, GL_COMPILE);
    EXPECT_EQ(gl.GetError(), GLenum(GL_INVALID_OPERATION));
    gl.EndList();
    EXPECT_EQ(record::active, 0u);
    rig.begin(), begin_scene(gl), gl.CallList(1), rig.end();
    const Picture direct = rig.direct();
    EXPECT_GT(Rig::covered(direct), 20u);
    EXPECT_TRUE(rig.replayed() == direct);
}

TEST(Lists, vertices_are_small) {
    Rig rig;
    const GlTable& gl = rig.gl();
    constexpr int vertices = 100000;
    gl.NewList(1, GL_COMPILE);
    gl.Begin(GL_POINTS);
    for (int i = 0; i < vertices; ++i) gl.Vertex3f(float(i), 0, 0);
    gl.End();
    gl.EndList();
    rig.begin();
    rig.end();
    EXPECT_LT(record::frame_bytes(*rig.frame), vertices * 20u);
}

} // namespace
} // namespace glcast::test
