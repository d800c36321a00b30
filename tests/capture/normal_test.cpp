// Normals: which way they point, in which frame, and of which surface they are.
#include <gtest/gtest.h>

#include "capture/forced_table.h"
#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

constexpr int n = 16;
const Box unit_box{glm::dvec3(-1), 2};

class Normals : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();
    EngineOptions options = small_options(n);

    void SetUp() override { options.box = unit_box; }

    static glm::dvec3 middle_normal(const Cast& cast, Axis axis, Side side) {
        const glm::vec4 normal = cast.view(axis, side).normal[pixel_of(unit_box, n, axis, glm::dvec3(0.01))];
        EXPECT_EQ(normal.w, 1);
        return glm::dvec3(normal);
    }
};

struct SheetStyle {
    bool two_sided = true;
    GLenum front = GL_CCW;
    bool clockwise = false;
};

glm::dvec3 unit(Axis axis) {
    glm::dvec3 e(0);
    e[static_cast<int>(axis)] = 1;
    return e;
}

/// A square through the origin across an axis, normal along it, counter-clockwise as seen from where the
/// normal points.
DrawFunction sheet(Axis axis, SheetStyle style) {
    return [=](const GlTable& gl) {
        set_lit(gl);
        gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, style.two_sided);
        gl.FrontFace(style.front);
        const int a = (static_cast<int>(axis) + 1) % 3, b = (a + 1) % 3;
        const glm::dvec3 normal = unit(axis);
        gl.Begin(GL_QUADS);
        gl.Normal3d(normal.x, normal.y, normal.z);
        for (int corner = 0; corner < 4; ++corner) {
            const int turn = style.clockwise ? 3 - corner : corner;
            glm::dvec3 p(0);
            p[a] = turn == 1 || turn == 2 ? 0.5 : -0.5;
            p[b] = turn >= 2 ? 0.5 : -0.5;
            gl.Vertex3d(p.x, p.y, p.z);
        }
        gl.End();
    };
}

TEST_F(Normals, TwoSidedLightingTurnsThemToTheViewer) {
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        for (bool clockwise : {false, true}) {
            SCOPED_TRACE(testing::Message() << "axis " << int(axis) << " clockwise " << clockwise);
            const SheetStyle style{true, GLenum(clockwise ? GL_CW : GL_CCW), clockwise};
            const Cast cast = capture(gl, sheet(axis, style), options);
            EXPECT_LT(glm::distance(middle_normal(cast, axis, Side::plus), unit(axis)), 1e-6);
            EXPECT_LT(glm::distance(middle_normal(cast, axis, Side::minus), -unit(axis)), 1e-6);
        }
    }
}

TEST_F(Normals, OneSidedLightingLeavesThemAsDrawn) {
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        const Cast cast = capture(gl, sheet(axis, {false, GL_CCW, false}), options);
        for (Side side : {Side::plus, Side::minus})
            EXPECT_LT(glm::distance(middle_normal(cast, axis, side), unit(axis)), 1e-6);
    }
}

TEST_F(Normals, WrongWindingGivesWrongNormalsAsItDoesOnScreen) {
    const Cast cast = capture(gl, sheet(Axis::z, {true, GL_CCW, true}), options);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::z, Side::plus), -unit(Axis::z)), 1e-6);
}

TEST_F(Normals, MirroringProjectionReversesWinding) {
    options.mirrored_projection = true;
    const Cast cast = capture(gl, sheet(Axis::y, {true, GL_CW, false}), options);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::y, Side::plus), unit(Axis::y)), 1e-6);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::y, Side::minus), -unit(Axis::y)), 1e-6);
}

TEST_F(Normals, ReflectedCaptureFrameKeepsTheFrontInFront) {
    options.eye_to_capture = glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    const Cast cast = capture(gl, sheet(Axis::x, {}), options);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::x, Side::minus), -unit(Axis::x)), 1e-6);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::x, Side::plus), unit(Axis::x)), 1e-6);
}

TEST_F(Normals, AreInTheCaptureFrame) {
    const double s = std::sqrt(0.5); // an eighth of a turn about z, and twice as large
    options.eye_to_capture = glm::dmat4(2 * s, 2 * s, 0, 0, -2 * s, 2 * s, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1);
    const auto brick = [](const GlTable& gl) {
        set_lit(gl);
        draw_box(gl, glm::dvec3(-0.25), glm::dvec3(0.25));
    };
    const Cast cast = capture(gl, brick, options);
    const ViewImage& image = cast.view(Axis::x, Side::plus);
    const glm::vec4 right = image.normal[pixel_of(unit_box, n, Axis::x, {0, 0.3, 0})];
    const glm::vec4 left = image.normal[pixel_of(unit_box, n, Axis::x, {0, -0.3, 0})];
    EXPECT_LT(glm::distance(glm::dvec3(right), glm::dvec3(s, s, 0)), 1e-6); // the eye's +x face
    EXPECT_LT(glm::distance(glm::dvec3(left), glm::dvec3(s, -s, 0)), 1e-6); // the eye's -y face
}

