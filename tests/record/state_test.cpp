// State: what a frame starts from, what it leaves alone, stacks that reach below its start, errors.
#include "shim/record/snapshot.h"
#include "tests/record/rig.h"
#include "tests/record/state_dump.h"

namespace glcast::test {
namespace {

/// Nothing at its default.
void disturb(const GlTable& gl) {
    gl.ClearColor(0.1f, 0.9f, 0.3f, 0.4f), gl.ClearDepth(0.7), gl.ClearStencil(3),
        gl.ClearAccum(0.5f, 0.5f, 0.5f, 0.5f);
    gl.AlphaFunc(GL_GREATER, 0.3f), gl.DepthFunc(GL_GEQUAL), gl.DepthMask(GL_FALSE), gl.DepthRange(0.2, 0.8);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE, GL_DST_ALPHA, GL_ZERO), gl.BlendColor(0.1f, 0.2f, 0.3f, 0.4f);
    gl.BlendEquationSeparate(GL_FUNC_SUBTRACT, GL_MAX), gl.LogicOp(GL_XOR), gl.ColorMask(1, 0, 1, 0);
    gl.StencilFuncSeparate(GL_FRONT, GL_LESS, 5, 0x0F),
        gl.StencilOpSeparate(GL_BACK, GL_INCR, GL_DECR, GL_INVERT);
    gl.StencilMaskSeparate(GL_BACK, 0x33), gl.CullFace(GL_FRONT), gl.FrontFace(GL_CW), gl.ShadeModel(GL_FLAT);
    gl.PolygonMode(GL_FRONT, GL_LINE), gl.PolygonMode(GL_BACK, GL_POINT), gl.PolygonOffset(1.5f, 2);
    gl.LineWidth(3), gl.LineStipple(2, 0x5A5A), gl.PointSize(4), gl.Viewport(3, 4, 50, 40),
        gl.Scissor(1, 2, 30, 33);
    gl.Color4f(0.25f, 0.5f, 0.75f, 1), gl.Normal3f(0.6f, 0, 0.8f), gl.SecondaryColor3f(0.1f, 0.2f, 0.3f),
        gl.FogCoordf(2);
    gl.EdgeFlag(GL_FALSE), gl.ListBase(77), gl.PixelZoom(2, -1), gl.PixelTransferf(GL_RED_SCALE, 2);
    const GLfloat map[] = {0, 0.5f, 1, 1};
    gl.PixelMapfv(GL_PIXEL_MAP_R_TO_R, 4, map);
    gl.WindowPos3f(10, 12, 0.5f);
    const GLfloat a[] = {1, 2, 3, 1}, b[] = {0.1f, 0.2f, 0.3f, 0.4f};
    gl.MatrixMode(GL_MODELVIEW), gl.Translatef(1, 2, 3), gl.Rotatef(30, 1, 1, 0);
    gl.Lightfv(GL_LIGHT0, GL_POSITION, a), gl.Lightfv(GL_LIGHT7, GL_DIFFUSE, b),
        gl.Lightf(GL_LIGHT1, GL_SPOT_CUTOFF, 40);
    gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, b), gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
    gl.Materialfv(GL_BACK, GL_SPECULAR, b), gl.Materialf(GL_FRONT, GL_SHININESS, 12),
        gl.ColorMaterial(GL_FRONT, GL_EMISSION);
    const GLdouble plane[] = {0.5, 0.25, 1, 2};
    gl.ClipPlane(GL_CLIP_PLANE5, plane);
    gl.Fogi(GL_FOG_MODE, GL_LINEAR), gl.Fogf(GL_FOG_END, 9), gl.Fogfv(GL_FOG_COLOR, b),
        gl.Fogi(GL_FOG_COORD_SRC, GL_FOG_COORD);
    gl.PointParameterfv(GL_POINT_DISTANCE_ATTENUATION, b), gl.PointParameterf(GL_POINT_SIZE_MAX, 20);
    const GLfloat points[] = {0, 0, 0, 1, 2, 3, 4, 5, 6};
    gl.Map1f(GL_MAP1_VERTEX_3, -1, 2, 3, 3, points), gl.MapGrid1f(7, 0, 3), gl.MapGrid2f(3, 0, 1, 4, 1, 2);
    gl.MatrixMode(GL_PROJECTION), gl.Ortho(-2, 2, -3, 3, -4, 4), gl.PushMatrix(), gl.Scalef(1, 2, 3);
    gl.ActiveTexture(GL_TEXTURE3);
    gl.MatrixMode(GL_TEXTURE), gl.Translatef(4, 5, 6);
    gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE), gl.TexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2);
    gl.TexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR), gl.TexGenfv(GL_T, GL_EYE_PLANE, b);
    gl.MultiTexCoord4f(GL_TEXTURE2, 1, 2, 3, 4);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.ActiveTexture(GL_TEXTURE1);
    const GLubyte image[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
    gl.Enable(GL_TEXTURE_2D);
    for (const GLenum name :
         {GL_ALPHA_TEST, GL_BLEND, GL_FOG, GL_LIGHTING, GL_LIGHT7, GL_CLIP_PLANE5, GL_SCISSOR_TEST,
          GL_STENCIL_TEST, GL_MAP1_VERTEX_3, GL_COLOR_MATERIAL, GL_TEXTURE_GEN_T, GL_LINE_SMOOTH})
        gl.Enable(name);
}

