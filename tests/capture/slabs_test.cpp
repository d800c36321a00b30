// Depth layers by slabs of clip planes, and when they are taken or not enough.
#include "tests/capture/layers_of.h"

namespace glcast::test {
namespace {

/// A cup and a cylinder in a sphere.
void many_bodies(const GlTable& gl) {
    set_lit(gl);
    set_diffuse(gl, red);
    draw_sphere(gl, glm::dvec3(0.01), 0.95);
    gl.PushMatrix();
    gl.Rotated(40, 1, 1, 0.2);
    set_diffuse(gl, green);
    gl.Scaled(0.8, 0.8, 0.8);
    draw_cup(gl);
    gl.PopMatrix();
    set_diffuse(gl, blue);
    draw_cylinder(gl, {0.5, -0.4, -0.3}, 0.1, 0.5);
}

TEST_F(LayersOf, SlabsFindWhatPeelingFinds) {
    options.box = wide_box;
    const Cast peeled = complete_cast_of(many_bodies);
    options.layer_method = LayerMethod::slab;
    const Cast slabs = complete_cast_of(many_bodies);
    const LayerDifference d = layer_difference(peeled, slabs);
    EXPECT_GE(peeled.report.layer_count[0], 6);
    EXPECT_LE(d.wrong_count, d.rays / 1000); // hits as far apart as the tolerance
    EXPECT_LT(d.depth, 0.01);                // vertices are rounded otherwise in a slab
    EXPECT_LT(d.colour, 1.0 / 2000);
    EXPECT_LT(d.normal, 1e-3);
    RecordProperty("wrong", std::to_string(d.wrong_count));
    RecordProperty("slab_draws", std::to_string(slabs.report.layer_draws));
}

TEST_F(LayersOf, SlabsOfSpheresOneInTheOther) {
    options.layer_method = LayerMethod::slab;
    const Cast cast = complete_cast_of(nested_spheres);
    const LayerErrors e = layer_errors(cast, nested_bodies);
    EXPECT_LT(e.wrong_count, e.rays / 100);
    EXPECT_LT(e.depth_max, 0.1);
    EXPECT_LT(e.normal_max, 2);
    EXPECT_LT(e.colour_max, 1.0 / 255);
    options.most_layers = 3;
    const Cast fewer = cast_of(nested_spheres);
    EXPECT_EQ(fewer.report.layers, Layers::incomplete);
    EXPECT_EQ(fewer.report.layer_count[0], 3);
}

/// More hits than may be held: what is there stays, and it is said that more is not.
TEST_F(LayersOf, SlabsHoldNoMoreThanTwoImages) {
    options.layer_method = LayerMethod::slab;
    const Cast cast = cast_of([](const GlTable& gl) {
        set_lit(gl);
        for (const double half : {0.95, 0.9, 0.85, 0.8, 0.75})
            draw_box(gl, glm::dvec3(-half), glm::dvec3(half));
    });
    EXPECT_TRUE(cast.report.ok) << cast.report.error;
    EXPECT_EQ(cast.report.layers, Layers::incomplete);
    EXPECT_GE(cast.report.layer_count[0], 3);
}

/// Three sheets within a thinnest slab, not near enough to be one.
TEST_F(LayersOf, SlabsSayWhenTheyAreNotEnough) {
    const auto draw = [](const GlTable& gl) {
        set_lit(gl);
        draw_box(gl, glm::dvec3(-0.95), glm::dvec3(0.95));
        for (int k = 0; k < 4; ++k) {
            draw_sheet(gl, 0, 3);
            gl.Translated(0, 0, 1.05 * SameHit::flat * view_box.size / 64);
        }
    };
    EXPECT_EQ(complete_cast_of(draw).report.layer_count[2], 5);
    options.layer_method = LayerMethod::slab;
    const Cast cast = cast_of(draw);
    EXPECT_TRUE(cast.report.ok) << cast.report.error;
    EXPECT_EQ(cast.report.layers, Layers::incomplete);
    EXPECT_FALSE(cast.report.axis_complete[2]);
}

TEST_F(LayersOf, WithoutShadersSlabsAreTaken) {
    options.box = wide_box;
    options.use_shaders = false;
    EXPECT_EQ(cast_of(many_bodies).report.layer_method, LayerMethod::slab);
    options.use_shaders = true;
    GlTable old = gl;
    old.CreateShader = nullptr;
    const Cast cast = capture(old, many_bodies, options);
    EXPECT_EQ(cast.report.layer_method, LayerMethod::slab);
    EXPECT_EQ(cast.report.layers, Layers::complete);
}

/// A driver whose depths differ between the fixed fragment stage and a shader: nothing would be at equal
/// depth.
TEST_F(LayersOf, ADriverThatIsNotInvariantGetsSlabs) {
    options.box = wide_box;
    static const GlTable& real = gl;
    GlTable other = gl;
    other.UseProgram = [](GLuint program) {
        real.UseProgram(program);
        if (program == 0) return;
        real.PolygonOffset(0, 4);
        real.Enable(GL_POLYGON_OFFSET_FILL);
    };
    const Cast cast = capture(other, many_bodies, options);
    EXPECT_EQ(cast.report.layer_method, LayerMethod::slab);
    EXPECT_EQ(cast.report.layers, Layers::complete);
    EXPECT_LE(layer_difference(cast, cast_of(many_bodies)).wrong_count, 10);
}

/// What a program draws by shaders of its own is not peeled, and that is said.
TEST_F(LayersOf, ProgramsOfTheProgramMakeThemIncomplete) {
    const char* source = "void main() { gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0); }";
    const GLuint shader = gl.CreateShader(GL_FRAGMENT_SHADER), program = gl.CreateProgram();
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    gl.LinkProgram(program);
    const Cast cast = cast_of([program](const GlTable& gl) {
        set_lit(gl);
        draw_box(gl, glm::dvec3(-0.9), glm::dvec3(0.9));
        draw_box(gl, glm::dvec3(-0.5), glm::dvec3(0.5));
        gl.UseProgram(program);
        draw_box(gl, glm::dvec3(-0.7), glm::dvec3(0.7));
        gl.UseProgram(0);
    });
    EXPECT_TRUE(cast.report.ok) << cast.report.error;
    EXPECT_EQ(cast.report.layers, Layers::incomplete);
    EXPECT_EQ(cast.report.layer_count[0], 3) << "the box between is drawn by a shader";
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

/// The program's textures may be rectangles on any unit, and its pixel store anything.
TEST_F(LayersOf, StateOfTheSceneDoesNotReachTheShader) {
    const auto hostile = [](const GlTable& gl) {
        GLint units = 1;
        gl.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
        for (int unit = 0; unit < units; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + unit);
            gl.BindTexture(GL_TEXTURE_RECTANGLE, 0);
        }
        gl.ActiveTexture(GL_TEXTURE0);
        gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
        gl.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
        gl.PixelTransferf(GL_RED_SCALE, 0.5f);
        gl.PixelTransferi(GL_INDEX_OFFSET, 3);
        many_bodies(gl);
    };
    const LayerDifference d = layer_difference(complete_cast_of(hostile), complete_cast_of(many_bodies));
    EXPECT_EQ(d.wrong_count, 0);
    EXPECT_EQ(d.depth + d.colour + d.normal, 0);
}

} // namespace
} // namespace glcast::test
