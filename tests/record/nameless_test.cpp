// Objects that another context has deleted while they are bound live on without a name: the recorder must
// neither lose them nor bind what has their name now.
#include <array>

#include "tests/record/rig.h"

namespace glcast::test {
namespace {

using Texels = std::array<GLubyte, 16>;
constexpr Texels striped{255, 0, 0, 255, 0, 255, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255};
constexpr Texels blue{0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 99, 255};

void fill(const GlTable& gl, const Texels& texels) {
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
}

Texels texels_of(const GlTable& gl) {
    Texels texels{};
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    return texels;
}

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

class Nameless : public testing::Test {
  protected:
    Rig rig;
    OsmesaContext other{Rig::size, Rig::size, &rig.program};
    const GlTable& gl = rig.gl();

    void SetUp() override { rig.program.make_current(); }

    GLuint bound_texture() {
        GLuint name = 0;
        gl.GenTextures(1, &name);
        gl.BindTexture(GL_TEXTURE_2D, name);
        fill(gl, striped);
        return name;
    }
    GLuint bound_buffer(GLenum target, const std::array<float, 8>& values) {
        GLuint name = 0;
        gl.GenBuffers(1, &name);
        gl.BindBuffer(target, name);
        gl.BufferData(target, sizeof values, values.data(), GL_STATIC_DRAW);
        return name;
    }
    template <class Delete> void elsewhere(Delete&& remove) {
        other.make_current();
        remove(other.gl());
        rig.program.make_current();
    }
    void expect_the_same_picture() {
        const Picture direct = rig.direct();
        EXPECT_GT(Rig::covered(direct), 20u);
        for (int i = 0; i < 2; ++i) EXPECT_TRUE(rig.replayed() == direct) << "replay " << i;
        for (const auto& [what, times] : record::not_understood(*rig.frame)) ADD_FAILURE() << what << times;
        rig.program.make_current();
        EXPECT_EQ(rig.program.gl().GetError(), GLenum(GL_NO_ERROR));
    }
};

TEST_F(Nameless, texture_stays_bound_and_is_drawn_from) {
    fill(gl, blue); // the one named 0
    const GLuint name = bound_texture();
    elsewhere([&](const GlTable& of) { of.DeleteTextures(1, &name); });
    for (int frame = 0; frame < 2; ++frame) {
        rig.begin();
        begin_textured(gl);
        square(gl, -1, -1);
        EXPECT_EQ(texels_of(gl), striped);
        rig.end();
        EXPECT_FALSE(gl.IsTexture(name));
        expect_the_same_picture();
    }
}

TEST_F(Nameless, texture_is_not_mistaken_for_one_that_got_its_name) {
    const GLuint name = bound_texture();
    elsewhere([&](const GlTable& of) { of.DeleteTextures(1, &name); });
    rig.begin();
    begin_textured(gl);
    square(gl, -1, -1);
    gl.BindTexture(GL_TEXTURE_2D, name); // a new one
    fill(gl, blue);
    square(gl, 0, 0);
    rig.end();
    expect_the_same_picture();
}

TEST_F(Nameless, texture_stays_bound_while_another_is_copied) {
    const GLuint lives = bound_texture(), name = bound_texture();
    rig.begin();
    begin_textured(gl);
    gl.BindTexture(GL_TEXTURE_2D, lives);
    square(gl, 0, 0);
    gl.BindTexture(GL_TEXTURE_2D, name);
    elsewhere([&](const GlTable& of) { of.DeleteTextures(1, &name); });
    gl.DeleteTextures(1, &lives); // copied first
    EXPECT_EQ(texels_of(gl), striped);
    rig.end();
}

TEST_F(Nameless, buffers_stay_bound) {
    const std::array<float, 8> corners{-1, -1, 0, -1, 0, 0, -1, 0}, others{1, 2, 3, 4, 5, 6, 7, 8};
    const GLuint drawn = bound_buffer(GL_ARRAY_BUFFER, corners);
    gl.VertexPointer(2, GL_FLOAT, 0, nullptr);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    const GLuint gone = bound_buffer(GL_ARRAY_BUFFER, others),
                 packed = bound_buffer(GL_PIXEL_PACK_BUFFER, others);
    EXPECT_NE(drawn, gone);
    elsewhere([&](const GlTable& of) { of.DeleteBuffers(1, &gone), of.DeleteBuffers(1, &packed); });
    rig.begin();
    begin_scene(gl);
    gl.Color3f(1, 1, 0);
    gl.DrawArrays(GL_QUADS, 0, 4);
    for (const GLenum target : {GL_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER}) {
        std::array<float, 8> now{};
        gl.GetBufferSubData(target, 0, sizeof now, now.data());
        EXPECT_EQ(now, others);
    }
    rig.end();
    EXPECT_FALSE(gl.IsBuffer(gone));
    EXPECT_FALSE(gl.IsBuffer(packed));
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    expect_the_same_picture();
}

} // namespace
} // namespace glcast::test
