#include "tests/preload/state/hostile_state.h"

#include <cstring>
#include <vector>

namespace glcast::test {
namespace {

alignas(16) char memory[1 << 16];

float number(int i) { return 0.25f + 0.0625f * float(i % 11); }
std::vector<GLfloat> numbers(std::size_t n, int seed) {
    std::vector<GLfloat> all(n);
    for (std::size_t i = 0; i < n; ++i) all[i] = number(int(i) + seed);
    return all;
}

void set_lights(const GlTable& gl) {
    for (int i = 0; i < 8; ++i) {
        const auto light = GLenum(GL_LIGHT0 + i);
        for (const GLenum name : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_POSITION, GL_SPOT_DIRECTION})
            gl.Lightfv(light, name, numbers(4, i + int(name)).data());
        gl.Lightf(light, GL_SPOT_EXPONENT, float(3 + i));
        gl.Lightf(light, GL_SPOT_CUTOFF, float(30 + i));
        gl.Lightf(light, GL_LINEAR_ATTENUATION, number(i));
        if (i % 2) gl.Enable(light);
    }
    gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, numbers(4, 1).data());
    gl.LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
    gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
    for (const GLenum face : {GL_FRONT, GL_BACK})
        for (const GLenum name : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION})
            gl.Materialfv(face, name, numbers(4, int(face + name)).data());
    gl.Materialf(GL_BACK, GL_SHININESS, 17);
    gl.ColorMaterial(GL_BACK, GL_SPECULAR);
}

void set_evaluators(const GlTable& gl) {
    gl.Map1f(GL_MAP1_VERTEX_3, 0.25f, 2, 3, 4, numbers(12, 1).data());
    gl.Map1f(GL_MAP1_COLOR_4, 0, 3, 4, 2, numbers(8, 2).data());
    gl.Map2f(GL_MAP2_VERTEX_4, 0, 2, 4, 3, 1, 2, 12, 2, numbers(24, 3).data());
    gl.Map2f(GL_MAP2_NORMAL, 0, 2, 3, 2, 1, 2, 6, 2, numbers(12, 3).data());
    gl.MapGrid1f(7, 0.5f, 3);
    gl.MapGrid2f(3, 0.5f, 3, 9, 1, 4);
    for (const GLenum what : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
        gl.Enable(what);
}

void set_pixels(const GlTable& gl) {
    for (const GLenum name :
         {GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_UNPACK_IMAGE_HEIGHT})
        gl.PixelStorei(name, 70);
    for (const GLenum name :
         {GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_UNPACK_SKIP_ROWS,
          GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,
          GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
        gl.PixelStorei(name, 1);
    for (const GLenum name : {GL_RED_SCALE, GL_GREEN_BIAS, GL_ALPHA_SCALE, GL_DEPTH_SCALE, GL_DEPTH_BIAS})
        gl.PixelTransferf(name, 0.75f);
    gl.PixelTransferi(GL_INDEX_SHIFT, 2), gl.PixelTransferi(GL_MAP_COLOR, 1);
    gl.PixelMapfv(GL_PIXEL_MAP_R_TO_R, 8, numbers(8, 5).data());
    gl.PixelMapfv(GL_PIXEL_MAP_I_TO_A, 4, numbers(4, 5).data());
    gl.PixelZoom(-2, 3);
}

void set_texture(const GlTable& gl, GLenum target, int seed) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    gl.BindTexture(target, name);
    static const GLubyte texels[4 * 4 * 4 * 4] = {1, 2, 3, 4, 200, 100, 50, 25, 9, 8, 7, 6};
    for (const GLenum unpack :
         {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES})
        gl.PixelStorei(unpack, 0);
    if (target == GL_TEXTURE_1D) gl.TexImage1D(target, 0, GL_RGBA, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    if (target == GL_TEXTURE_2D || target == GL_TEXTURE_RECTANGLE)
        gl.TexImage2D(target, 0, GL_RGBA8, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    if (target == GL_TEXTURE_3D)
        gl.TexImage3D(target, 0, GL_RGB, 4, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    for (int face = 0; target == GL_TEXTURE_CUBE_MAP && face < 6; ++face)
        gl.TexImage2D(GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face), 0, GL_LUMINANCE8, 4, 4, 0, GL_RGBA,
                      GL_UNSIGNED_BYTE, texels);
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameterfv(target, GL_TEXTURE_BORDER_COLOR, numbers(4, seed).data());
    gl.TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameterf(target, GL_TEXTURE_PRIORITY, 0.5f);
    gl.TexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
}

void set_textures(const GlTable& gl, bool fill_0) {
    constexpr GLenum targets[] = {GL_TEXTURE_2D, GL_TEXTURE_1D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
                                  GL_TEXTURE_RECTANGLE};
    for (int unit = 7; unit >= 0; --unit) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        set_texture(gl, targets[unit % 5], unit);
        gl.Enable(targets[unit % 5]);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, unit % 2 ? GL_COMBINE : GL_DECAL);
        gl.TexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, numbers(4, unit).data());
        gl.TexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_SRC1_ALPHA, GL_CONSTANT);
        gl.TexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2);
        gl.TexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, 0.5f);
        gl.TexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, unit % 2);
        for (const GLenum coordinate : {GL_S, GL_T}) {
            gl.TexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
            gl.TexGenfv(coordinate, GL_OBJECT_PLANE, numbers(4, unit).data());
            gl.TexGenfv(coordinate, GL_EYE_PLANE, numbers(4, unit + 3).data());
        }
        gl.Enable(GL_TEXTURE_GEN_S);
        gl.MultiTexCoord4fv(GLenum(GL_TEXTURE0 + unit), numbers(4, unit).data());
        gl.MatrixMode(GL_TEXTURE);
        gl.PushMatrix(), gl.Scalef(2, 3, number(unit)), gl.PushMatrix(), gl.Translatef(1, 2, 3);
    }
    // The texture named 0, which contexts may share or not.
    gl.ActiveTexture(GL_TEXTURE3);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    static const GLubyte own[16] = {255, 1, 2, 3};
    if (fill_0) gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, own);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_MIRRORED_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
    gl.ActiveTexture(GL_TEXTURE5);
    GLuint sampler = 0;
    gl.GenSamplers(1, &sampler);
    gl.SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.BindSampler(2, sampler);
}

