// What the colour pass must make of materials, colours and textures: the diffuse colour, exactly.
#include <gtest/gtest.h>

#include "tests/capture/scenes.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {
namespace {

constexpr double one_step = 1.0 / 255;
const glm::vec3 red(0.8f, 0.1f, 0.2f), green(0.1f, 0.7f, 0.3f), blue(0.15f, 0.25f, 0.9f);

class Colour : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();

    Cast cast_of(const DrawFunction& draw) {
        EngineOptions options = small_options(16);
        options.box = Box{glm::dvec3(-1), 2};
        return capture(gl, draw, options);
    }
    /// A box drawn after `set`, seen from +z, in its middle.
    glm::vec3 colour_after(const DrawFunction& set) {
        const Cast cast = cast_of([&](const GlTable& table) {
            set_lit(table);
            set(table);
            draw_box(table, glm::dvec3(-0.5), glm::dvec3(0.5));
        });
        EXPECT_TRUE(cast.report.ok) << cast.report.error;
        const ViewImage& image = cast.view(Axis::z, Side::plus);
        const std::size_t middle = pixel_of(cast.report.box, image.n, Axis::z, glm::dvec3(0.01));
        EXPECT_TRUE(image.covered(middle));
        return glm::vec3(image.colour[middle]);
    }
};

#define EXPECT_COLOUR(actual, expected) EXPECT_LT(glm::distance(actual, glm::vec3(expected)), one_step)

TEST_F(Colour, DiffuseMaterialWhateverTheRestOfIt) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      set_diffuse(gl, blue, GL_AMBIENT);
                      set_diffuse(gl, red, GL_DIFFUSE);
                      set_diffuse(gl, glm::vec3(1), GL_SPECULAR);
                      set_diffuse(gl, green, GL_AMBIENT);
                      gl.Materialf(GL_FRONT_AND_BACK, GL_SHININESS, 20);
                  }),
                  red);
}

TEST_F(Colour, DefaultMaterialIsGreyAsInGl) {
    EXPECT_COLOUR(colour_after([](const GlTable&) {}), glm::vec3(0.8f));
}

TEST_F(Colour, IntegerMaterials) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      const GLint half[] = {0x7fffffff, 0x3fffffff, 0, 0x7fffffff}, none[] = {0, 0, 0, 0};
                      gl.Materialiv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, half);
                      gl.Materialiv(GL_FRONT, GL_AMBIENT, none);
                  }),
                  glm::vec3(1, 0.5, 0));
}

TEST_F(Colour, EmissionIsAdded) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      set_diffuse(gl, {0.25f, 0.25f, 0}, GL_DIFFUSE);
                      set_diffuse(gl, {0, 0.5f, 0.5f}, GL_EMISSION);
                  }),
                  glm::vec3(0.25, 0.75, 0.5));
}

TEST_F(Colour, LightsOfTheProgramDoNotCount) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      const GLfloat bright[] = {5, 5, 5, 1};
                      gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, bright);
                      gl.Lightfv(GL_LIGHT0, GL_AMBIENT, bright);
                      gl.Lightfv(GL_LIGHT3, GL_DIFFUSE, bright);
                      gl.Enable(GL_LIGHT3);
                      set_diffuse(gl, green);
                  }),
                  green);
}

struct ModeCase {
    const char* name;
    GLenum mode;
    bool follows; ///< the current colour is what is seen; else the material's diffuse is
};

TEST_F(Colour, ColourMaterialInEachMode) {
    const ModeCase cases[] = {{"diffuse", GL_DIFFUSE, true},
                              {"ambient and diffuse", GL_AMBIENT_AND_DIFFUSE, true},
                              {"ambient", GL_AMBIENT, false},
                              {"specular", GL_SPECULAR, false}};
    for (const ModeCase& c : cases) {
        SCOPED_TRACE(c.name);
        for (const bool enable_first : {true, false}) {
            const auto draw = [&](const GlTable& gl) {
                if (!enable_first) gl.ColorMaterial(GL_FRONT_AND_BACK, c.mode);
                gl.Color3f(0, 0, 0);
                gl.Enable(GL_COLOR_MATERIAL);
                if (enable_first) gl.ColorMaterial(GL_FRONT_AND_BACK, c.mode);
                set_diffuse(gl, red);
                gl.Color3f(green.r, green.g, green.b);
            };
            EXPECT_COLOUR(colour_after(draw), c.follows ? green : red);
        }
    }
}

TEST_F(Colour, ColourMaterialOfEmission) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      set_diffuse(gl, {0.5f, 0, 0});
                      gl.ColorMaterial(GL_FRONT, GL_EMISSION);
                      gl.Enable(GL_COLOR_MATERIAL);
                      gl.Color3f(0.25f, 0.5f, 0);
                  }),
                  glm::vec3(0.75, 0.5, 0));
}

TEST_F(Colour, ColourMaterialLeavesItsLastColourBehind) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      gl.Enable(GL_COLOR_MATERIAL);
                      gl.Color3f(blue.r, blue.g, blue.b);
                      gl.Disable(GL_COLOR_MATERIAL);
                      gl.Color3f(red.r, red.g, red.b);
                  }),
                  blue);
}

