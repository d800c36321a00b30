// Several draws at one depth: the colour that the program's own sequence of draws leaves there, in closed
// form; on the sides (layer 0) and behind them, peeled and in slabs.
#include <gtest/gtest.h>

#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

constexpr double one_step = 1.0 / 255;
constexpr int n = 24;
const Box unit_box{glm::dvec3(-1), 2};
const glm::vec3 base(0.5f, 0.25f, 0.75f), light(0.5f, 1, 0.25f), paint(0.2f, 0.6f, 0.4f);

void coloured_box(const GlTable& gl, glm::vec3 colour, float alpha = 1) {
    gl.Color4f(colour.r, colour.g, colour.b, alpha);
    draw_box(gl, {-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2});
}

void set_unlit(const GlTable& gl) {
    gl.Enable(GL_DEPTH_TEST);
    gl.Disable(GL_LIGHTING);
}

void blend(const GlTable& gl, GLenum source, GLenum destination, GLenum depth = GL_LEQUAL) {
    gl.Enable(GL_BLEND);
    gl.BlendFunc(source, destination);
    gl.DepthFunc(depth);
}

struct Case {
    const char* name;
    void (*draw)(const GlTable& gl);
    glm::vec3 colour;
};

const Case cases[] = {
    {"light map: modulated",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_DST_COLOR, GL_ZERO);
         coloured_box(gl, light);
     },
     base* light},
    {"the other way to modulate, at equal depth",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ZERO, GL_SRC_COLOR, GL_EQUAL);
         coloured_box(gl, light);
     },
     base* light},
    {"detail texture: twice the product",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_DST_COLOR, GL_SRC_COLOR);
         coloured_box(gl, light);
     },
     glm::vec3(0.5f, 0.5f, 0.375f)},
    {"added",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ONE, GL_ONE);
         coloured_box(gl, paint);
     },
     glm::vec3(0.7f, 0.85f, 1)},
    {"added, weighed by alpha",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_SRC_ALPHA, GL_ONE);
         coloured_box(gl, paint, 0.25f);
     },
     base + 0.25f * paint},
    {"decal",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
         coloured_box(gl, paint, 0.75f);
     },
     glm::mix(base, paint, 0.75f)},
    {"decal that is hardly there",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
         coloured_box(gl, paint, 0.25f);
     },
     glm::mix(base, paint, 0.25f)},
    {"black, then added",
     [](const GlTable& gl) {
         coloured_box(gl, glm::vec3(0));
         blend(gl, GL_ONE, GL_ONE);
         coloured_box(gl, base);
     },
     base},
    {"nothing but sums at depths that were drawn before",
     [](const GlTable& gl) {
         gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
         coloured_box(gl, base);
         gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
         gl.DepthFunc(GL_EQUAL);
         blend(gl, GL_ONE, GL_ONE);
         coloured_box(gl, paint);
         coloured_box(gl, paint);
     },
     glm::vec3(0.4f, 1, 0.8f)},
    {"three passes: base, light map, gloss",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_DST_COLOR, GL_ZERO);
         coloured_box(gl, light);
         blend(gl, GL_ONE, GL_ONE);
         coloured_box(gl, paint);
     },
     base* light + paint},
    {"order counts: gloss before the light map",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ONE, GL_ONE);
         coloured_box(gl, glm::vec3(0.25f));
         blend(gl, GL_DST_COLOR, GL_ZERO);
         coloured_box(gl, light);
     },
     (base + 0.25f) * light},
    {"a glass over itself is itself",
     [](const GlTable& gl) {
         blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
         coloured_box(gl, paint, 0.75f);
     },
     paint},
    {"subtracted",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ONE, GL_ONE);
         gl.BlendEquation(GL_FUNC_REVERSE_SUBTRACT);
         coloured_box(gl, glm::vec3(0.25f, 0.125f, 1));
         gl.BlendEquation(GL_FUNC_ADD);
     },
     glm::vec3(0.25f, 0.125f, 0)},
    {"a constant colour",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         gl.BlendColor(0.5f, 0.5f, 0.5f, 1);
         blend(gl, GL_CONSTANT_COLOR, GL_CONSTANT_COLOR);
         coloured_box(gl, paint);
     },
     0.5f * (base + paint)},
    {"opaque twice, and only nearer ones pass: the first",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         coloured_box(gl, paint);
     },
     base},
    {"opaque twice, and equal ones pass: the last",
     [](const GlTable& gl) {
         gl.DepthFunc(GL_LEQUAL);
         coloured_box(gl, base);
         coloured_box(gl, paint);
     },
     paint},
    {"opaque twice without a depth test: the last",
     [](const GlTable& gl) {
         gl.Disable(GL_DEPTH_TEST);
         coloured_box(gl, base);
         coloured_box(gl, paint);
     },
     paint},
    {"blending that only nearer ones pass",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ONE, GL_ONE, GL_LESS);
         coloured_box(gl, paint);
     },
     base},
    {"depth not written by the first",
     [](const GlTable& gl) {
         gl.DepthMask(GL_FALSE);
         coloured_box(gl, base);
         gl.DepthMask(GL_TRUE);
         blend(gl, GL_ONE, GL_ONE, GL_LESS);
         coloured_box(gl, paint);
         coloured_box(gl, paint); // meets its own depth
     },
     glm::vec3(0.7f, 0.85f, 1)},
    {"depth cleared in between",
     [](const GlTable& gl) {
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         coloured_box(gl, base);
         gl.Clear(GL_DEPTH_BUFFER_BIT);
         coloured_box(gl, paint);
     },
     paint},
    {"depth first, colour at equal depth",
     [](const GlTable& gl) {
         gl.ColorMask(0, 0, 0, 0);
         coloured_box(gl, paint);
         gl.ColorMask(1, 1, 1, 1);
         gl.DepthFunc(GL_EQUAL);
         coloured_box(gl, base);
     },
     base},
    {"red, then green and blue (glasses)",
     [](const GlTable& gl) {
         gl.DepthFunc(GL_LEQUAL);
         gl.Enable(GL_BLEND); // replaces
         coloured_box(gl, glm::vec3(0));
         gl.ColorMask(1, 0, 0, 1);
         blend(gl, GL_ONE, GL_ONE);
         coloured_box(gl, base);
         gl.ColorMask(0, 1, 1, 1);
         coloured_box(gl, base);
         gl.ColorMask(1, 1, 1, 1);
     },
     base},
    {"the weight written to alpha first (glplanet, terrains)",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         gl.ColorMask(0, 0, 0, 1);
         gl.DepthFunc(GL_LEQUAL);
         coloured_box(gl, glm::vec3(0), 0.25f);
         gl.ColorMask(1, 1, 1, 1);
         blend(gl, GL_ONE_MINUS_DST_ALPHA, GL_DST_ALPHA);
         coloured_box(gl, paint);
     },
     0.75f * paint + 0.25f * base},
    {"the weight cleared in alpha",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         gl.ColorMask(0, 0, 0, 1);
         gl.ClearColor(1, 1, 1, 0.25f);
         gl.Clear(GL_COLOR_BUFFER_BIT);
         gl.ColorMask(1, 1, 1, 1);
         blend(gl, GL_ONE_MINUS_DST_ALPHA, GL_DST_ALPHA);
         coloured_box(gl, paint);
     },
     0.75f * paint + 0.25f * base},
    {"alpha test in the second pass",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ONE, GL_ONE);
         gl.Enable(GL_ALPHA_TEST);
         gl.AlphaFunc(GL_GREATER, 0.5f);
         coloured_box(gl, paint, 0.25f);
         coloured_box(gl, glm::vec3(0.1f), 0.75f);
         gl.Disable(GL_ALPHA_TEST);
     },
     base + 0.1f},
    {"a shadow by stencil is not a colour",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         gl.Enable(GL_STENCIL_TEST);
         gl.StencilFunc(GL_NOTEQUAL, 0, ~0u);
         blend(gl, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
         coloured_box(gl, glm::vec3(0), 0.5f);
         gl.Disable(GL_BLEND);
         coloured_box(gl, glm::vec3(0));
         gl.Disable(GL_STENCIL_TEST);
     },
     base},
    {"light where there is no shadow by stencil is one",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         gl.Enable(GL_STENCIL_TEST);
         gl.StencilFunc(GL_EQUAL, 0, ~0u);
         blend(gl, GL_ONE, GL_ONE, GL_EQUAL);
         coloured_box(gl, glm::vec3(0.125f));
         gl.Disable(GL_STENCIL_TEST);
     },
     base + 0.125f},
    {"pushed and popped",
     [](const GlTable& gl) {
         coloured_box(gl, base);
         blend(gl, GL_ONE, GL_ONE);
         gl.PushAttrib(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         blend(gl, GL_ZERO, GL_ZERO, GL_NEVER);
         gl.BlendEquation(GL_MIN);
         gl.ColorMask(0, 0, 1, 0);
         gl.DepthMask(0);
         gl.PopAttrib();
         coloured_box(gl, paint);
     },
     glm::vec3(0.7f, 0.85f, 1)},
};