void disturb_client_state(const GlTable& gl) {
    static const GLfloat data[12] = {};
    GLuint buffers[2];
    gl.GenBuffers(2, buffers);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]),
        gl.BufferData(GL_ARRAY_BUFFER, sizeof data, data, GL_STATIC_DRAW);
    gl.NormalPointer(GL_FLOAT, 12, nullptr), gl.EnableClientState(GL_NORMAL_ARRAY);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffers[1]);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 8), gl.PixelStorei(GL_PACK_SKIP_ROWS, 3),
        gl.PixelStorei(GL_PACK_SWAP_BYTES, 1);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 5);
    gl.ClientActiveTexture(GL_TEXTURE2), gl.TexCoordPointer(2, GL_FLOAT, 0, nullptr),
        gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.ClientActiveTexture(GL_TEXTURE1);
}

TEST(State, recording_changes_nothing_and_leaves_no_error) {
    Rig rig;
    disturb(rig.gl());
    disturb_client_state(rig.gl());
    ASSERT_EQ(rig.gl().GetError(), GLenum(GL_NO_ERROR));
    const State before = dump_state(rig.program.gl(), true);
    ASSERT_EQ(rig.gl().GetError(), GLenum(GL_NO_ERROR));
    rig.begin();
    EXPECT_EQ(rig.gl().GetError(), GLenum(GL_NO_ERROR));
    EXPECT_EQ(difference(before, dump_state(rig.program.gl(), true)), "");
    rig.gl().DrawArrays(GL_POINTS, 0, 1);
    rig.end();
    EXPECT_EQ(rig.gl().GetError(), GLenum(GL_NO_ERROR));
    EXPECT_EQ(difference(before, dump_state(rig.program.gl(), true)), "");
}

TEST(State, a_pending_error_is_still_there) {
    Rig rig;
    rig.gl().Enable(0x12345);
    rig.begin();
    triangle(rig.gl());
    rig.end();
    EXPECT_EQ(rig.gl().GetError(), GLenum(GL_INVALID_ENUM));
    EXPECT_EQ(rig.gl().GetError(), GLenum(GL_NO_ERROR));
}

/// Replays have textures of their own for the name 0. How many bindings that changed.
std::size_t bind_0_for_stand_ins(Rig& rig) {
    const GlTable& gl = rig.replayer.gl();
    GLint active = 0, units = 0;
    std::size_t changed = 0;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active), gl.GetIntegerv(GL_MAX_TEXTURE_UNITS, &units);
    for (int unit = 0; unit < units; ++unit) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        for (const auto& [target, name] : rig.frame->default_textures) {
            GLint bound = 0;
            gl.GetIntegerv(record::texture_binding(target), &bound);
            if (GLuint(bound) == name) gl.BindTexture(target, 0), ++changed;
        }
    }
    gl.ActiveTexture(GLenum(active));
    return changed;
}

TEST(State, prologue_makes_the_same_state) {
    Rig rig;
    disturb(rig.gl());
    rig.begin();
    rig.end();
    State wanted = dump_state(rig.program.gl(), false);
    for (int i = 0; i < 2; ++i) {
        rig.replayed();
        EXPECT_EQ(rig.replayer.gl().GetError(), GLenum(GL_NO_ERROR));
        const std::size_t renamed = bind_0_for_stand_ins(rig);
        EXPECT_GT(renamed, 0u);
        EXPECT_EQ(difference(wanted, dump_state(rig.replayer.gl(), false)), "");
        const GlTable& gl = rig.replayer.gl(); // whatever a pass leaves behind
        gl.MatrixMode(GL_MODELVIEW), gl.PushMatrix(), gl.PushAttrib(GL_ENABLE_BIT), gl.Enable(GL_LIGHT1),
            gl.LoadIdentity();
    }
}