TEST_F(Normals, KeepTheirLength) {
    const Cast cast = capture(
        gl,
        [](const GlTable& table) {
            set_lit(table);
            table.Disable(GL_NORMALIZE);
            table.Begin(GL_QUADS);
            table.Normal3f(0, 0.5f, 1.5f);
            table.Vertex2f(-0.5f, -0.5f), table.Vertex2f(0.5f, -0.5f);
            table.Vertex2f(0.5f, 0.5f), table.Vertex2f(-0.5f, 0.5f);
            table.End();
        },
        options);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::z, Side::plus), glm::dvec3(0, 0.5, 1.5)), 1e-5);
}

/// Two squares in one plane: the one drawn first is what GL_LESS shows.
TEST_F(Normals, OfCoincidentSurfacesTheFirstDrawnCounts) {
    const auto draw = [](const GlTable& gl) {
        set_lit(gl);
        for (int i = 0; i < 2; ++i) {
            set_diffuse(gl, i == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
            gl.Begin(GL_QUADS);
            gl.Normal3d(i, 0, 1 - i);
            gl.Vertex2f(-0.5f, -0.5f), gl.Vertex2f(0.5f, -0.5f), gl.Vertex2f(0.5f, 0.5f),
                gl.Vertex2f(-0.5f, 0.5f);
            gl.End();
        }
    };
    const Cast cast = capture(gl, draw, options);
    const std::size_t middle = pixel_of(unit_box, n, Axis::z, glm::dvec3(0.01));
    for (Side side : {Side::minus, Side::plus}) {
        EXPECT_EQ(glm::vec3(cast.view(Axis::z, side).colour[middle]), glm::vec3(1, 0, 0));
        EXPECT_LT(glm::distance(middle_normal(cast, Axis::z, side), glm::dvec3(0, 0, 1)), 1e-6);
    }
}

TEST_F(Normals, OfNestedBodiesTheOuterIsSeen) {
    const auto draw = [](const GlTable& gl) {
        set_lit(gl);
        set_diffuse(gl, {1, 0, 0});
        draw_box(gl, glm::dvec3(-0.3), glm::dvec3(0.3));
        set_diffuse(gl, {0, 1, 0});
        draw_sphere(gl, glm::dvec3(0), 0.9);
        set_diffuse(gl, {0, 0, 1});
        draw_sphere(gl, glm::dvec3(0.1), 0.5);
    };
    const Cast cast = capture(gl, draw, options);
    for (const ViewImage& image : cast.images) {
        const std::size_t middle = pixel_of(unit_box, n, image.view.axis, glm::dvec3(0.01));
        EXPECT_EQ(glm::vec3(image.colour[middle]), glm::vec3(0, 1, 0));
        const double towards = image.view.side == Side::plus ? 1 : -1;
        EXPECT_LT(angle_between(glm::dvec3(image.normal[middle]), towards * unit(image.view.axis)), 8);
    }
}

/// A scene that lies elsewhere in its normal passes, as one with a moving part does.
DrawFunction moving_box(double samples) {
    return [=](const GlTable& gl) {
        set_lit(gl);
        const double by = ForcedTable::current().kind == PassKind::normal ? samples * unit_box.size / n : 0;
        draw_box(gl, glm::dvec3(-0.53 + by), glm::dvec3(0.53 + by));
    };
}

TEST_F(Normals, AreFoundAgainWhenTheSceneMovesByLittle) {
    const Cast cast = capture(gl, moving_box(0.1), options);
    EXPECT_EQ(cast.report.pixels_without_normal, 0);
    EXPECT_EQ(cast.report.draws, 6 * 3);
    EXPECT_LT(glm::distance(middle_normal(cast, Axis::x, Side::minus), -unit(Axis::x)), 1e-6);
}

TEST_F(Normals, AreNotTakenFromElsewhere) {
    const Cast cast = capture(gl, moving_box(2), options);
    long covered = 0;
    for (const ViewImage& image : cast.images)
        for (std::size_t i = 0; i < image.depth.size(); ++i) covered += image.covered(i);
    EXPECT_GT(covered, 6 * 40);
    EXPECT_EQ(cast.report.pixels_without_normal, covered);
}

TEST_F(Normals, BothSidesShareTheirRays) {
    options.n = 64;
    const auto draw = [](const GlTable& gl) {
        set_lit(gl);
        gl.Rotated(33, 1, 2, 3);
        draw_sphere(gl, glm::dvec3(0.05), 0.7);
    };
    const Cast cast = capture(gl, draw, options);
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        const ViewImage &minus = cast.view(axis, Side::minus), &plus = cast.view(axis, Side::plus);
        for (std::size_t i = 0; i < minus.depth.size(); ++i) {
            EXPECT_EQ(minus.covered(i), plus.covered(i));
            if (minus.covered(i)) {
                EXPECT_LE(minus.depth[i], plus.depth[i]);
            } else {
                EXPECT_EQ(minus.depth[i], 1);
                EXPECT_EQ(plus.depth[i], 0);
                EXPECT_EQ(minus.colour[i], glm::vec4(0));
                EXPECT_EQ(minus.normal[i], glm::vec4(0));
            }
        }
    }
}

} // namespace
} // namespace glcast::test