void set_fragments(const GlTable& gl) {
    gl.Enable(GL_BLEND), gl.BlendFuncSeparate(GL_ONE, GL_CONSTANT_ALPHA, GL_ZERO, GL_SRC_ALPHA);
    gl.BlendFunci(1, GL_ZERO, GL_ONE), gl.BlendEquationi(2, GL_MAX), gl.Disablei(GL_BLEND, 3);
    gl.BlendEquationSeparate(GL_FUNC_SUBTRACT, GL_MIN), gl.BlendColor(0.1f, 0.2f, 0.3f, 0.4f);
    gl.Enable(GL_ALPHA_TEST), gl.AlphaFunc(GL_GEQUAL, 0.25f), gl.LogicOp(GL_XOR);
    gl.ColorMask(1, 0, 1, 0), gl.ColorMaski(2, 0, 1, 0, 1), gl.IndexMask(0x55), gl.DepthMask(0),
        gl.DepthFunc(GL_NOTEQUAL);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFuncSeparate(GL_FRONT, GL_LESS, 3, 7), gl.StencilFuncSeparate(GL_BACK, GL_EQUAL, 5, 15);
    gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_INCR, GL_DECR_WRAP), gl.StencilMaskSeparate(GL_BACK, 0x0F);
    gl.ClearColor(0.5f, 0.25f, 0.125f, 1), gl.ClearDepth(0.5), gl.ClearStencil(9), gl.ClearIndex(4);
    gl.ClearAccum(0.5f, -0.5f, 0.25f, 1);
    gl.Enable(GL_SCISSOR_TEST), gl.Scissor(3, 4, 50, 60), gl.ScissorIndexed(2, 1, 2, 3, 4);
    gl.Viewport(2, 3, 70, 80), gl.ViewportIndexedf(3, 1, 2, 3, 4), gl.DepthRange(0.75, 0.125),
        gl.DepthRangeIndexed(1, 0.5, 0.25);
    gl.Enable(GL_FOG), gl.Fogi(GL_FOG_MODE, GL_LINEAR), gl.Fogf(GL_FOG_END, 7),
        gl.Fogfv(GL_FOG_COLOR, numbers(4, 3).data());
    gl.Fogi(GL_FOG_COORD_SRC, GL_FOG_COORD), gl.Fogf(GL_FOG_DENSITY, 0.5f);
    gl.SampleCoverage(0.5f, GL_TRUE), gl.Enable(GL_SAMPLE_ALPHA_TO_ONE), gl.SampleMaski(0, 0xF0),
        gl.MinSampleShading(0.5f);
    gl.ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE), gl.Disable(GL_DITHER), gl.Enable(GL_FRAMEBUFFER_SRGB);
}

