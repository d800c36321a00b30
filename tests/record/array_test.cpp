// Client arrays and buffer objects.
#include <array>

#include "tests/record/rig.h"

namespace glcast::test {
namespace {

struct Vertex {
    GLubyte colour[4];
    GLfloat normal[3];
    GLfloat position[3];
};
const Vertex fan[] = {
    {{255, 255, 255, 255}, {0, 0, 1}, {0, 0, 0.3f}},    {{255, 0, 0, 255}, {1, 0, 1}, {1, 0, 0}},
    {{255, 255, 0, 255}, {1, 1, 1}, {0.5f, 0.9f, 0}},   {{0, 255, 0, 255}, {-1, 1, 1}, {-0.5f, 0.9f, 0}},
    {{0, 255, 255, 255}, {-1, 0, 1}, {-1, 0, 0}},       {{0, 0, 255, 255}, {-1, -1, 1}, {-0.5f, -0.9f, 0}},
    {{255, 0, 255, 255}, {1, -1, 1}, {0.5f, -0.9f, 0}}, {{9, 99, 199, 255}, {0, 0, 1}, {1, 0, 0.1f}},
};
const GLubyte indices8[] = {0, 1, 2, 0, 3, 4, 0, 5, 6};
const GLushort indices16[] = {0, 1, 2, 0, 3, 4, 0, 5, 6};
const GLuint indices32[] = {0, 1, 2, 0, 3, 4, 0, 5, 6};

const std::byte* at(const void* base, std::size_t offset) {
    return static_cast<const std::byte*>(base) + offset;
}

void set_arrays(const GlTable& gl, const void* base) {
    gl.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), at(base, offsetof(Vertex, colour)));
    gl.NormalPointer(GL_FLOAT, sizeof(Vertex), at(base, offsetof(Vertex, normal)));
    gl.VertexPointer(3, GL_FLOAT, sizeof(Vertex), at(base, offsetof(Vertex, position)));
    for (const GLenum array : {GL_COLOR_ARRAY, GL_NORMAL_ARRAY, GL_VERTEX_ARRAY}) gl.EnableClientState(array);
}

GLuint make_buffer(const GlTable& gl, GLenum target, const void* data, std::size_t bytes) {
    GLuint name = 0;
    gl.GenBuffers(1, &name);
    gl.BindBuffer(target, name);
    gl.BufferData(target, GLsizeiptr(bytes), data, GL_STATIC_DRAW);
    return name;
}

void make_fan_buffers(const GlTable& gl) {
    make_buffer(gl, GL_ARRAY_BUFFER, fan, sizeof fan);
    set_arrays(gl, nullptr);
    make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, indices16, sizeof indices16);
}

/// Fixed-function programs may set 0xFF.. in strips to cut them.
void restart_strip(const GlTable& gl, GLenum type, const void* indices, GLsizei n, GLuint restart) {
    begin_scene(gl);
    set_arrays(gl, fan);
    gl.Enable(GL_PRIMITIVE_RESTART);
    gl.PrimitiveRestartIndex(restart);
    gl.DrawElements(GL_TRIANGLE_STRIP, n, type, indices);
    gl.Disable(GL_PRIMITIVE_RESTART);
}

