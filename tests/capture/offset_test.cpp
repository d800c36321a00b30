// Surfaces that lie in one another, told apart by polygon offset or depth range: what is nearest by the
// program's own offsets is seen, from all sides and behind them. A turned box with a disc on each face, which
// has none of the face's vertices, so that depths differ by rounding: each pixel's colour is known in closed
// form.
#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

constexpr double one_step = 1.0 / 255;
constexpr int n = 96;
const Box unit_box{glm::dvec3(-1), 2};
const glm::vec3 base(0.5f, 0.25f, 0.75f), paint(0.2f, 0.6f, 0.4f), mark(1, 1, 0);
const glm::dvec3 half(0.5, 0.4, 0.35);
constexpr double radius = 0.25, inner_radius = 0.12;

const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));

void body(const GlTable& gl, glm::vec3 colour) {
    gl.Color3f(colour.r, colour.g, colour.b);
    draw_box(gl, -half, half);
}

void discs(const GlTable& gl, glm::vec3 colour, float alpha = 1, double r = radius) {
    constexpr int corners = 37;
    gl.Color4f(colour.r, colour.g, colour.b, alpha);
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
        gl.Begin(GL_TRIANGLE_FAN);
        for (int i = -1; i <= corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners, at = i < 0 ? 0 : r;
            glm::dvec3 p;
            p[axis] = face % 2 ? half[axis] : -half[axis];
            p[a] = at * std::cos(angle), p[b] = at * std::sin(angle);
            gl.Vertex3d(p.x, p.y, p.z);
        }
        gl.End();
    }
}

void offset(const GlTable& gl, float factor, float units) {
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(factor, units);
}

void blend(const GlTable& gl, GLenum source, GLenum destination) {
    gl.Enable(GL_BLEND);
    gl.BlendFunc(source, destination);
}

struct Case {
    const char* name;
    void (*draw)(const GlTable& gl);
    glm::vec3 disc;              ///< the colour of the disc
    glm::vec3 inner = disc;      ///< of its inner part
    bool in_inner_layers = true; ///< as on the outside
};

const Case cases[] = {
    {"decals pulled forward, only nearer ones pass",
     [](const GlTable& gl) {
         body(gl, base);
         offset(gl, -1, -1);
         discs(gl, paint);
     },
     paint},
    {"by units alone, equal ones pass",
     [](const GlTable& gl) {
         gl.DepthFunc(GL_LEQUAL);
         body(gl, base);
         offset(gl, 0, -10);
         discs(gl, paint);
     },
     paint},
    {"the decals first",
     [](const GlTable& gl) {
         offset(gl, -1, -1);
         discs(gl, paint);
         gl.Disable(GL_POLYGON_OFFSET_FILL);
         body(gl, base);
     },
     paint},
    {"the body pushed back",
     [](const GlTable& gl) {
         offset(gl, 1, 1);
         body(gl, base);
         gl.Disable(GL_POLYGON_OFFSET_FILL);
         discs(gl, paint);
     },
     paint},
    {"the body pushed back, marks pulled forward over decals",
     [](const GlTable& gl) {
         offset(gl, -2, -2);
         discs(gl, mark, 1, inner_radius);
         offset(gl, 1, 1);
         body(gl, base);
         gl.Disable(GL_POLYGON_OFFSET_FILL);
         discs(gl, paint);
     },
     paint, mark},
    {"decals pushed behind the body are not seen",
     [](const GlTable& gl) {
         body(gl, base);
         gl.DepthFunc(GL_LEQUAL);
         offset(gl, 1, 1);
         discs(gl, paint);
     },
     base},
    {"greater depth is nearer",
     [](const GlTable& gl) {
         gl.DepthFunc(GL_GREATER);
         body(gl, base);
         offset(gl, 1, 1);
         discs(gl, paint);
     },
     paint},
    {"by a trimmed depth range",
     [](const GlTable& gl) {
         gl.DepthRange(0.001, 1);
         body(gl, base);
         gl.DepthRange(0, 0.999);
         discs(gl, paint);
     },
     paint},
    {"set and enabled on the attribute stack",
     [](const GlTable& gl) {
         body(gl, base);
         offset(gl, -1, -1);
         gl.PushAttrib(GL_POLYGON_BIT);
         offset(gl, 3, 3);
         gl.PopAttrib();
         discs(gl, paint);
         gl.PushAttrib(GL_ENABLE_BIT);
         gl.Disable(GL_POLYGON_OFFSET_FILL);
         gl.PopAttrib();
         gl.PolygonOffset(-4, -4);
         discs(gl, mark, 1, inner_radius);
     },
     paint, mark},
    {"with the projection as current matrix",
     [](const GlTable& gl) {
         gl.MatrixMode(GL_PROJECTION);
         gl.PushMatrix();
         body(gl, base);
         offset(gl, -1, -1);
         gl.Rotated(90, 1, 0, 0); // not for us
         discs(gl, paint);
         gl.PopMatrix();
         gl.MatrixMode(GL_MODELVIEW);
     },
     paint},
    {"blended",
     [](const GlTable& gl) {
         body(gl, base);
         offset(gl, -1, -1);
         blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
         discs(gl, paint, 0.75f);
     },
     glm::mix(base, paint, 0.75f), glm::mix(base, paint, 0.75f), false},
    {"blended, hardly there",
     [](const GlTable& gl) {
         body(gl, base);
         offset(gl, -1, -1);
         blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
         gl.DepthMask(GL_FALSE);
         discs(gl, paint, 0.25f);
         gl.DepthMask(GL_TRUE);
     },
     glm::mix(base, paint, 0.25f), glm::mix(base, paint, 0.25f), false},
    {"a light map and an opaque mark on it",
     [](const GlTable& gl) {
         offset(gl, 1, 1);
         body(gl, base);
         gl.Disable(GL_POLYGON_OFFSET_FILL);
         blend(gl, GL_DST_COLOR, GL_ZERO);
         discs(gl, paint);
         gl.Disable(GL_BLEND);
         offset(gl, -1, -1);
         discs(gl, mark, 1, inner_radius);
     },
     base* paint, mark, false},
};