void set_primitives(const GlTable& gl) {
    gl.PolygonMode(GL_FRONT, GL_LINE), gl.PolygonMode(GL_BACK, GL_POINT), gl.PolygonOffset(2, 3);
    gl.Enable(GL_POLYGON_OFFSET_LINE), gl.Enable(GL_CULL_FACE), gl.CullFace(GL_FRONT_AND_BACK),
        gl.FrontFace(GL_CW);
    GLubyte stipple[4 * 128] = {};
    std::memset(stipple, 0xA5, sizeof stipple);
    gl.PolygonStipple(stipple);
    gl.LineWidth(3), gl.LineStipple(4, 0xABCD), gl.Enable(GL_LINE_STIPPLE), gl.ShadeModel(GL_FLAT);
    gl.PointSize(5), gl.PointParameterf(GL_POINT_SIZE_MIN, 2),
        gl.PointParameterfv(GL_POINT_DISTANCE_ATTENUATION, numbers(3, 1).data());
    gl.PointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_LOWER_LEFT), gl.Enable(GL_POINT_SPRITE);
    gl.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION), gl.Enable(GL_PRIMITIVE_RESTART),
        gl.PrimitiveRestartIndex(4711);
    for (int i = 0; i < 6; i += 2) {
        const GLdouble plane[] = {1, 2, 3, double(i)};
        gl.ClipPlane(GLenum(GL_CLIP_PLANE0 + i), plane), gl.Enable(GLenum(GL_CLIP_PLANE0 + i));
    }
    for (const GLenum hint : {GL_FOG_HINT, GL_LINE_SMOOTH_HINT, GL_PERSPECTIVE_CORRECTION_HINT})
        gl.Hint(hint, GL_NICEST);
    gl.Color4f(0.1f, 0.9f, 0.3f, 0.7f), gl.SecondaryColor3f(0.3f, 0.2f, 0.1f), gl.FogCoordf(3),
        gl.Normal3f(0.5f, 0.25f, 1);
    gl.Indexi(9), gl.EdgeFlag(GL_FALSE), gl.RasterPos3f(0.1f, 0.2f, 0.3f), gl.WindowPos2i(33, 44);
    for (GLuint i = 1; i < 16; ++i) gl.VertexAttrib4fv(i, numbers(4, int(i)).data());
    gl.PatchParameteri(GL_PATCH_VERTICES, 5);
}

GLuint make_buffer(const GlTable& gl, GLenum target, GLsizeiptr bytes) {
    GLuint name = 0;
    gl.GenBuffers(1, &name), gl.BindBuffer(target, name),
        gl.BufferData(target, bytes, memory, GL_STREAM_COPY);
    return name;
}

void set_arrays(const GlTable& gl) {
    for (std::size_t i = 0; i < sizeof memory; ++i) memory[i] = char(i * 7);
    gl.SelectBuffer(128, reinterpret_cast<GLuint*>(memory + 40000));
    gl.FeedbackBuffer(128, GL_3D_COLOR, reinterpret_cast<GLfloat*>(memory + 50000));
    gl.VertexPointer(3, GL_FLOAT, 24, memory + 16), gl.NormalPointer(GL_SHORT, 12, memory + 1600);
    gl.ColorPointer(3, GL_UNSIGNED_SHORT, 8, memory + 3200), gl.EnableClientState(GL_COLOR_ARRAY);
    gl.PushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
    GLuint array = 0;
    gl.GenVertexArrays(1, &array), gl.BindVertexArray(array);
    for (const GLenum target :
         {GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER,
          GL_UNIFORM_BUFFER, GL_TEXTURE_BUFFER, GL_TRANSFORM_FEEDBACK_BUFFER, GL_ELEMENT_ARRAY_BUFFER})
        make_buffer(gl, target, 4096 + GLsizeiptr(target % 64));
    const GLuint vertices = make_buffer(gl, GL_ARRAY_BUFFER, 8192);
    gl.BindBufferRange(GL_UNIFORM_BUFFER, 2, vertices, 256, 512);
    gl.VertexPointer(4, GL_DOUBLE, 40, nullptr), gl.EnableClientState(GL_VERTEX_ARRAY);
    for (int unit = 0; unit < 8; ++unit) {
        gl.ClientActiveTexture(GLenum(GL_TEXTURE0 + unit));
        gl.TexCoordPointer(1 + unit % 4, GL_FLOAT, 16, reinterpret_cast<void*>(std::size_t(unit) * 8));
        if (unit % 3 == 0) gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
    }
    gl.ClientActiveTexture(GL_TEXTURE6);
    for (GLuint i = 2; i < 12; i += 3) {
        gl.VertexAttribPointer(i, 3, GL_SHORT, GL_TRUE, 16, reinterpret_cast<void*>(std::size_t(i) * 4));
        gl.VertexAttribDivisor(i, i), gl.EnableVertexAttribArray(i);
    }
    gl.PushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT), gl.PixelStorei(GL_PACK_ALIGNMENT, 8);
}

