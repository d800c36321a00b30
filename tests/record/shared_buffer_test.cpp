// Buffers that another context of the share group changes while a frame is recorded, whether that context
// records or not.
#include "tests/record/rig.h"

namespace glcast::test {
namespace {

constexpr GLfloat corners[] = {-1, -1, 0, 0, -1, 0, 0, 0, 0}, elsewhere[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};

GLuint make_buffer(const GlTable& gl, const GLfloat (&data)[9]) {
    GLuint name = 0;
    gl.GenBuffers(1, &name);
    gl.BindBuffer(GL_ARRAY_BUFFER, name);
    gl.BufferData(GL_ARRAY_BUFFER, sizeof data, data, GL_STATIC_DRAW);
    return name;
}

/// Draws a buffer, has another context `change` it, and draws it again.
void expect_both_triangles(const std::function<void(const GlTable& gl, GLuint name)>& change) {
    Rig rig;
    OsmesaContext other(8, 8, &rig.program);
    const auto other_shadow = record::make_context(other.gl(), rig.context);
    rig.program.make_current();
    const GLuint name = make_buffer(rig.gl(), corners);
    rig.gl().VertexPointer(3, GL_FLOAT, 0, nullptr);
    rig.gl().EnableClientState(GL_VERTEX_ARRAY);
    rig.begin();
    begin_scene(rig.gl());
    rig.gl().DrawArrays(GL_TRIANGLES, 0, 3);
    rig.gl().Finish();
    const std::size_t one = Rig::covered(rig.direct());
    other.make_current();
    record::set_current(other_shadow.get(), other.gl());
    change(rig.gl(), name);
    rig.gl().Finish();
    rig.program.make_current();
    record::set_current(rig.context.get(), rig.program.gl());
    rig.gl().BindBuffer(GL_ARRAY_BUFFER, name);
    rig.gl().VertexPointer(3, GL_FLOAT, 0, nullptr);
    rig.gl().DrawArrays(GL_TRIANGLES, 0, 3);
    rig.end();
    const Picture direct = rig.direct();
    EXPECT_GT(one, 20u);
    EXPECT_GT(Rig::covered(direct), one + 20);
    EXPECT_TRUE(rig.replayed() == direct);
}

TEST(SharedBuffers, filled_again_by_a_context_that_records_nothing) {
    expect_both_triangles([](auto& gl, GLuint name) {
        gl.BindBuffer(GL_ARRAY_BUFFER, name);
        gl.BufferSubData(GL_ARRAY_BUFFER, 0, sizeof elsewhere, elsewhere);
    });
}

TEST(SharedBuffers, mapped_by_a_context_that_records_nothing) {
    expect_both_triangles([](auto& gl, GLuint name) {
        gl.BindBuffer(GL_ARRAY_BUFFER, name);
        std::memcpy(gl.MapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY), elsewhere, sizeof elsewhere);
        gl.UnmapBuffer(GL_ARRAY_BUFFER);
    });
}

TEST(SharedBuffers, changed_by_name_by_a_context_that_records_nothing) {
    expect_both_triangles(
        [](auto& gl, GLuint name) { gl.NamedBufferSubData(name, 0, sizeof elsewhere, elsewhere); });
}

TEST(SharedBuffers, deleted_and_made_anew_by_a_context_that_records_nothing) {
    expect_both_triangles([](auto& gl, GLuint name) {
        gl.DeleteBuffers(1, &name);
        gl.BindBuffer(GL_ARRAY_BUFFER, name);
        gl.BufferData(GL_ARRAY_BUFFER, sizeof elsewhere, elsewhere, GL_STATIC_DRAW);
    });
}

} // namespace
} // namespace glcast::test