/// A step is 1/128 sample, and as much for each sample that the face rises; two steps at most here.
constexpr double furthest_allowed = 2 * std::numbers::sqrt2 / 128 + 0.001;

class Offset : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();

    static DrawFunction scene(void (*draw)(const GlTable& gl)) {
        return [draw](const GlTable& table) {
            table.Enable(GL_DEPTH_TEST);
            table.PushAttrib(GL_ALL_ATTRIB_BITS);
            table.PushMatrix();
            table.MultMatrixd(glm::value_ptr(turned));
            draw(table);
            table.PopMatrix();
            table.PopAttrib();
        };
    }
    Cast cast_of(const DrawFunction& draw, int layers = 1, LayerMethod method = LayerMethod::peel) {
        EngineOptions options = small_options(n);
        options.box = unit_box;
        options.most_layers = layers;
        options.layer_method = method;
        return capture(gl, draw, options);
    }

    struct Found {
        int pixels = 0, wrong = 0;
        double furthest = 0; ///< from the box' surface, in samples
    };
    /// Of the pixels that show the box, but for those at an outline of anything.
    static Found judge(const ViewImage& image, const Case& c) {
        Found found;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const std::size_t pixel = std::size_t(j) * n + i;
                if (!image.covered(pixel)) continue;
                const glm::dvec3 seen = lattice_point(unit_box, n, image.view.axis, i, j, image.depth[pixel]);
                const glm::dvec3 p(glm::inverse(turned) * glm::dvec4(seen, 1));
                if (glm::any(glm::greaterThan(glm::abs(p), half + 0.02))) continue; // the shell
                const std::optional<glm::vec3> expected = expected_at(p, c);
                if (!expected) continue;
                ++found.pixels;
                found.wrong += glm::distance(glm::vec3(image.colour[pixel]), *expected) > one_step;
                const glm::dvec3 off = glm::abs(glm::abs(p) - half);
                found.furthest = std::max(found.furthest, std::min({off.x, off.y, off.z}) * n / 2);
            }
        }
        return found;
    }
    void expect_in_inner_layers(const Case& c, LayerMethod method) {
        SCOPED_TRACE(std::string(c.name) + (method == LayerMethod::peel ? ", peeled" : ", slabs"));
        const auto shelled = [&](const GlTable& table) {
            scene(c.draw)(table);
            table.Color4f(1, 1, 1, 1);
            draw_box(table, glm::dvec3(-0.9), glm::dvec3(0.9));
        };
        const Cast cast = cast_of(shelled, 32, method);
        ASSERT_TRUE(cast.report.ok) << cast.report.error;
        EXPECT_EQ(cast.report.layers, Layers::complete);
        for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
            EXPECT_EQ(cast.report.layer_count[int(axis)], 3);
            for (const int layer : {1, 2}) {
                const ViewImage* image = cast.find({axis, Side::minus, layer});
                ASSERT_NE(image, nullptr);
                const Found found = judge(*image, c);
                EXPECT_GT(found.pixels, 1000);
                EXPECT_TRUE(found.wrong == 0 || method == LayerMethod::slab) << found.wrong;
                EXPECT_LT(found.furthest, furthest_allowed);
            }
        }
    }
    static std::optional<glm::vec3> expected_at(const glm::dvec3& p, const Case& c) {
        constexpr double margin = 0.03;
        const glm::dvec3 inside = half - glm::abs(p);
        const int axis = inside.x < inside.y ? (inside.x < inside.z ? 0 : 2) : (inside.y < inside.z ? 1 : 2);
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        if (std::min(inside[a], inside[b]) < margin) return std::nullopt;
        const double r = std::hypot(p[a], p[b]);
        if (std::abs(r - radius) < margin || std::abs(r - inner_radius) < margin) return std::nullopt;
        return r > radius ? base : r > inner_radius ? c.disc : c.inner;
    }
};

