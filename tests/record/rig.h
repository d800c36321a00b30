// Two contexts that share objects: one records, the other replays; images are compared to the bit.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "shim/record/record.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {

struct Picture {
    std::vector<std::uint8_t> colour;
    std::vector<GLuint> depth;
    bool operator==(const Picture&) const = default;
};

/// How two pictures differ: pixels whose colour differs by more than `colour` of 255, or depth by more than
/// `depth` of 2^32. Mesa turns the quads and strips of a list into triangles of its own, and so interpolates
/// the last bits of depth differently.
inline std::size_t different_pixels(const Picture& a, const Picture& b, int colour, GLuint depth) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        bool differs = (a.depth[i] > b.depth[i] ? a.depth[i] - b.depth[i] : b.depth[i] - a.depth[i]) > depth;
        for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
            differs |= std::abs(a.colour[k] - b.colour[k]) > colour;
        n += differs;
    }
    return n;
}
inline constexpr GLuint last_bits_of_depth = 4 * 256; // of 24

class Rig {
  public:
    static constexpr int size = 64;

    Rig() : program(size, size), replayer(size, size, &program) {
        program.make_current();
        context = record::make_context(program.gl(), nullptr);
        record::set_current(context.get(), program.gl());
    }
    ~Rig() { record::set_current(nullptr, program.gl()); }

    /// The calls of the program go here.
    const GlTable& gl() const { return record::table(); }

    void begin() {
        program.make_current();
        record::set_current(context.get(), program.gl());
        ASSERT_EQ(record::busy(*context), nullptr);
        record::begin_frame(*context);
    }
    void end() {
        std::string why;
        frame = record::end_frame(*context, &why);
        ASSERT_TRUE(frame) << why;
    }
    Picture direct() { return read(program); }
    Picture replayed() {
        replayer.make_current();
        record::replay(*frame, replayer.gl());
        return read(replayer);
    }

    /// How many pixels are not the background: a test that draws nothing tests nothing.
    static std::size_t covered(const Picture& picture) {
        std::size_t n = 0;
        for (std::size_t i = 0; i < picture.colour.size(); i += 4)
            n += std::memcmp(&picture.colour[i], &picture.colour[0], 4) != 0;
        return n;
    }

    OsmesaContext program, replayer;
    std::shared_ptr<record::Context> context;
    std::shared_ptr<const record::Frame> frame;

  private:
    static Picture read(OsmesaContext& context) {
        Picture picture;
        context.make_current();
        const GlTable& gl = context.gl();
        const auto pixels = std::size_t(size) * size;
        picture.colour.resize(pixels * 4);
        picture.depth.resize(pixels);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
        gl.ReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, picture.colour.data());
        gl.ReadPixels(0, 0, size, size, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, picture.depth.data());
        return picture;
    }
};

using Calls = std::function<void(const GlTable& gl)>;

/// One way of drawing: what happens before the frame, and in it.
struct Case {
    std::string name;
    Calls setup, frame;
};
inline void PrintTo(const Case& test_case, std::ostream* out) { *out << test_case.name; }

/// Records `frame` after `setup`, replays it twice, and wants the direct image both times.
inline void expect_same_image(Rig& rig, const Case& test_case) {
    if (test_case.setup) test_case.setup(rig.gl());
    rig.begin();
    test_case.frame(rig.gl());
    rig.end();
    const Picture direct = rig.direct();
    EXPECT_GT(Rig::covered(direct), 20u) << "the case draws nothing";
    for (int i = 0; i < 2; ++i) {
        const Picture replayed = rig.replayed();
        EXPECT_TRUE(replayed == direct) << "replay " << i;
    }
    for (const auto& [what, times] : record::not_understood(*rig.frame))
        ADD_FAILURE() << what << " " << times;
    rig.program.make_current();
    EXPECT_EQ(rig.program.gl().GetError(), GLenum(GL_NO_ERROR));
}

/// A frame's beginning that most cases share: clears, a camera, a light, the depth test.
inline void begin_scene(const GlTable& gl) {
    gl.ClearColor(0.1f, 0.2f, 0.3f, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_DEPTH_TEST);
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadIdentity();
    gl.Frustum(-1, 1, -1, 1, 2, 20);
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadIdentity();
    gl.Translatef(0, 0, -5);
    const GLfloat position[] = {1, 2, 3, 0};
    gl.Lightfv(GL_LIGHT0, GL_POSITION, position);
    gl.Enable(GL_LIGHT0);
}

inline void triangle(const GlTable& gl, float x = 0, float y = 0, float z = 0, float s = 1) {
    gl.Begin(GL_TRIANGLES);
    gl.Color3f(1, 0, 0), gl.Vertex3f(x - s, y - s, z);
    gl.Color3ub(0, 255, 0), gl.Vertex3f(x + s, y - s, z + 0.5f);
    gl.Color4d(0, 0, 1, 1), gl.Vertex3f(x, y + s, z - 0.5f);
    gl.End();
}

} // namespace glcast::test