class Coincident : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();

    Cast cast_of(const DrawFunction& draw, int layers = 1, LayerMethod method = LayerMethod::peel) {
        EngineOptions options = small_options(n);
        options.box = unit_box;
        options.most_layers = layers;
        options.layer_method = method;
        return capture(gl, draw, options);
    }
    static glm::vec3 middle_of(const ViewImage& image) {
        const std::size_t pixel = pixel_of(unit_box, n, image.view.axis, glm::dvec3(0.01));
        EXPECT_TRUE(image.covered(pixel));
        return glm::vec3(image.colour[pixel]);
    }
    static DrawFunction with_defaults(void (*draw)(const GlTable& gl)) {
        return [draw](const GlTable& table) {
            set_unlit(table);
            table.PushAttrib(GL_ALL_ATTRIB_BITS);
            draw(table);
            table.PopAttrib();
        };
    }
};

#define EXPECT_COLOUR(actual, expected) EXPECT_LT(glm::distance(actual, glm::vec3(expected)), one_step)

TEST_F(Coincident, OnAllSides) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const Cast cast = cast_of(with_defaults(c.draw));
        ASSERT_TRUE(cast.report.ok) << cast.report.error;
        for (const ViewImage& image : cast.images) EXPECT_COLOUR(middle_of(image), c.colour);
    }
}

