// Textures, pixels, evaluators.
#include "tests/record/rig.h"

namespace glcast::test {
namespace {

const GLubyte image[] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0,   255,
                         9,   9, 9, 255, 0, 200, 9, 255, 0, 7, 255, 255, 255, 255, 255, 255};

void nearest(const GlTable& gl, GLenum target) {
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void textured_quad(const GlTable& gl, float s = 1) {
    gl.Begin(GL_QUADS);
    gl.TexCoord2f(0, 0), gl.Vertex2f(-1, -1), gl.TexCoord2f(s, 0), gl.Vertex2f(1, -1);
    gl.TexCoord2f(s, s), gl.Vertex2f(1, 1), gl.TexCoord2f(0, s), gl.Vertex2f(-1, 1);
    gl.End();
}

GLuint named_texture(const GlTable& gl) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
    nearest(gl, GL_TEXTURE_2D);
    return name;
}

void make_maps(const GlTable& gl) {
    GLfloat points[4][4][5]; // with room between the points: the strides matter
    for (int u = 0; u < 4; ++u)
        for (int v = 0; v < 4; ++v) {
            points[u][v][0] = float(u) * 0.6f - 1;
            points[u][v][1] = float(v) * 0.6f - 1;
            points[u][v][2] = (u == 1 || u == 2) && (v == 1 || v == 2) ? 1.f : 0.f;
        }
    gl.Map2f(GL_MAP2_VERTEX_3, 0, 1, 20, 4, 0, 1, 5, 4, &points[0][0][0]);
    const GLdouble colours[2][2][4] = {{{1, 0, 0, 1}, {0, 1, 0, 1}}, {{0, 0, 1, 1}, {1, 1, 0, 1}}};
    gl.Map2d(GL_MAP2_COLOR_4, 0, 1, 8, 2, 0, 1, 4, 2, &colours[0][0][0]);
    gl.Enable(GL_MAP2_VERTEX_3);
    gl.Enable(GL_MAP2_COLOR_4);
    gl.MapGrid2f(6, 0, 1, 5, 0, 1);
}

const Case cases[] = {
    {"default_texture_at_frame_start",
     [](auto& gl) {
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
         nearest(gl, GL_TEXTURE_2D);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         textured_quad(gl);
     }},
    {"default_texture_uploaded_in_the_frame", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         nearest(gl, GL_TEXTURE_2D);
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
         textured_quad(gl);
         gl.TexSubImage2D(GL_TEXTURE_2D, 0, 1, 0, 2, 2, GL_BGRA, GL_UNSIGNED_BYTE, image + 8);
         gl.Translatef(1, 1, 1);
         textured_quad(gl);
     }},
    // Not both at once: Mesa 22.3 swaps the wrong bytes then.
    {"copied_into_the_default_texture", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         triangle(gl, 0, 0, 0, 2.5f);
         gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 32, 32, 0);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         gl.Rectf(-2, -2, -1, -1);
         gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 4, 4, 8, 8, 16, 12);
         gl.Enable(GL_TEXTURE_2D);
         gl.Color3f(1, 1, 1);
         textured_quad(gl);
     }},
    {"unpacked_with_swapped_bytes", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         nearest(gl, GL_TEXTURE_2D);
         gl.PixelStorei(GL_UNPACK_SWAP_BYTES, 1);
         const GLushort shorts[] = {0x00FF, 0xF040, 0x1280, 0x0180, 0x7F01, 0x55C0, 0xFFFF, 0x8000};
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 4, 2, 0, GL_LUMINANCE, GL_UNSIGNED_SHORT, shorts);
         textured_quad(gl);
     }},
    {"unpacked_with_skips", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         nearest(gl, GL_TEXTURE_2D);
         gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 4);
         gl.PixelStorei(GL_UNPACK_SKIP_PIXELS, 1);
         gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 1);
         gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
         const GLushort shorts[] = {0, 0, 0, 0, 0, 0x40FF, 0xF0F0, 0x1234, 0, 0x9999, 0x6000, 0, 9, 9};
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 2, 2, 0, GL_LUMINANCE, GL_UNSIGNED_SHORT, shorts);
         textured_quad(gl);
     }},
    {"one_dimensional", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.TexImage1D(GL_TEXTURE_1D, 0, GL_RGBA, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
         nearest(gl, GL_TEXTURE_1D);
         gl.Enable(GL_TEXTURE_1D);
         textured_quad(gl);
     }},
    {"three_dimensional",
     [](auto& gl) {
         gl.TexImage3D(GL_TEXTURE_3D, 0, GL_RGBA, 2, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
         nearest(gl, GL_TEXTURE_3D);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_3D);
         textured_quad(gl);
         gl.TexCoord3f(0.9f, 0.9f, 0.9f);
         gl.Translatef(1, 1, 0);
         gl.Rectf(0, 0, 1, 1);
     }},
    {"cube_map",
     [](auto& gl) {
         for (int face = 0; face < 6; ++face)
             gl.TexImage2D(GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face), 0, GL_RGBA, 1, 1, 0, GL_RGBA,
                           GL_UNSIGNED_BYTE, image + 4 * face);
         nearest(gl, GL_TEXTURE_CUBE_MAP);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_CUBE_MAP);
         for (const GLenum s : {GL_S, GL_T, GL_R}) gl.TexGeni(s, GL_TEXTURE_GEN_MODE, GL_NORMAL_MAP);
         for (const GLenum s : {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R}) gl.Enable(s);
         gl.Begin(GL_TRIANGLES);
         gl.Normal3f(-1, 0, 0.5f), gl.Vertex2f(-1, -1), gl.Normal3f(1, 0, 0.5f), gl.Vertex2f(1, -1);
         gl.Normal3f(0, 1, 0.5f), gl.Vertex2f(0, 1);
         gl.End();
     }},
    {"named_texture", named_texture,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         textured_quad(gl);
     }},
    {"named_texture_made_in_the_frame", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         named_texture(gl);
         gl.Enable(GL_TEXTURE_2D);
         textured_quad(gl);
     }},
    {"environment_and_generation", named_texture,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_BLEND);
         const GLfloat blue[] = {0, 0, 1, 1}, plane[] = {0.7f, 0, 0, 0.3f};
         gl.TexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, blue);
         gl.TexGenfv(GL_S, GL_EYE_PLANE, plane);
         gl.TexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
         gl.Enable(GL_TEXTURE_GEN_S);
         gl.MatrixMode(GL_TEXTURE);
         gl.Scalef(1.3f, 2, 1);
         gl.MatrixMode(GL_MODELVIEW);
         textured_quad(gl);
     }},
    {"mipmaps_of_the_default_texture",
     [](auto& gl) {
         gl.TexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, 1);
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_2D);
         textured_quad(gl, 40);
     }},
    {"pixels", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.RasterPos3f(-0.5f, -0.5f, 0);
         gl.PixelZoom(6, 5);
         gl.PixelTransferf(GL_RED_BIAS, 0.3f);
         gl.DrawPixels(4, 2, GL_RGBA, GL_UNSIGNED_BYTE, image);
     }},
    {"raster_position_at_frame_start",
     [](auto& gl) { gl.Color3f(1, 0.5f, 0), gl.WindowPos3f(20, 30, 0.25f); },
     [](auto& gl) {
         gl.ClearColor(0, 0, 0.5f, 1);
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
         gl.Bitmap(32, 1, 0, 0, 0, 2, image);
         gl.Bitmap(32, 1, 0, 0, 0, 2, image);
     }},
    {"stipple", nullptr,
     [](auto& gl) {
         GLubyte mask[128];
         for (int i = 0; i < 128; ++i) mask[i] = GLubyte(i * 37);
         begin_scene(gl);
         gl.PolygonStipple(mask);
         gl.Enable(GL_POLYGON_STIPPLE);
         triangle(gl);
     }},
    {"evaluators_at_frame_start", make_maps,
     [](auto& gl) {
         begin_scene(gl);
         gl.EvalMesh2(GL_FILL, 0, 6, 0, 5);
     }},
    {"evaluators_in_the_frame", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         make_maps(gl);
         gl.EvalMesh2(GL_FILL, 0, 6, 0, 5);
     }},
    {"evaluators_in_a_list", [](auto& gl) { gl.NewList(1, GL_COMPILE), make_maps(gl), gl.EndList(); },
     [](auto& gl) {
         begin_scene(gl);
         gl.CallList(1);
         gl.EvalMesh2(GL_FILL, 1, 6, 0, 4);
     }},
    {"automatic_normals", make_maps,
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_AUTO_NORMAL);
         gl.Enable(GL_LIGHTING);
         gl.Begin(GL_TRIANGLE_STRIP);
         for (int i = 0; i <= 6; ++i) gl.EvalPoint2(i, 1), gl.EvalPoint2(i, 3);
         gl.End();
     }},
    {"one_dimensional_maps", nullptr,
     [](auto& gl) {
         const GLfloat points[] = {-1, -1, 0, 0.5f, 3, 0, 1, -1, 0};
         begin_scene(gl);
         gl.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 3, points);
         gl.Enable(GL_MAP1_VERTEX_3);
         gl.Begin(GL_POLYGON);
         for (int i = 0; i <= 12; ++i) gl.EvalCoord1f(float(i) / 12);
         gl.End();
     }},
};

class ImageCase : public testing::TestWithParam<Case> {};
TEST_P(ImageCase, replays_as_drawn) {
    Rig rig;
    expect_same_image(rig, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Images, ImageCase, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

TEST(Images, uploads_to_named_textures_are_not_repeated) {
    Rig rig;
    const GlTable& gl = rig.gl();
    rig.begin();
    const GLuint name = named_texture(gl);
    rig.end();
    GLubyte white[32];
    std::memset(white, 255, sizeof white);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, white);
    rig.replayed();
    rig.program.make_current();
    GLubyte now[32] = {};
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, now);
    EXPECT_EQ(std::memcmp(now, white, sizeof now), 0);
}

TEST(Images, deleted_textures_are_not_made_again) {
    Rig rig;
    const GlTable& gl = rig.gl();
    rig.begin();
    const GLuint name = named_texture(gl);
    gl.DeleteTextures(1, &name);
    rig.end();
    rig.replayed();
    rig.program.make_current();
    EXPECT_FALSE(gl.IsTexture(name));
}

} // namespace
} // namespace glcast::test
