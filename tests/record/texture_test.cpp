// Textures that change or go while a frame draws from them: each draw has its own picture.
#include <array>

#include "tests/record/rig.h"
#include "tests/record/state_dump.h"

namespace glcast::test {
namespace {

using Texels = std::array<GLubyte, 16>;
constexpr Texels filled(GLubyte r, GLubyte g, GLubyte b) {
    Texels texels{};
    for (std::size_t i = 0; i < 4; ++i)
        texels[4 * i] = r, texels[4 * i + 1] = g, texels[4 * i + 2] = b, texels[4 * i + 3] = 255;
    return texels;
}
constexpr Texels red = filled(255, 0, 0), green = filled(0, 255, 0), blue = filled(0, 0, 255),
                 grey = filled(90, 91, 92);

void fill(const GlTable& gl, const Texels& texels, GLenum target = GL_TEXTURE_2D) {
    gl.TexImage2D(target, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
}

/// Names 1 and 2, red and green.
void two_textures(const GlTable& gl) {
    GLuint names[2];
    gl.GenTextures(2, names);
    for (int i = 1; i >= 0; --i) {
        gl.BindTexture(GL_TEXTURE_2D, names[i]);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        fill(gl, i ? green : red);
    }
}

/// In the corner that x and y say.
void square(const GlTable& gl, float x, float y) {
    gl.Begin(GL_QUADS);
    gl.TexCoord2f(0, 0), gl.Vertex2f(x, y), gl.TexCoord2f(1, 0), gl.Vertex2f(x + 1, y);
    gl.TexCoord2f(1, 1), gl.Vertex2f(x + 1, y + 1), gl.TexCoord2f(0, 1), gl.Vertex2f(x, y + 1);
    gl.End();
}

void begin_textured(const GlTable& gl) {
    begin_scene(gl);
    gl.Enable(GL_TEXTURE_2D);
    gl.Color3f(1, 1, 1);
}

const Case cases[] = {
    {"filled_twice", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         fill(gl, blue);
         square(gl, 0, -1);
         gl.TexSubImage2D(GL_TEXTURE_2D, 0, 1, 0, 1, 2, GL_RGBA, GL_UNSIGNED_BYTE, grey.data());
         square(gl, 0, 0);
     }},
    {"deleted", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         const GLuint name = 1;
         gl.DeleteTextures(1, &name);
         square(gl, 0, -1);
         gl.BindTexture(GL_TEXTURE_2D, 2);
         square(gl, 0, 0);
     }},
    {"deleted_and_made_again", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         const GLuint name = 1;
         gl.DeleteTextures(1, &name);
         gl.BindTexture(GL_TEXTURE_2D, 1);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
         fill(gl, blue);
         square(gl, 0, -1);
     }},
    {"made_and_deleted_in_the_frame", nullptr,
     [](auto& gl) {
         begin_textured(gl);
         two_textures(gl);
         square(gl, -1, -1);
         const GLuint names[] = {1, 2};
         gl.BindTexture(GL_TEXTURE_2D, 2);
         square(gl, 0, 0);
         gl.DeleteTextures(2, names);
     }},
    {"copied_from_the_frame", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 2, 2);
         square(gl, 0, -1);
         gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 24, 24, 4, 4, 0);
         square(gl, 0, 0);
     }},
    {"changed_while_another_is_bound_to_a_unit", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         gl.ActiveTexture(GL_TEXTURE1);
         gl.Enable(GL_TEXTURE_2D);
         gl.BindTexture(GL_TEXTURE_2D, 2);
         gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_ADD);
         square(gl, -1, -1);
         gl.ActiveTexture(GL_TEXTURE0);
         gl.BindTexture(GL_TEXTURE_2D, 2);
         fill(gl, blue);
         gl.BindTexture(GL_TEXTURE_2D, 1);
         square(gl, 0, -1);
     }},
    {"changed_under_pushed_attributes", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         gl.PushAttrib(GL_TEXTURE_BIT);
         fill(gl, blue);
         gl.BindTexture(GL_TEXTURE_2D, 2);
         square(gl, 0, -1);
         gl.PopAttrib();
         square(gl, 0, 0);
     }},
    {"bound_by_a_list",
     [](auto& gl) {
         two_textures(gl);
         gl.NewList(1, GL_COMPILE);
         gl.BindTexture(GL_TEXTURE_2D, 1);
         square(gl, -1, -1);
         gl.BindTexture(GL_TEXTURE_2D, 2);
         gl.EndList();
         gl.BindTexture(GL_TEXTURE_2D, 0);
     },
     [](auto& gl) {
         begin_textured(gl);
         gl.CallList(1);
         square(gl, 0, -1);
         gl.BindTexture(GL_TEXTURE_2D, 1);
         fill(gl, blue);
         square(gl, 0, 0);
     }},
    {"bound_by_a_list_and_deleted",
     [](auto& gl) {
         two_textures(gl);
         gl.NewList(1, GL_COMPILE);
         gl.BindTexture(GL_TEXTURE_2D, 2);
         square(gl, -1, -1);
         gl.EndList();
         gl.BindTexture(GL_TEXTURE_2D, 0);
     },
     [](auto& gl) {
         begin_textured(gl);
         gl.CallList(1);
         const GLuint name = 2;
         gl.DeleteTextures(1, &name);
         gl.BindTexture(GL_TEXTURE_2D, 1);
         square(gl, 0, 0);
     }},
    {"with_pixel_transfer_and_packing", two_textures,
     [](auto& gl) {
         begin_textured(gl);
         square(gl, -1, -1);
         gl.PixelTransferf(GL_GREEN_BIAS, 0.5f);
         gl.PixelStorei(GL_PACK_SKIP_PIXELS, 3);
         gl.PixelStorei(GL_PACK_SWAP_BYTES, 1);
         fill(gl, blue);
         square(gl, 0, -1);
         gl.PixelStorei(GL_PACK_SKIP_PIXELS, 0); // for the rig's own reading
         gl.PixelStorei(GL_PACK_SWAP_BYTES, 0);
     }},
    {"mipmaps_made_anew", two_textures,
     [](auto& gl) {
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
         gl.TexImage2D(GL_TEXTURE_2D, 1, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, green.data());
         begin_textured(gl);
         gl.MatrixMode(GL_TEXTURE);
         gl.Scalef(30, 30, 1);
         square(gl, -1, -1);
         gl.GenerateMipmap(GL_TEXTURE_2D);
         square(gl, 0, -1);
     }},
    {"of_a_cube",
     [](auto& gl) {
         gl.BindTexture(GL_TEXTURE_CUBE_MAP, 7);
         gl.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
         for (int face = 0; face < 6; ++face)
             fill(gl, face % 2 ? red : green, GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face));
     },
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_TEXTURE_CUBE_MAP);
         gl.Color3f(1, 1, 1);
         gl.TexCoord3f(1, 0, 0);
         gl.Rectf(-1, -1, 0, 0);
         fill(gl, blue, GL_TEXTURE_CUBE_MAP_POSITIVE_X);
         gl.TexCoord3f(1, 0, 0);
         gl.Rectf(0, 0, 1, 1);
         gl.TexCoord3f(0, 1, 0);
         gl.Rectf(0, -1, 1, 0);
     }},
};