GLuint make_shader_program(const GlTable& gl) {
    const char* source = "uniform vec4 u; void main() { gl_FragColor = u; }";
    const GLuint shader = gl.CreateShader(GL_FRAGMENT_SHADER), program = gl.CreateProgram();
    gl.ShaderSource(shader, 1, &source, nullptr), gl.CompileShader(shader);
    gl.AttachShader(program, shader), gl.LinkProgram(program), gl.UseProgram(program);
    gl.Uniform4f(0, 1, 2, 3, 4);
    return program;
}

void set_programs(const GlTable& gl) {
    make_shader_program(gl);
    const char* sources[] = {"!!ARBvp1.0\nMOV result.position, vertex.position;\nEND",
                             "!!ARBfp1.0\nMOV result.color, fragment.color;\nEND"};
    int i = 0;
    for (const GLenum target : {GL_VERTEX_PROGRAM_ARB, GL_FRAGMENT_PROGRAM_ARB}) {
        GLuint name = 0;
        gl.GenProgramsARB(1, &name), gl.BindProgramARB(target, name);
        gl.ProgramStringARB(target, GL_PROGRAM_FORMAT_ASCII_ARB, GLsizei(std::strlen(sources[i])),
                            sources[i]);
        gl.ProgramEnvParameter4fvARB(target, 3, numbers(4, 1).data());
        gl.ProgramLocalParameter4fvARB(target, 5, numbers(4, 7).data());
        gl.Enable(target);
        ++i;
    }
}

void set_framebuffers(const GlTable& gl) {
    GLuint frame = 0, render = 0, colour = 0;
    gl.GenFramebuffers(1, &frame), gl.GenRenderbuffers(1, &render), gl.GenTextures(1, &colour);
    gl.BindTexture(GL_TEXTURE_1D_ARRAY, colour);
    gl.BindRenderbuffer(GL_RENDERBUFFER, render);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 32, 32);
    gl.BindFramebuffer(GL_FRAMEBUFFER, frame);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, render);
    gl.DrawBuffer(GL_COLOR_ATTACHMENT1), gl.ReadBuffer(GL_NONE);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl.DrawBuffer(GL_BACK);
}

void set_queries(const GlTable& gl) {
    GLuint names[2] = {};
    gl.GenQueries(2, names);
    gl.BeginQuery(GL_SAMPLES_PASSED, names[0]), gl.EndQuery(GL_SAMPLES_PASSED);
    gl.BeginQuery(GL_PRIMITIVES_GENERATED, names[1]), gl.EndQuery(GL_PRIMITIVES_GENERATED);
}

void set_stacks(const GlTable& gl) {
    for (const GLenum mode : {GL_PROJECTION, GL_MODELVIEW}) {
        gl.MatrixMode(mode);
        for (int i = 0; i < 3; ++i)
            gl.PushMatrix(), gl.Rotatef(10.f + float(i), 1, 2, 3), gl.Translatef(0.1f, 0.2f, number(i));
    }
    gl.MatrixMode(GL_TEXTURE);
    gl.PushAttrib(GL_ALL_ATTRIB_BITS);
}

void set_lists(const GlTable& gl) {
    for (GLuint list = 11; list < 15; ++list) {
        gl.NewList(list, GL_COMPILE);
        gl.Color3f(1, 0, 0), gl.CallList(list + 1), gl.Enable(GL_NORMALIZE);
        gl.EndList();
    }
    gl.ListBase(77);
}

} // namespace

Memory client_memory() { return {memory, sizeof memory}; }

void set_hostile_state(const GlTable& gl, bool fill_0) {
    set_lights(gl);
    set_evaluators(gl);
    set_primitives(gl);
    set_fragments(gl);
    set_textures(gl, fill_0);
    set_stacks(gl);
    set_pixels(gl);
    set_arrays(gl);
    set_lists(gl);
    set_queries(gl);
    set_framebuffers(gl);
    set_programs(gl);
    gl.PushAttrib(GL_LIGHTING_BIT | GL_VIEWPORT_BIT);
    gl.LineWidth(2), gl.Viewport(1, 2, 30, 40);
}

} // namespace glcast::test
