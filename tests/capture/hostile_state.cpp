#include "tests/capture/hostile_state.h"

namespace glcast::test {

namespace {

constexpr GLfloat lurid[] = {1, 0, 1, 0.5f};
constexpr GLdouble skewed[] = {2, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, -3, 0, 0.2, 0.1, 0, 1};
constexpr GLfloat skewed_f[] = {2, 0, 0, 0, 0.5f, 1, 0, 0, 0, 0, -3, 0, 0.2f, 0.1f, 0, 1};

template <auto Call, class... Args> void in_projection(const GlTable& gl, Args... args) {
    gl.MatrixMode(GL_PROJECTION);
    (gl.*Call)(args...);
    gl.MatrixMode(GL_MODELVIEW);
}

void make_framebuffer(const GlTable& gl) {
    GLuint name = 0;
    gl.GenFramebuffers(1, &name);
    gl.BindFramebuffer(GL_FRAMEBUFFER, name);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    const GLuint first[] = {1, 2, 3, 4};
    gl.DeleteFramebuffers(4, first); // in the program these are its own
    gl.DeleteRenderbuffers(4, first);
}

void query(const GlTable& gl) {
    GLuint name = 0;
    gl.GenQueries(1, &name);
    gl.BeginQuery(GL_SAMPLES_PASSED, name);
    gl.EndQuery(GL_SAMPLES_PASSED);
    gl.DeleteQueries(1, &name);
}

void texture_copy(const GlTable& gl) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 0, 0, 4, 4, 0);
    gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 4, 4);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.DeleteTextures(1, &name);
}

void flat_drawing(const GlTable& gl) {
    static const GLubyte ink[64] = {255, 255, 255, 255, 255, 255, 255, 255};
    gl.RasterPos3f(0, 0, 0.9f);
    gl.Bitmap(8, 8, 0, 0, 0, 0, ink);
    gl.DrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, ink);
    gl.CopyPixels(0, 0, 4, 4, GL_COLOR);
}

void read_back(const GlTable& gl) {
    GLubyte pixels[4 * 4 * 4] = {};
    gl.ReadBuffer(GL_NONE);
    gl.ReadPixels(0, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

void pixel_paths(const GlTable& gl) {
    gl.PixelTransferf(GL_RED_SCALE, 0.5f);
    gl.PixelTransferf(GL_DEPTH_BIAS, 0.25f);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, 1000);
    gl.PixelStorei(GL_PACK_SKIP_ROWS, 3);
}

void stencil(const GlTable& gl) {
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_NEVER, 1, 1);
    gl.StencilOp(GL_ZERO, GL_ZERO, GL_ZERO);
    gl.StencilMask(0);
    gl.StencilFuncSeparate(GL_FRONT, GL_NEVER, 1, 1);
    gl.StencilOpSeparate(GL_BACK, GL_ZERO, GL_ZERO, GL_ZERO);
    gl.StencilMaskSeparate(GL_FRONT, 0);
}

void fog(const GlTable& gl) {
    gl.Enable(GL_FOG);
    gl.Fogi(GL_FOG_MODE, GL_LINEAR);
    gl.Fogf(GL_FOG_END, 0.01f);
    gl.Fogfv(GL_FOG_COLOR, lurid);
}

void light(const GlTable& gl) {
    for (GLenum i = GL_LIGHT0; i < GL_LIGHT0 + 8; ++i) {
        gl.Enable(i);
        gl.Lightfv(i, GL_AMBIENT, lurid);
        gl.Lightfv(i, GL_DIFFUSE, lurid);
        gl.Lightfv(i, GL_POSITION, lurid);
        gl.Lightf(i, GL_SPOT_CUTOFF, 10);
    }
    for (GLenum i = GL_LIGHT0; i < GL_LIGHT0 + 4; ++i) gl.Disable(i);
    gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, lurid);
    gl.LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
    gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
}

void polygon_offset(const GlTable& gl) {
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(100, 100000);
}

void polygons(const GlTable& gl) {
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl.Enable(GL_POLYGON_STIPPLE);
    static const GLubyte none[128] = {};
    gl.PolygonStipple(none);
    gl.Enable(GL_POLYGON_SMOOTH);
    gl.EdgeFlag(GL_FALSE);
}

void logic(const GlTable& gl) {
    gl.Enable(GL_COLOR_LOGIC_OP);
    gl.LogicOp(GL_COPY_INVERTED);
    gl.BlendColor(1, 0, 0, 1);
}

void samples(const GlTable& gl) {
    gl.Enable(GL_MULTISAMPLE);
    gl.Enable(GL_SAMPLE_COVERAGE);
    gl.SampleCoverage(0, GL_FALSE);
    gl.Enable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

void clears(const GlTable& gl) {
    gl.ClearColor(1, 0, 1, 1);
    gl.ClearDepth(0.5);
    gl.ClearStencil(3);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl.Accum(GL_LOAD, 1);
    gl.Accum(GL_RETURN, 0);
}

} // namespace