const Case cases[] = {
    {"immediate", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         triangle(gl);
     }},
    {"rectangles", nullptr,
     [](auto& gl) {
         const GLfloat a[] = {-1, -1}, b[] = {0, 0.5f};
         const GLint c[] = {0, 0}, d[] = {1, 1};
         begin_scene(gl), gl.Color3f(1, 1, 0), gl.Rectfv(a, b), gl.Color3f(0, 1, 1), gl.Rectiv(c, d),
             gl.Rects(-1, 0, 0, 1);
     }},
    {"set_before_the_frame",
     [](auto& gl) {
         begin_scene(gl);
         const GLfloat plane[] = {0.4f, 0.3f, 0.2f, 1};
         const GLdouble cut[] = {1, 1, 0, 0.3};
         gl.Materialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, plane);
         gl.Rotatef(20, 0, 1, 0);
         gl.ClipPlane(GL_CLIP_PLANE0, cut);
         gl.Enable(GL_CLIP_PLANE0), gl.Enable(GL_LIGHTING), gl.Enable(GL_NORMALIZE);
         gl.Normal3f(0.3f, 0.5f, 1), gl.ShadeModel(GL_FLAT);
     },
     [](auto& gl) {
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         gl.Rectf(-1, -1, 1, 1);
     }},
    {"matrices_pushed_in_the_frame_before",
     [](auto& gl) {
         begin_scene(gl);
         gl.PushMatrix();
         gl.Translatef(-1, 0, 0);
         gl.PushMatrix();
         gl.Scalef(0.1f, 9, 1);
     },
     [](auto& gl) {
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         triangle(gl);
         gl.PopMatrix();
         triangle(gl, 0, 0, -1);
         gl.PushMatrix(), gl.PopMatrix(), gl.PopMatrix();
         triangle(gl, 1, 1, 0, 0.7f);
     }},
    {"texture_matrix_pushed_before",
     [](auto& gl) { gl.MatrixMode(GL_TEXTURE), gl.Scalef(2, 2, 2), gl.PushMatrix(), gl.LoadIdentity(); },
     [](auto& gl) {
         begin_scene(gl);
         const GLubyte image[] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255};
         gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, image);
         gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
         gl.Enable(GL_TEXTURE_2D);
         gl.MatrixMode(GL_TEXTURE), gl.PopMatrix(), gl.MatrixMode(GL_MODELVIEW);
         gl.Begin(GL_TRIANGLES);
         gl.TexCoord2f(0, 0), gl.Vertex2f(-1, -1), gl.TexCoord2f(1, 0), gl.Vertex2f(1, -1),
             gl.TexCoord2f(0, 1), gl.Vertex2f(0, 1);
         gl.End();
     }},
    {"attributes_pushed_in_the_frame_before",
     [](auto& gl) {
         begin_scene(gl);
         gl.Enable(GL_LIGHTING), gl.Color3f(1, 0, 0), gl.Translatef(0.2f, 0, 0);
         gl.PushAttrib(GL_ALL_ATTRIB_BITS);
         gl.Disable(GL_LIGHTING), gl.Color3f(0, 1, 0);
         const GLfloat other[] = {-1, -5, 0, 1};
         gl.Lightfv(GL_LIGHT0, GL_POSITION, other);
     },
     [](auto& gl) {
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         gl.Rectf(-1, -1, 0, 0);
         gl.PopAttrib();
         gl.Enable(GL_COLOR_MATERIAL), gl.Normal3f(0, 0, 1);
         gl.Rectf(0, 0, 1, 1);
     }},
    {"attributes_popped_by_a_list",
     [](auto& gl) {
         begin_scene(gl);
         gl.Color3f(1, 0, 0);
         gl.PushAttrib(GL_CURRENT_BIT), gl.Color3f(0, 1, 0), gl.PushAttrib(GL_CURRENT_BIT),
             gl.Color3f(0, 0, 1);
         gl.NewList(1, GL_COMPILE), gl.PopAttrib(), gl.EndList();
     },
     [](auto& gl) {
         gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
         gl.Rectf(-2, -2, -1, 2);
         gl.CallList(1);
         gl.Rectf(-1, -2, 0, 2);
         gl.NewList(2, GL_COMPILE_AND_EXECUTE), gl.PopAttrib(), gl.EndList();
         gl.Rectf(0, -2, 2, 2);
     }},
    {"selection_in_the_frame", nullptr,
     [](auto& gl) {
         static GLuint names[64];
         begin_scene(gl);
         gl.SelectBuffer(64, names);
         gl.RenderMode(GL_SELECT);
         gl.InitNames(), gl.PushName(1);
         triangle(gl, 1, 1);
         gl.RenderMode(GL_RENDER);
         triangle(gl);
     }},
    {"scissor_and_stencil", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.Clear(GL_STENCIL_BUFFER_BIT);
         gl.Enable(GL_STENCIL_TEST), gl.StencilFunc(GL_ALWAYS, 1, 255),
             gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
         triangle(gl);
         gl.StencilFunc(GL_NOTEQUAL, 1, 255), gl.Disable(GL_DEPTH_TEST);
         gl.Enable(GL_SCISSOR_TEST), gl.Scissor(10, 10, 40, 30);
         gl.Rectf(-2, -2, 2, 2);
     }},
    {"errors_in_the_frame", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.Begin(GL_TRIANGLES), gl.Enable(GL_BLEND), gl.Begin(GL_LINES), gl.DrawArrays(GL_POINTS, 0, 1),
             gl.PopMatrix();
         gl.Vertex2f(-1, -1), gl.Vertex2f(1, -1), gl.Vertex2f(0, 1), gl.End();
         gl.Begin(0x99), gl.End(), gl.PopAttrib(), gl.Materialfv(GL_FRONT, 0x99, nullptr);
         while (gl.GetError() != GL_NO_ERROR) {
         }
     }},
    {"extension_names", nullptr,
     [](auto& gl) {
         begin_scene(gl);
         gl.ActiveTextureARB(GL_TEXTURE0);
         gl.BlendColorEXT(1, 0, 0, 1);
         gl.Enable(GL_BLEND), gl.BlendFunc(GL_CONSTANT_COLOR, GL_ONE), gl.Disable(GL_DEPTH_TEST);
         triangle(gl);
     }},
};