const Case cases[] = {
    {"arrays", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawArrays(GL_TRIANGLE_FAN, 0, 7);
     }},
    {"arrays_not_from_0", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawArrays(GL_TRIANGLES, 3, 3);
     }},
    {"set_before_the_frame", [](auto& gl) { set_arrays(gl, fan); },
     [](auto& gl) {
         begin_scene(gl);
         gl.DrawArrays(GL_TRIANGLE_FAN, 0, 7);
     }},
    {"lit", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_LIGHTING);
         gl.Enable(GL_COLOR_MATERIAL);
         gl.Enable(GL_NORMALIZE);
         set_arrays(gl, fan);
         gl.DrawArrays(GL_TRIANGLE_FAN, 0, 7);
     }},
    {"elements_ubyte", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_BYTE, indices8);
     }},
    {"elements_ushort", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_SHORT, indices16);
     }},
    {"elements_uint", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_INT, indices32);
     }},
    {"range_elements", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawRangeElements(GL_TRIANGLES, 0, 6, 6, GL_UNSIGNED_SHORT, indices16 + 3);
     }},
    {"multi_arrays", nullptr,
     [](auto& gl) {
         const GLint first[] = {0, 4};
         const GLsizei count[] = {3, 3};
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.MultiDrawArrays(GL_TRIANGLES, first, count, 2);
     }},
    {"multi_elements", nullptr,
     [](auto& gl) {
         const GLsizei count[] = {3, 0, 3};
         const void* where[] = {indices32, indices32, indices32 + 6};
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.MultiDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, where, 3);
     }},
    {"base_vertex", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawElementsBaseVertex(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, const_cast<GLubyte*>(indices8), 3);
     }},
    {"negative_base_vertex", nullptr,
     [](auto& gl) {
         const GLuint indices[] = {100, 101, 102};
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.DrawElementsBaseVertex(GL_TRIANGLES, 3, GL_UNSIGNED_INT, indices, -98);
     }},
    // From a buffer, since with client arrays llvmpipe falls over such indices by itself.
    {"base_vertex_from_far_off",
     [](auto& gl) { make_fan_buffers(gl), gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0); },
     [](auto& gl) {
         const GLuint indices[] = {2091398468, 2091398469, 2091398470};
         begin_scene(gl);
         gl.DrawElementsBaseVertex(GL_TRIANGLES, 3, GL_UNSIGNED_INT, indices, -2091398468 + 2);
     }},
    {"base_vertex_wraps",
     [](auto& gl) { make_fan_buffers(gl), gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0); },
     [](auto& gl) {
         const GLuint indices[] = {4294967288u, 4294967289u, 4294967290u};
         begin_scene(gl);
         gl.DrawElementsBaseVertex(GL_TRIANGLES, 3, GL_UNSIGNED_INT, indices, 10);
     }},
    {"element_that_restarts", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.Enable(GL_PRIMITIVE_RESTART);
         gl.PrimitiveRestartIndex(1u << 30); // nothing can be read there
         gl.Begin(GL_TRIANGLE_STRIP);
         for (const GLint i : {0, 1, 2, 1 << 30, 3, 4, 5}) gl.ArrayElement(i);
         gl.End();
         gl.Disable(GL_PRIMITIVE_RESTART);
     }},
    {"instanced", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.Enable(GL_BLEND);
         gl.Disable(GL_DEPTH_TEST);
         gl.BlendFunc(GL_CONSTANT_ALPHA, GL_ONE);
         gl.BlendColor(0, 0, 0, 0.25f);
         gl.DrawArraysInstanced(GL_TRIANGLE_FAN, 0, 7, 3);
         gl.DrawElementsInstanced(GL_TRIANGLES, 9, GL_UNSIGNED_SHORT, indices16, 2);
     }},
    {"restart_ushort", nullptr,
     [](auto& gl) {
         const GLushort n[] = {0, 1, 2, 0xFFFF, 0, 3, 4, 0xFFFF, 0xFFFF, 0, 5, 6, 0xFFFF};
         restart_strip(gl, GL_UNSIGNED_SHORT, n, 13, 0xFFFF);
     }},
    {"restart_index_in_range", nullptr,
     [](auto& gl) {
         const GLubyte n[] = {7, 0, 1, 2, 7, 0, 3, 4};
         restart_strip(gl, GL_UNSIGNED_BYTE, n, 8, 7);
     }},
    {"restart_fixed_index", nullptr,
     [](auto& gl) {
         const GLuint n[] = {0, 1, 2, 0xFFFFFFFF, 0, 3, 4};
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.Enable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
         gl.DrawElements(GL_TRIANGLE_STRIP, 7, GL_UNSIGNED_INT, n);
     }},
    {"restart_off_again_for_a_list", nullptr,
     [](auto& gl) {
         const GLubyte n[] = {0, 1, 2, 7, 0, 3, 4};
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.Enable(GL_PRIMITIVE_RESTART);
         gl.PrimitiveRestartIndex(7);
         gl.NewList(1, GL_COMPILE), gl.DrawElements(GL_TRIANGLE_STRIP, 7, GL_UNSIGNED_BYTE, n), gl.EndList();
         gl.Disable(GL_PRIMITIVE_RESTART);
         gl.CallList(1);
     }},
    {"array_element", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.Begin(GL_TRIANGLES);
         for (const GLubyte i : indices8) gl.ArrayElement(i);
         gl.End();
     }},
    {"array_element_in_a_list", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.NewList(3, GL_COMPILE);
         gl.Begin(GL_TRIANGLES);
         for (const GLubyte i : indices8) gl.ArrayElement(i);
         gl.End();
         gl.EndList();
         gl.DisableClientState(GL_COLOR_ARRAY);
         gl.CallList(3);
     }},
    {"array_element_from_a_buffer", make_fan_buffers,
     [](auto& gl) {
         begin_scene(gl);
         gl.Begin(GL_TRIANGLES);
         for (const GLubyte i : indices8) gl.ArrayElement(i);
         gl.End();
     }},
    {"interleaved_arrays", nullptr,
     [](auto& gl) {
         const GLfloat data[][8] = {
             {0, 0, 0, 0, 1, -1, -1, 0}, {1, 0, 0, 1, 1, 1, -1, 0.5f}, {1, 1, 0, 0, 1, 0, 1, 0}};
         begin_scene(gl);
         gl.Enable(GL_LIGHTING);
         gl.InterleavedArrays(GL_T2F_N3F_V3F, 0, data);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
     }},
    {"arrays_changed_between_draws", nullptr,
     [](auto& gl) {
         std::array<Vertex, 8> vertices;
         std::copy(std::begin(fan), std::end(fan), vertices.begin());
         begin_scene(gl);
         set_arrays(gl, vertices.data());
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         for (Vertex& vertex : vertices) vertex.position[1] -= 0.7f;
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
     }},
    {"doubles_and_shorts", nullptr,
     [](auto& gl) {
         const GLdouble positions[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
         const GLushort colours[] = {65535, 0, 0, 0, 65535, 0, 0, 0, 65535};
         begin_scene(gl);
         gl.VertexPointer(3, GL_DOUBLE, 0, positions);
         gl.ColorPointer(3, GL_UNSIGNED_SHORT, 0, colours);
         gl.EnableClientState(GL_VERTEX_ARRAY);
         gl.EnableClientState(GL_COLOR_ARRAY);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
     }},
    {"sparse_indices", nullptr,
     [](auto& gl) {
         std::vector<GLfloat> positions(3 * 200000);
         const GLfloat corners[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
         for (int i = 0; i < 3; ++i) std::copy_n(corners + 3 * i, 3, &positions[std::size_t(3 * 99999 * i)]);
         const GLuint indices[] = {0, 99999, 199998};
         begin_scene(gl);
         gl.VertexPointer(3, GL_FLOAT, 0, positions.data());
         gl.EnableClientState(GL_VERTEX_ARRAY);
         gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, indices);
         gl.DisableClientState(GL_VERTEX_ARRAY);
     }},
    {"generic_attribute_0", nullptr,
     [](auto& gl) {
         const GLfloat positions[] = {-1, -1, 1, -1, 0, 1};
         begin_scene(gl);
         gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, positions);
         gl.EnableVertexAttribArray(0);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         gl.DisableVertexAttribArray(0);
     }},
    {"two_texture_units", nullptr,
     [](auto& gl) {
         const GLfloat positions[] = {-1, -1, 1, -1, 0, 1}, coordinates[] = {0, 0, 4, 0, 0, 4};
         GLuint names[2];
         const GLubyte images[2][16] = {
             {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255},
             {90, 90, 90, 255, 200, 200, 200, 255, 255, 255, 255, 255, 128, 0, 128, 255}};
         gl.GenTextures(2, names);
         begin_scene(gl);
         for (int i = 0; i < 2; ++i) {
             gl.ActiveTexture(GLenum(GL_TEXTURE0 + i));
             gl.BindTexture(GL_TEXTURE_2D, names[i]);
             gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, images[i]);
             gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
             gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
             gl.Enable(GL_TEXTURE_2D);
             gl.ClientActiveTexture(GLenum(GL_TEXTURE0 + i));
             gl.TexCoordPointer(2, GL_FLOAT, 0, coordinates);
             gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
         }
         gl.VertexPointer(2, GL_FLOAT, 0, positions);
         gl.EnableClientState(GL_VERTEX_ARRAY);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
     }},
    {"buffers", make_fan_buffers,
     [](auto& gl) {
         begin_scene(gl);
         gl.DrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_SHORT, nullptr);
     }},
    {"buffers_compiled_into_a_list",
     [](auto& gl) {
         make_fan_buffers(gl);
         gl.NewList(1, GL_COMPILE), gl.DrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_SHORT, nullptr),
             gl.EndList();
         gl.BufferData(GL_ARRAY_BUFFER, 16, nullptr, GL_STATIC_DRAW);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
     }},
    {"element_buffer_with_client_arrays",
     [](auto& gl) {
         make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, indices32, sizeof indices32);
         set_arrays(gl, fan);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.DrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, at(nullptr, 12));
     }},
    {"buffer_changed_in_the_frame", make_fan_buffers,
     [](auto& gl) {
         begin_scene(gl);
         gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, nullptr);
         const GLfloat moved[] = {-1, -1, 0};
         for (int i = 0; i < 6; ++i) {
             gl.BufferSubData(GL_ARRAY_BUFFER,
                              GLintptr(sizeof(Vertex) * (3 + i % 2) + offsetof(Vertex, position)), 12, moved);
             gl.DrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, at(nullptr, 6));
         }
     }},
    {"buffer_deleted_in_the_frame", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         GLuint name = make_buffer(gl, GL_ARRAY_BUFFER, fan, sizeof fan);
         set_arrays(gl, nullptr);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         gl.DeleteBuffers(1, &name);
         set_arrays(gl, fan);
         gl.DrawArrays(GL_TRIANGLES, 3, 3);
     }},
    {"buffer_mapped_in_the_frame", make_fan_buffers,
     [](auto& gl) {
         begin_scene(gl);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         auto* vertices = static_cast<Vertex*>(gl.MapBuffer(GL_ARRAY_BUFFER, GL_READ_WRITE));
         for (int i = 0; i < 7; ++i) vertices[i].position[0] -= 0.8f;
         gl.UnmapBuffer(GL_ARRAY_BUFFER);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
     }},
    {"buffer_mapped_before_the_frame",
     [](auto& gl) {
         make_fan_buffers(gl);
         gl.MapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY);
     },
     [](auto& gl) {
         begin_scene(gl);
         void* data = nullptr;
         gl.GetBufferPointerv(GL_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER, &data);
         std::memcpy(data, fan + 1, sizeof fan - sizeof *fan);
         gl.UnmapBuffer(GL_ARRAY_BUFFER);
         gl.DrawArrays(GL_TRIANGLES, 0, 6);
     }},
    {"persistently_mapped",
     [](auto& gl) {
         GLuint name = 0;
         gl.GenBuffers(1, &name);
         gl.BindBuffer(GL_ARRAY_BUFFER, name);
         const GLbitfield how = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
         gl.BufferStorage(GL_ARRAY_BUFFER, sizeof fan, fan, how);
         gl.MapBufferRange(GL_ARRAY_BUFFER, 0, sizeof fan, how);
         set_arrays(gl, nullptr);
     },
     [](auto& gl) {
         begin_scene(gl);
         void* data = nullptr;
         gl.GetBufferPointerv(GL_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER, &data);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         gl.Finish();
         for (int i = 0; i < 3; ++i) static_cast<Vertex*>(data)[i].position[1] -= 1;
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
     }},
    {"vertex_array_objects", nullptr,
     [](auto& gl) {
         GLuint names[2];
         gl.GenVertexArrays(2, names);
         gl.BindVertexArray(names[0]);
         make_fan_buffers(gl);
         gl.BindVertexArray(names[1]);
         make_buffer(gl, GL_ARRAY_BUFFER, fan + 2, sizeof fan - 2 * sizeof *fan);
         set_arrays(gl, nullptr);
         gl.DisableClientState(GL_COLOR_ARRAY);
         begin_scene(gl);
         gl.BindVertexArray(names[0]);
         gl.DrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_SHORT, nullptr);
         gl.BindVertexArray(names[1]);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         gl.BindVertexArray(0);
     }},
    {"client_attributes_pushed", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         set_arrays(gl, fan);
         gl.PushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
         gl.DisableClientState(GL_COLOR_ARRAY);
         gl.VertexPointer(3, GL_FLOAT, sizeof(Vertex), fan[1].position);
         gl.DrawArrays(GL_TRIANGLES, 0, 3);
         gl.PopClientAttrib();
         gl.DrawArrays(GL_TRIANGLES, 3, 3);
     }},
};