const std::vector<HostileCall>& hostile_calls() {
    static const std::vector<HostileCall> calls = {
        {"viewport", [](const GlTable& gl) { gl.Viewport(3, 4, 5, 6); }},
        {"scissor", [](const GlTable& gl) { gl.Scissor(0, 0, 1, 1), gl.Enable(GL_SCISSOR_TEST); }},
        {"scissor, indexed",
         [](const GlTable& gl) { gl.Scissor(0, 0, 1, 1), gl.Enablei(GL_SCISSOR_TEST, 0); }},
        {"depth range", [](const GlTable& gl) { gl.DepthRange(0.75, 0.25); }},
        {"depth test", [](const GlTable& gl) { gl.Disable(GL_DEPTH_TEST); }},
        {"depth function", [](const GlTable& gl) { gl.DepthFunc(GL_GREATER); }},
        {"depth mask", [](const GlTable& gl) { gl.DepthMask(GL_FALSE); }},
        {"depth clamp", [](const GlTable& gl) { gl.Enable(GL_DEPTH_CLAMP); }, true},
        {"stencil", stencil},
        {"colour mask", [](const GlTable& gl) { gl.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE); }},
        {"fog", fog},
        {"lights", light},
        {"logic op and blend colour", logic, true},
        {"blending by a constant",
         [](const GlTable& gl) {
             gl.BlendColor(0, 0, 0, 1);
             gl.Enable(GL_BLEND), gl.BlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
         },
         true},
        {"dither", [](const GlTable& gl) { gl.Enable(GL_DITHER); }, true},
        {"culling", [](const GlTable& gl) { gl.Enable(GL_CULL_FACE), gl.CullFace(GL_FRONT); }},
        {"polygon offset", polygon_offset},
        {"polygon mode, stipple, smooth", polygons},
        {"samples", samples, true},
        {"clamps", [](const GlTable& gl) { gl.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_TRUE); }},
        {"sRGB", [](const GlTable& gl) { gl.Enable(GL_FRAMEBUFFER_SRGB); }, true},
        {"clears", clears},
        {"draw buffer", [](const GlTable& gl) { gl.DrawBuffer(GL_FRONT); }, true},
        {"framebuffers", make_framebuffer},
        {"queries", query, true},
        {"texture copies", texture_copy, true},
        {"flat drawing", flat_drawing},
        {"reads", read_back},
        {"pixel paths", pixel_paths, true},
        {"frustum", [](const GlTable& gl) { in_projection<&GlTable::Frustum>(gl, -1, 1, -1, 1, 1, 9); }},
        {"ortho", [](const GlTable& gl) { in_projection<&GlTable::Ortho>(gl, -1, 3, -1, 2, 1, 9); }},
        {"load identity", [](const GlTable& gl) { in_projection<&GlTable::LoadIdentity>(gl); }},
        {"load d", [](const GlTable& gl) { in_projection<&GlTable::LoadMatrixd>(gl, skewed); }},
        {"load f", [](const GlTable& gl) { in_projection<&GlTable::LoadMatrixf>(gl, skewed_f); }},
        {"mult d", [](const GlTable& gl) { in_projection<&GlTable::MultMatrixd>(gl, skewed); }},
        {"mult f", [](const GlTable& gl) { in_projection<&GlTable::MultMatrixf>(gl, skewed_f); }},
        {"load transpose d",
         [](const GlTable& gl) { in_projection<&GlTable::LoadTransposeMatrixd>(gl, skewed); }},
        {"load transpose f",
         [](const GlTable& gl) { in_projection<&GlTable::LoadTransposeMatrixf>(gl, skewed_f); }},
        {"mult transpose d",
         [](const GlTable& gl) { in_projection<&GlTable::MultTransposeMatrixd>(gl, skewed); }},
        {"mult transpose f",
         [](const GlTable& gl) { in_projection<&GlTable::MultTransposeMatrixf>(gl, skewed_f); }},
        {"rotate", [](const GlTable& gl) { in_projection<&GlTable::Rotatef>(gl, 30, 1, 1, 0); }},
        {"scale", [](const GlTable& gl) { in_projection<&GlTable::Scaled>(gl, 2, 3, 4); }},
        {"translate", [](const GlTable& gl) { in_projection<&GlTable::Translatef>(gl, 2, 3, 4); }},
        {"push", [](const GlTable& gl) { in_projection<&GlTable::PushMatrix>(gl); }, true},
        {"pop", [](const GlTable& gl) { in_projection<&GlTable::PopMatrix>(gl); }, true},
        {"named load", [](const GlTable& gl) { gl.MatrixLoaddEXT(GL_PROJECTION, skewed); }},
        {"named frustum", [](const GlTable& gl) { gl.MatrixFrustumEXT(GL_PROJECTION, -1, 1, -1, 1, 1, 9); }},
        {"named pop", [](const GlTable& gl) { gl.MatrixPopEXT(GL_PROJECTION); }, true},
        {"flush and finish", [](const GlTable& gl) { gl.Flush(), gl.Finish(); }, true},
    };
    return calls;
}

} // namespace glcast::test