TEST_F(Offset, TheNearestByOffsetIsSeenFromAllSides) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const Cast cast = cast_of(scene(c.draw));
        ASSERT_TRUE(cast.report.ok) << cast.report.error;
        for (const ViewImage& image : cast.images) {
            const Found found = judge(image, c);
            EXPECT_GT(found.pixels, 1000);
            EXPECT_EQ(found.wrong, 0);
            EXPECT_LT(found.furthest, furthest_allowed);
        }
    }
}

/// The same in a shell, so that it is in the layers 1 and 2. Slabs do not tell coplanar surfaces apart, but
/// find two of them once.
TEST_F(Offset, InInnerLayersToo) {
    for (const Case& c : cases)
        if (c.in_inner_layers) expect_in_inner_layers(c, LayerMethod::peel);
    expect_in_inner_layers(cases[0], LayerMethod::slab);
}

/// What has the deepest offset is where it was, to the bit, and an offset for all is none.
TEST_F(Offset, TheDeepestStays) {
    const Cast plain = cast_of(scene([](const GlTable& gl) { body(gl, base); }), 32);
    const Cast pushed = cast_of(scene([](const GlTable& gl) {
                                    offset(gl, 1, 1);
                                    body(gl, base);
                                }),
                                32);
    const Difference same = difference(plain, pushed);
    EXPECT_EQ(same.coverage + same.depth + same.colour, 0);
    EXPECT_EQ(plain.report.draws, pushed.report.draws);
    const Cast depth_first = cast_of(scene([](const GlTable& gl) {
                                         gl.ColorMask(0, 0, 0, 0);
                                         offset(gl, 1, 1);
                                         body(gl, paint);
                                         gl.ColorMask(1, 1, 1, 1);
                                         gl.Disable(GL_POLYGON_OFFSET_FILL);
                                         gl.DepthFunc(GL_LEQUAL);
                                         body(gl, base);
                                     }),
                                     32);
    const Difference same_again = difference(plain, depth_first);
    EXPECT_EQ(same_again.coverage + same_again.depth + same_again.colour, 0);
    const Cast decals = cast_of(scene(cases[0].draw), 32);
    const Difference moved = difference(plain, decals);
    EXPECT_EQ(moved.coverage, 0);
    EXPECT_GT(moved.depth, 0);
    const auto corner = pixel_of(unit_box, n, Axis::z, glm::dvec3(turned * glm::dvec4(half - 0.05, 1)));
    EXPECT_EQ(plain.view(Axis::z, Side::plus).depth[corner], decals.view(Axis::z, Side::plus).depth[corner]);
}