/// The same box in a shell, so that it is in the layers 1 and 2.
TEST_F(Coincident, InInnerLayers) {
    for (const LayerMethod method : {LayerMethod::peel, LayerMethod::slab}) {
        for (const Case& c : cases) {
            SCOPED_TRACE(std::string(c.name) + (method == LayerMethod::peel ? ", peeled" : ", slabs"));
            const auto draw = [&](const GlTable& table) {
                with_defaults(c.draw)(table);
                table.Color4f(1, 1, 1, 1);
                draw_box(table, glm::dvec3(-0.8), glm::dvec3(0.8));
            };
            const Cast cast = cast_of(draw, 32, method);
            ASSERT_TRUE(cast.report.ok) << cast.report.error;
            EXPECT_EQ(cast.report.layers, Layers::complete);
            for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
                EXPECT_COLOUR(middle_of(cast.view(axis, Side::minus)), glm::vec3(1));
                for (const int layer : {1, 2}) {
                    const ViewImage* image = cast.find({axis, Side::minus, layer});
                    ASSERT_NE(image, nullptr);
                    EXPECT_COLOUR(middle_of(*image), c.colour) << layer;
                }
            }
        }
    }
}

TEST_F(Coincident, EightBitTargetsToo) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        EngineOptions options = small_options(n);
        options.box = unit_box;
        options.use_float_targets = false;
        const Cast cast = capture(gl, with_defaults(c.draw), options);
        ASSERT_TRUE(cast.report.ok) << cast.report.error;
        EXPECT_LT(glm::distance(middle_of(cast.view(Axis::z, Side::plus)), c.colour), 3 * one_step);
    }
}