class StateCase : public testing::TestWithParam<Case> {};
TEST_P(StateCase, replays_as_drawn) {
    Rig rig;
    expect_same_image(rig, GetParam());
}
INSTANTIATE_TEST_SUITE_P(States, StateCase, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

TEST(Busy, says_why) {
    Rig rig;
    const GlTable& gl = rig.gl();
    EXPECT_EQ(record::busy(*rig.context), nullptr);
    gl.NewList(1, GL_COMPILE);
    EXPECT_STREQ(record::busy(*rig.context), "a display list is open");
    gl.EndList();
    GLuint buffer[8], query = 0;
    gl.SelectBuffer(8, buffer);
    gl.RenderMode(GL_SELECT);
    EXPECT_STREQ(record::busy(*rig.context), "in selection mode");
    gl.RenderMode(GL_RENDER);
    gl.GenQueries(1, &query);
    gl.BeginQuery(GL_SAMPLES_PASSED, query);
    EXPECT_STREQ(record::busy(*rig.context), "a query is active");
    gl.EndQuery(GL_SAMPLES_PASSED);
    rig.begin();
    gl.Begin(GL_POINTS);
    EXPECT_STREQ(record::busy(*rig.context), "inside glBegin");
    gl.End();
    rig.end();
    EXPECT_EQ(record::busy(*rig.context), nullptr);
}

TEST(Idle, only_lists_are_always_shadowed) {
    EXPECT_TRUE(record::always_shadowed(GlCall::NewList));
    EXPECT_TRUE(record::always_shadowed(GlCall::DeleteLists));
    EXPECT_FALSE(record::always_shadowed(GlCall::Vertex3f));
    EXPECT_FALSE(record::always_shadowed(GlCall::VertexPointer));
    Rig rig;
    EXPECT_EQ(record::active, 0u);
    rig.begin();
    EXPECT_EQ(record::active, 1u);
    rig.end();
    EXPECT_EQ(record::active, 0u);
}

TEST(Idle, a_thread_without_a_context_passes_through) {
    OsmesaContext context(8, 8);
    record::set_current(nullptr, context.gl());
    record::table().ClearColor(0.5f, 0, 0, 1);
    GLfloat colour[4] = {};
    record::table().GetFloatv(GL_COLOR_CLEAR_VALUE, colour);
    EXPECT_EQ(colour[0], 0.5f);
}

} // namespace
} // namespace glcast::test