/// Blended with nothing below it, it is a surface of its own.
TEST_F(Offset, ALoneBlendedSurfaceStays) {
    const Case lone{"", nullptr, paint};
    const Cast cast = cast_of(scene([](const GlTable& gl) {
        offset(gl, 1, 1);
        gl.Color3f(1, 1, 1);
        draw_box(gl, glm::dvec3(0.8), glm::dvec3(0.81));
        gl.Disable(GL_POLYGON_OFFSET_FILL);
        blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        discs(gl, paint, 0.75f);
    }));
    for (const ViewImage& image : cast.images) {
        const Found found = judge(image, lone);
        EXPECT_GT(found.pixels, 300);
        EXPECT_EQ(found.wrong, 0);
    }
}

/// A blended mark does not colour what lies behind the surface that it is on, nor what is in front.
TEST_F(Offset, MarksStayOnTheirSurface) {
    const Cast cast = cast_of([](const GlTable& gl) {
        gl.Enable(GL_DEPTH_TEST);
        gl.Color3f(1, 1, 1);
        draw_box(gl, glm::dvec3(-0.9, -0.9, -0.9), glm::dvec3(0.9, 0.9, -0.8));
        gl.Color3f(base.r, base.g, base.b);
        draw_box(gl, glm::dvec3(-0.4, -0.4, 0), glm::dvec3(0.4, 0.4, 0.1));
        offset(gl, -1, -1);
        blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        gl.Color4f(0, 0, 0, 0.25f);
        gl.Rectf(-0.9f, -0.9f, 0, 0); // z = 0: inside the front box' far side, in front of the wall
        gl.Disable(GL_BLEND);
        gl.Disable(GL_POLYGON_OFFSET_FILL);
    });
    const ViewImage& image = cast.view(Axis::z, Side::plus);
    const auto colour = [&](glm::dvec3 p) {
        return glm::vec3(image.colour[pixel_of(unit_box, n, Axis::z, p)]);
    };
    EXPECT_LT(glm::distance(colour({0.2, 0.2, 0}), base), one_step);
    EXPECT_LT(glm::distance(colour({-0.2, -0.2, 0}), base), one_step);
    EXPECT_LT(glm::distance(colour({0.7, 0.7, 0}), glm::vec3(1)), one_step);
    const ViewImage& behind = cast.view(Axis::z, Side::minus);
    EXPECT_LT(glm::distance(glm::vec3(behind.colour[pixel_of(unit_box, n, Axis::z, {-0.2, -0.2, 0})]),
                            glm::vec3(1)),
              one_step);
}

/// Faces that one axis sees edge-on have no slope there that ends: their few pixels stay where the faces are, and the box
/// is the one without offsets.
TEST_F(Offset, FacesSeenEdgeOnStayWhereTheyAre) {
    const auto steps = [](float depth_a_step) -> DrawFunction {
        return [depth_a_step](const GlTable& gl) {
            gl.Enable(GL_DEPTH_TEST);
            for (int k = 0; k < 3; ++k) {
                offset(gl, depth_a_step * static_cast<float>(k), depth_a_step * static_cast<float>(k));
                const double s = 1 - 0.2 * k, z = 0.3 * k;
                gl.Begin(GL_QUADS); // in one plane with the y axis
                gl.Vertex3d(-s, -s, z - 0.7 * s), gl.Vertex3d(s, -s, z + 0.7 * s);
                gl.Vertex3d(s, s, z + 0.7 * s), gl.Vertex3d(-s, s, z - 0.7 * s);
                gl.End();
            }
            gl.Disable(GL_POLYGON_OFFSET_FILL);
        };
    };
    EngineOptions options = small_options(n);
    for (const double tilt : {0.0, 1e-9, 1e-7, 1e-5}) {
        SCOPED_TRACE(tilt);
        options.eye_to_capture = glm::rotate(glm::dmat4(1), tilt, glm::dvec3(1, 0, 0));
        const Cast plain = capture(gl, steps(0), options), stepped = capture(gl, steps(1), options);
        ASSERT_TRUE(stepped.report.ok) << stepped.report.error;
        EXPECT_NEAR(stepped.report.box.size, plain.report.box.size, 1e-3 * plain.report.box.size);
        for (const ViewImage& image : stepped.images)
            for (std::size_t p = 0; p < image.depth.size(); ++p)
                if (image.covered(p)) {
                    EXPECT_GT(image.depth[p], 1.5f / n);
                    EXPECT_LT(image.depth[p], 1 - 1.5f / n);
                }
    }
}

} // namespace
} // namespace glcast::test
