// The texture objects named 0: replays have their own, whether the driver shares them between contexts or
// not.
#include <array>

#include "tests/record/rig.h"

namespace glcast::test {
namespace {

using Texels = std::array<GLubyte, 16>;
constexpr Texels red{255, 0, 0, 255, 255, 0, 0, 255, 200, 0, 0, 255, 255, 0, 0, 255};
constexpr Texels green{0, 255, 0, 255, 0, 200, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255};
constexpr Texels blue{0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 99, 255};

void fill(const GlTable& gl, const Texels& texels, GLenum target = GL_TEXTURE_2D) {
    gl.TexImage2D(target, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
}

void nearest(const GlTable& gl, GLenum target = GL_TEXTURE_2D) {
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/// In the corner that x and y say.
void square(const GlTable& gl, float x, float y) {
    gl.Begin(GL_QUADS);
    gl.TexCoord3f(0, 0, 1), gl.Vertex2f(x, y), gl.TexCoord3f(1, 0, 1), gl.Vertex2f(x + 1, y);
    gl.TexCoord3f(1, 1, 1), gl.Vertex2f(x + 1, y + 1), gl.TexCoord3f(0, 1, 1), gl.Vertex2f(x, y + 1);
    gl.End();
}

void begin_textured(const GlTable& gl) {
    begin_scene(gl);
    gl.Enable(GL_TEXTURE_2D);
    gl.Color3f(1, 1, 1);
}

const Case cases[] = {
    {"filled_before",
     [](auto& gl) {
         nearest(gl);
         fill(gl, red);
     },
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         fill(gl, blue);
         square(gl, 0, 0);
     }},
    {"filled_first_in_the_frame", [](auto& gl) { nearest(gl); },
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1); // incomplete: as if there were no texture
         fill(gl, blue);
         square(gl, 0, 0);
     }},
    {"filled_first_in_the_frame_on_another_unit", [](auto& gl) { nearest(gl); },
     [](auto& gl) {
         begin_textured(gl);
         gl.ActiveTexture(GL_TEXTURE1);
         gl.Enable(GL_TEXTURE_2D);
         gl.MultiTexCoord2f(GL_TEXTURE1, 0.7f, 0.7f);
         gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_ADD);
         fill(gl, green);
         gl.ActiveTexture(GL_TEXTURE0);
         square(gl, 0, 0);
     }},
    {"filled_first_under_pushed_attributes", [](auto& gl) { nearest(gl); },
     [](auto& gl) {
         begin_textured(gl);
         gl.PushAttrib(GL_TEXTURE_BIT);
         gl.BindTexture(GL_TEXTURE_2D, 4);
         gl.BindTexture(GL_TEXTURE_2D, 0);
         fill(gl, blue);
         gl.BindTexture(GL_TEXTURE_2D, 4);
         gl.PopAttrib();
         square(gl, 0, 0);
     }},
    {"filled_by_a_list",
     [](auto& gl) {
         nearest(gl);
         gl.NewList(1, GL_COMPILE);
         fill(gl, green);
         square(gl, -1, 0);
         gl.EndList();
     },
     [](auto& gl) {
         begin_textured(gl);
         fill(gl, red);
         square(gl, 0, 0);
         gl.CallList(1);
     }},
    {"mipmaps",
     [](auto& gl) {
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
         gl.TexImage2D(GL_TEXTURE_2D, 1, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, green.data());
         fill(gl, red);
     },
     [](auto& gl) {
         begin_textured(gl);
         gl.MatrixMode(GL_TEXTURE);
         gl.Scalef(30, 30, 1);
         square(gl, -1, -1);
         gl.GenerateMipmap(GL_TEXTURE_2D);
         square(gl, 0, -1);
     }},
    {"of_a_cube",
     [](auto& gl) {
         nearest(gl, GL_TEXTURE_CUBE_MAP);
         for (int face = 0; face < 6; ++face)
             fill(gl, face % 2 ? red : green, GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face));
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_CUBE_MAP);
         gl.Color3f(1, 1, 1);
         square(gl, -1, -1);
         fill(gl, blue, GL_TEXTURE_CUBE_MAP_POSITIVE_Z);
         square(gl, 0, 0);
     }},
    {"copied_from_the_frame", [](auto& gl) { nearest(gl); },
     [](auto& gl) {
         begin_scene(gl);
         gl.Color3f(1, 0.5f, 0);
         square(gl, -1, -1);
         gl.Color3f(1, 1, 1);
         gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 20, 20, 16, 16, 0);
         gl.Enable(GL_TEXTURE_2D);
         square(gl, 0, 0);
     }},
};

class DefaultTexture : public testing::TestWithParam<Case> {};
TEST_P(DefaultTexture, is_drawn_from) {
    Rig rig;
    expect_same_image(rig, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Textures, DefaultTexture, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

/// Mesa: a context that drew from a texture named 0 and is destroyed leaves a pointer to itself in it, which
/// the next upload follows (piglit's texture-packed-formats fell over with every second frame cast).
TEST(DefaultTextures, outlive_the_context_that_replays) {
    Rig rig;
    const GlTable& gl = rig.gl();
    nearest(gl);
    for (int i = 0; i < 20; ++i) {
        rig.begin();
        begin_textured(gl);
        fill(gl, i % 2 ? red : blue);
        square(gl, -1, -1);
        rig.end();
        {
            OsmesaContext replayer(Rig::size, Rig::size, &rig.program);
            replayer.make_current();
            record::replay(*rig.frame, replayer.gl());
            GLint bound = 0;
            replayer.gl().GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
            EXPECT_NE(bound, 0) << "the program's own was drawn from";
            ASSERT_TRUE(record::has_copies(*rig.frame));
            record::delete_copies(*rig.frame, replayer.gl());
        }
        rig.program.make_current();
    }
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST(DefaultTextures, keep_what_the_program_put_in) {
    Rig rig;
    const GlTable& gl = rig.gl();
    nearest(gl);
    fill(gl, red);
    rig.begin();
    begin_textured(gl);
    square(gl, -1, -1);
    rig.end();
    rig.program.make_current();
    fill(gl, green); // after the frame, and before it is played
    rig.replayed();
    rig.program.make_current();
    Texels now{};
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, now.data());
    EXPECT_EQ(now, green);
}

TEST(DefaultTextures, take_no_name_where_nothing_is_in_them) {
    Rig rig;
    rig.begin();
    begin_textured(rig.gl());
    square(rig.gl(), -1, -1);
    rig.end();
    rig.replayed();
    EXPECT_FALSE(record::has_copies(*rig.frame));
}

} // namespace
} // namespace glcast::test