class ArrayCase : public testing::TestWithParam<Case> {};
TEST_P(ArrayCase, replays_as_drawn) {
    Rig rig;
    expect_same_image(rig, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Arrays, ArrayCase, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

TEST(Arrays, only_the_range_is_copied) {
    Rig rig;
    const GlTable& gl = rig.gl();
    std::vector<GLfloat> positions(3 * 1000000);
    gl.VertexPointer(3, GL_FLOAT, 0, positions.data());
    gl.EnableClientState(GL_VERTEX_ARRAY);
    rig.begin();
    const std::size_t empty = 0;
    gl.DrawArrays(GL_TRIANGLES, 900000, 30);
    const GLuint far_apart[] = {0, 500000, 999999};
    gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, far_apart);
    rig.end();
    EXPECT_GT(record::frame_bytes(*rig.frame), empty);
    EXPECT_LT(record::frame_bytes(*rig.frame), 100000u);
}

TEST(Arrays, a_buffer_is_copied_once_however_many_draws) {
    Rig rig;
    const GlTable& gl = rig.gl();
    std::vector<GLfloat> positions(3 * 100000);
    make_buffer(gl, GL_ARRAY_BUFFER, positions.data(), positions.size() * 4);
    gl.VertexPointer(3, GL_FLOAT, 0, nullptr);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    rig.begin();
    for (int i = 0; i < 20; ++i) gl.DrawArrays(GL_POINTS, 0, 100000);
    rig.end();
    EXPECT_LT(record::frame_bytes(*rig.frame), positions.size() * 4 + 200000);
}

TEST(Arrays, draws_beyond_a_buffer_are_counted) {
    Rig rig;
    const GlTable& gl = rig.gl();
    make_fan_buffers(gl);
    rig.begin();
    gl.DrawArrays(GL_TRIANGLES, 6, 30);
    rig.end();
    EXPECT_EQ(record::not_understood(*rig.frame).at("a draw that reads beyond its arrays or buffers"), 1);
}

TEST(Arrays, draws_under_a_program_are_counted_and_left_out) {
    Rig rig;
    const GlTable& gl = rig.gl();
    const GLuint shader = gl.CreateShader(GL_FRAGMENT_SHADER), program = gl.CreateProgram();
    const GLchar* source = "void main() { gl_FragColor = vec4(1.0, 1.0, 0.0, 1.0); }";
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    gl.LinkProgram(program);
    rig.begin();
    begin_scene(gl);
    triangle(gl);
    const Picture without = [&] {
        gl.Finish();
        return rig.direct();
    }();
    gl.UseProgram(program);
    set_arrays(gl, fan);
    triangle(gl, 1, 1);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.UseProgram(0);
    rig.end();
    EXPECT_EQ(record::not_understood(*rig.frame).at("a draw under a GLSL program"), 2);
    EXPECT_FALSE(rig.direct() == without);
    EXPECT_TRUE(rig.replayed() == without);
}

} // namespace
} // namespace glcast::test