TEST_F(Colour, AttributeStackBringsMaterialsBack) {
    for (GLbitfield mask : {GLbitfield(GL_LIGHTING_BIT), GLbitfield(GL_LIGHTING_BIT | GL_ENABLE_BIT),
                            GLbitfield(GL_ALL_ATTRIB_BITS)}) {
        EXPECT_COLOUR(colour_after([mask](const GlTable& gl) {
                          set_diffuse(gl, red);
                          gl.PushAttrib(mask);
                          set_diffuse(gl, green);
                          gl.ColorMaterial(GL_FRONT_AND_BACK, GL_DIFFUSE);
                          gl.Enable(GL_COLOR_MATERIAL);
                          gl.PopAttrib();
                          gl.Color3f(blue.r, blue.g, blue.b);
                      }),
                      red);
    }
}

TEST_F(Colour, AttributeStackBringsTheModeOfColourMaterialBack) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      set_diffuse(gl, red);
                      gl.ColorMaterial(GL_FRONT_AND_BACK, GL_SPECULAR);
                      gl.Enable(GL_COLOR_MATERIAL);
                      gl.PushAttrib(GL_ENABLE_BIT); // has the cap, not the mode
                      gl.Disable(GL_COLOR_MATERIAL);
                      gl.ColorMaterial(GL_FRONT_AND_BACK, GL_DIFFUSE);
                      gl.PopAttrib(); // so now it follows the colour
                      gl.Color3f(green.r, green.g, green.b);
                  }),
                  green);
}

TEST_F(Colour, UnlitKeepsItsColour) {
    EXPECT_COLOUR(colour_after([](const GlTable& gl) {
                      set_diffuse(gl, red);
                      gl.Disable(GL_LIGHTING);
                      gl.Color3f(green.r, green.g, green.b);
                  }),
                  green);
}

TEST_F(Colour, TexturesModulate) {
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    const GLubyte texel[] = {255, 128, 0, 255};
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    const auto colour = colour_after([texture](const GlTable& gl) {
        set_diffuse(gl, {0.5f, 1, 1});
        gl.BindTexture(GL_TEXTURE_2D, texture);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
        gl.Enable(GL_TEXTURE_2D);
    });
    EXPECT_COLOUR(colour, glm::vec3(0.5, 128 / 255.0, 0));
}

TEST_F(Colour, MaterialsBetweenBeginAndEnd) {
    const Cast cast = cast_of([](const GlTable& gl) {
        set_lit(gl);
        gl.Begin(GL_QUADS);
        gl.Normal3f(0, 0, 1);
        for (int i = 0; i < 2; ++i) {
            const float x = i ? 0.1f : -0.9f;
            set_diffuse(gl, i ? green : red);
            set_diffuse(gl, blue, GL_AMBIENT);
            gl.Vertex3f(x, -0.5f, 0), gl.Vertex3f(x + 0.8f, -0.5f, 0);
            gl.Vertex3f(x + 0.8f, 0.5f, 0), gl.Vertex3f(x, 0.5f, 0);
        }
        gl.End();
    });
    const ViewImage& image = cast.view(Axis::z, Side::plus);
    const auto at = [&](double x) {
        return glm::vec3(image.colour[pixel_of(cast.report.box, image.n, Axis::z, {x, 0, 0})]);
    };
    EXPECT_COLOUR(at(-0.5), red);
    EXPECT_COLOUR(at(0.5), green);
}

TEST_F(Colour, EachFaceOfTwoSidedLightingHasItsMaterial) {
    const Cast cast = cast_of([](const GlTable& gl) {
        set_lit(gl);
        gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
        set_diffuse(gl, red, GL_DIFFUSE, GL_FRONT);
        set_diffuse(gl, green, GL_DIFFUSE, GL_BACK);
        gl.Begin(GL_QUADS); // counter-clockwise from +z
        gl.Vertex3f(-0.5f, -0.5f, 0), gl.Vertex3f(0.5f, -0.5f, 0);
        gl.Vertex3f(0.5f, 0.5f, 0), gl.Vertex3f(-0.5f, 0.5f, 0);
        gl.End();
    });
    const std::size_t middle = pixel_of(cast.report.box, 16, Axis::z, glm::dvec3(0));
    EXPECT_COLOUR(glm::vec3(cast.view(Axis::z, Side::plus).colour[middle]), red);
    EXPECT_COLOUR(glm::vec3(cast.view(Axis::z, Side::minus).colour[middle]), green);
}

TEST_F(Colour, EachSideOfACubeHasItsFace) {
    const std::vector<glm::vec3> faces = {red, green, blue, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    const Cast cast = cast_of([&](const GlTable& gl) {
        set_lit(gl);
        gl.ColorMaterial(GL_FRONT_AND_BACK, GL_DIFFUSE);
        gl.Enable(GL_COLOR_MATERIAL);
        draw_box(gl, glm::dvec3(-0.5), glm::dvec3(0.5), faces);
        gl.Disable(GL_COLOR_MATERIAL);
    });
    for (int k = 0; k < 6; ++k) {
        const ViewImage& image = cast.images[k];
        const std::size_t middle = pixel_of(cast.report.box, image.n, image.view.axis, glm::dvec3(0.01));
        EXPECT_COLOUR(glm::vec3(image.colour[middle]), faces[k]);
        glm::vec3 normal(0);
        normal[k / 2] = k % 2 ? 1 : -1;
        EXPECT_LT(glm::distance(glm::vec3(image.normal[middle]), normal), 1e-5) << k;
        EXPECT_NEAR(image.depth[middle], k % 2 ? 0.75 : 0.25, 1e-6);
    }
}

} // namespace
} // namespace glcast::test