class ChangedTexture : public testing::TestWithParam<Case> {};
TEST_P(ChangedTexture, has_its_own_picture_in_each_draw) {
    Rig rig;
    expect_same_image(rig, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Textures, ChangedTexture, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

TEST(ChangedTextures, are_copied_only_after_they_may_have_been_drawn_from) {
    Rig rig;
    const GlTable& gl = rig.gl();
    two_textures(gl);
    rig.begin();
    fill(gl, blue); // a film's next picture
    begin_textured(gl);
    square(gl, 0, 0);
    gl.BindTexture(GL_TEXTURE_2D, 9); // loaded late
    fill(gl, grey);
    fill(gl, grey);
    square(gl, 0, -1);
    rig.end();
    rig.replayed();
    EXPECT_FALSE(record::has_copies(*rig.frame));
}

TEST(ChangedTextures, leave_the_program_s_state_and_objects_alone) {
    Rig rig;
    const GlTable& gl = rig.gl();
    two_textures(gl);
    rig.begin();
    begin_textured(gl);
    square(gl, -1, -1);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 2);
    gl.PixelTransferf(GL_RED_SCALE, 0.5f);
    gl.BindTexture(GL_TEXTURE_2D, 2);
    const State before = dump_state(rig.program.gl(), true);
    const GLuint name = 1;
    gl.DeleteTextures(1, &name);
    EXPECT_EQ(difference(before, dump_state(rig.program.gl(), true)), "");
    rig.end();
    rig.replayed();
    ASSERT_TRUE(record::has_copies(*rig.frame));
    EXPECT_FALSE(rig.replayer.gl().IsTexture(1));
    EXPECT_TRUE(rig.replayer.gl().IsTexture(3)) << "the copy";
    record::delete_copies(*rig.frame, rig.replayer.gl());
    EXPECT_FALSE(rig.replayer.gl().IsTexture(3));
    EXPECT_EQ(rig.replayer.gl().GetError(), GLenum(GL_NO_ERROR));
}

TEST(ChangedTextures, too_large_for_the_limit_are_counted) {
    Rig rig;
    const GlTable& gl = rig.gl();
    two_textures(gl);
    const std::vector<GLubyte> large(512 * 512 * 4, 77);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 512, 512, 0, GL_RGBA, GL_UNSIGNED_BYTE, large.data());
    record::set_memory_limit(1 << 20);
    rig.begin();
    begin_textured(gl);
    square(gl, -1, -1);
    fill(gl, blue);
    square(gl, 0, 0);
    rig.end();
    record::set_memory_limit(SIZE_MAX);
    EXPECT_EQ(record::not_understood(*rig.frame)
                  .count("a texture changed after it was drawn from, and too large to copy"),
              1u);
    EXPECT_GT(Rig::covered(rig.replayed()), 20u);
}

TEST(ChangedTextures, of_integers_are_left_without_an_error) {
    Rig rig;
    const GlTable& gl = rig.gl();
    two_textures(gl);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8UI, 2, 2, 0, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, red.data());
    ASSERT_EQ(rig.program.gl().GetError(), GLenum(GL_NO_ERROR));
    rig.begin();
    begin_textured(gl);
    square(gl, -1, -1);
    fill(gl, blue);
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
    rig.end();
}

} // namespace
} // namespace glcast::test