/// What only tints what is behind it is no surface: a shadow that lies on the floor, a light map that hangs
/// loose.
TEST_F(Coincident, TintsAreNotSolid) {
    struct Tint {
        GLenum source, destination;
    };
    for (const Tint tint : {Tint{GL_DST_COLOR, GL_ZERO},
                            {GL_ZERO, GL_SRC_COLOR},
                            {GL_DST_COLOR, GL_SRC_COLOR},
                            {GL_ZERO, GL_ONE_MINUS_SRC_ALPHA},
                            {GL_DST_COLOR, GL_ONE}}) {
        const Cast cast = cast_of([&](const GlTable& table) {
            set_unlit(table);
            table.Color3f(base.r, base.g, base.b);
            draw_box(table, {-0.9, -0.9, -0.9}, {0.9, 0.9, -0.8});
            blend(table, tint.source, tint.destination);
            table.Color4f(0.5f, 0.5f, 0.5f, 1);
            draw_box(table, {-0.4, -0.4, -0.7}, {0.4, 0.4, -0.6});
            table.Disable(GL_BLEND);
        });
        ASSERT_TRUE(cast.report.ok);
        const ViewImage& image = cast.view(Axis::z, Side::plus);
        const std::size_t pixel = pixel_of(unit_box, n, Axis::z, glm::dvec3(0.01));
        EXPECT_NEAR(image.depth[pixel], 0.1, 1e-6); // the floor's top
        EXPECT_COLOUR(glm::vec3(image.colour[pixel]), base);
    }
}

/// A glass in front of a wall does not colour it, nor the other way round.
TEST_F(Coincident, OtherDepthsDoNotMix) {
    const Cast cast = cast_of([](const GlTable& table) {
        set_unlit(table);
        table.Color3f(base.r, base.g, base.b);
        draw_box(table, {-0.9, -0.9, -0.9}, {0.9, 0.9, -0.8});
        blend(table, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        table.Color4f(1, 0, 0, 0.25f); // not solid
        draw_box(table, {-0.9, -0.9, 0.5}, {0, 0.9, 0.6});
        table.Color4f(0, 1, 0, 0.75f); // solid
        draw_box(table, {0.1, -0.9, 0.5}, {0.9, 0.9, 0.6});
        table.Disable(GL_BLEND);
    });
    const ViewImage& image = cast.view(Axis::z, Side::plus);
    EXPECT_COLOUR(glm::vec3(image.colour[pixel_of(unit_box, n, Axis::z, {-0.5, 0, 0})]), base);
    EXPECT_COLOUR(glm::vec3(image.colour[pixel_of(unit_box, n, Axis::z, {0.5, 0, 0})]), glm::vec3(0, 1, 0));
}

/// Ambient light first, then a pass for each light: the material is the same in each, and our passes have no
/// light.
TEST_F(Coincident, FurtherLightsOfALitSurfaceDoNotAddUp) {
    const Cast cast = cast_of([](const GlTable& table) {
        set_lit(table);
        set_diffuse(table, paint);
        draw_box(table, glm::dvec3(-0.4), glm::dvec3(0.4));
        blend(table, GL_ONE, GL_ONE, GL_EQUAL);
        for (int i = 0; i < 3; ++i) draw_box(table, glm::dvec3(-0.4), glm::dvec3(0.4));
        table.Disable(GL_BLEND);
    });
    for (const ViewImage& image : cast.images) {
        EXPECT_COLOUR(middle_of(image), paint);
        EXPECT_EQ(image.normal[pixel_of(unit_box, n, image.view.axis, glm::dvec3(0.01))].w, 1);
    }
}

TEST_F(Coincident, ALitDrawOverAnUnlitOneGivesTheNormal) {
    for (const bool unlit_first : {true, false}) {
        const Cast cast = cast_of([&](const GlTable& table) {
            set_lit(table);
            table.DepthFunc(GL_LEQUAL);
            for (const bool lit : {!unlit_first, unlit_first}) {
                lit ? table.Enable(GL_LIGHTING) : table.Disable(GL_LIGHTING);
                draw_box(table, glm::dvec3(-0.4), glm::dvec3(0.4));
            }
        });
        for (const ViewImage& image : cast.images)
            EXPECT_EQ(image.normal[pixel_of(unit_box, n, image.view.axis, glm::dvec3(0.01))].w, 1);
        EXPECT_EQ(cast.report.pixels_without_normal, 0);
    }
}

/// A render more for each image, and only where something blends.
TEST_F(Coincident, OnlyBlendingCosts) {
    const Cast plain = cast_of(with_defaults([](const GlTable& gl) { coloured_box(gl, base); }));
    const Cast blended = cast_of(with_defaults(cases[0].draw));
    EXPECT_EQ(plain.report.draws, 6 * (1 + 1)); // colours and normals
    EXPECT_EQ(blended.report.draws, plain.report.draws + 6);
}

} // namespace
} // namespace glcast::test
