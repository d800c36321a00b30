#include "shim/record/snapshot.h"

#include <array>
#include <iterator>

#include "shim/record/packets.h"
#include "shim/record/state.h"

namespace glcast::record {

namespace {

/// What can be enabled outside of texture units. Those that come with an index (lights, planes) are added
/// below.
struct Capability {
    GLenum name;
    int since;
    const char* extension = nullptr;
};
constexpr Capability capabilities[] = {
    {GL_ALPHA_TEST, 10},
    {GL_AUTO_NORMAL, 10},
    {GL_BLEND, 10},
    {GL_COLOR_LOGIC_OP, 11},
    {GL_COLOR_SUM, 14, "GL_EXT_secondary_color"},
    {GL_CULL_FACE, 10},
    {GL_DEPTH_CLAMP, 32, "GL_ARB_depth_clamp"},
    {GL_DEPTH_TEST, 10},
    {GL_DITHER, 10},
    {GL_FOG, 10},
    {GL_FRAMEBUFFER_SRGB, 30, "GL_ARB_framebuffer_sRGB"},
    {GL_INDEX_LOGIC_OP, 10},
    {GL_LIGHTING, 10},
    {GL_LINE_SMOOTH, 10},
    {GL_LINE_STIPPLE, 10},
    {GL_MULTISAMPLE, 13, "GL_ARB_multisample"},
    {GL_NORMALIZE, 10},
    {GL_POINT_SMOOTH, 10},
    {GL_POINT_SPRITE, 20, "GL_ARB_point_sprite"},
    {GL_POLYGON_OFFSET_FILL, 11},
    {GL_POLYGON_OFFSET_LINE, 11},
    {GL_POLYGON_OFFSET_POINT, 11},
    {GL_POLYGON_SMOOTH, 10},
    {GL_POLYGON_STIPPLE, 10},
    {GL_RESCALE_NORMAL, 12},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, 13, "GL_ARB_multisample"},
    {GL_SAMPLE_ALPHA_TO_ONE, 13, "GL_ARB_multisample"},
    {GL_SAMPLE_COVERAGE, 13, "GL_ARB_multisample"},
    {GL_SCISSOR_TEST, 10},
    {GL_STENCIL_TEST, 10},
    {GL_TEXTURE_CUBE_MAP_SEAMLESS, 32, "GL_ARB_seamless_cube_map"},
    {GL_VERTEX_PROGRAM_POINT_SIZE, 20},
    {GL_VERTEX_PROGRAM_TWO_SIDE, 20},
    {GL_VERTEX_PROGRAM_ARB, 99, "GL_ARB_vertex_program"},
    {GL_FRAGMENT_PROGRAM_ARB, 99, "GL_ARB_fragment_program"},
    {GL_COLOR_MATERIAL, 10},
};

/// glPixelTransfer, with what each is at the start of a context.
constexpr GLenum pixel_transfers[] = {
    GL_MAP_COLOR,   GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET, GL_RED_SCALE,
    GL_RED_BIAS,    GL_GREEN_SCALE, GL_GREEN_BIAS,  GL_BLUE_SCALE,   GL_BLUE_BIAS,
    GL_ALPHA_SCALE, GL_ALPHA_BIAS,  GL_DEPTH_SCALE, GL_DEPTH_BIAS,
};
struct PixelMap {
    GLenum name, size;
};
constexpr PixelMap pixel_maps[] = {
    {GL_PIXEL_MAP_I_TO_I, GL_PIXEL_MAP_I_TO_I_SIZE}, {GL_PIXEL_MAP_S_TO_S, GL_PIXEL_MAP_S_TO_S_SIZE},
    {GL_PIXEL_MAP_I_TO_R, GL_PIXEL_MAP_I_TO_R_SIZE}, {GL_PIXEL_MAP_I_TO_G, GL_PIXEL_MAP_I_TO_G_SIZE},
    {GL_PIXEL_MAP_I_TO_B, GL_PIXEL_MAP_I_TO_B_SIZE}, {GL_PIXEL_MAP_I_TO_A, GL_PIXEL_MAP_I_TO_A_SIZE},
    {GL_PIXEL_MAP_R_TO_R, GL_PIXEL_MAP_R_TO_R_SIZE}, {GL_PIXEL_MAP_G_TO_G, GL_PIXEL_MAP_G_TO_G_SIZE},
    {GL_PIXEL_MAP_B_TO_B, GL_PIXEL_MAP_B_TO_B_SIZE}, {GL_PIXEL_MAP_A_TO_A, GL_PIXEL_MAP_A_TO_A_SIZE},
};

struct Asker {
    const GlTable& gl;
    GLenum enumeration(GLenum name) const { return GLenum(get_int(gl, name)); }
    GLfloat number(GLenum name) const { return numbers(name)[0]; }
    std::array<GLfloat, 16> numbers(GLenum name) const {
        std::array<GLfloat, 16> values{};
        gl.GetFloatv(name, values.data());
        return values;
    }
    std::array<GLint, 16> integers(GLenum name) const {
        std::array<GLint, 16> values{};
        gl.GetIntegerv(name, values.data());
        return values;
    }
    std::array<GLboolean, 16> booleans(GLenum name) const {
        std::array<GLboolean, 16> values{};
        gl.GetBooleanv(name, values.data());
        return values;
    }
};

void write_capability(const GlTable& gl, Stream& stream, GLenum name) {
    if (gl.IsEnabled(name))
        packets::Enable::write(stream, name);
    else
        packets::Disable::write(stream, name);
}

void write_capabilities(Context& context, Stream& stream) {
    for (const Capability& row : capabilities)
        if (context.get_limits().has(row.since, row.extension))
            write_capability(context.real, stream, row.name);
    for (int i = 0; i < context.get_limits().lights; ++i)
        write_capability(context.real, stream, GLenum(GL_LIGHT0 + i));
    for (int i = 0; i < context.get_limits().clip_planes; ++i)
        write_capability(context.real, stream, GLenum(GL_CLIP_PLANE0 + i));
}

void write_programs(Context& context, Stream& stream) {
    const Limits& limits = context.get_limits();
    if (limits.has(20)) packets::UseProgram::write(stream, GLuint(get_int(context.real, GL_CURRENT_PROGRAM)));
    if (limits.has(41, "GL_ARB_separate_shader_objects"))
        packets::BindProgramPipeline::write(stream,
                                            GLuint(get_int(context.real, GL_PROGRAM_PIPELINE_BINDING)));
}

void write_framebuffer(Context& context, Stream& stream) {
    const Asker ask{context.real};
    const Limits& limits = context.get_limits();
    if (limits.has(30, "GL_ARB_framebuffer_object")) {
        packets::BindFramebuffer::write(stream, GL_DRAW_FRAMEBUFFER,
                                        ask.enumeration(GL_DRAW_FRAMEBUFFER_BINDING));
        packets::BindFramebuffer::write(stream, GL_READ_FRAMEBUFFER,
                                        ask.enumeration(GL_READ_FRAMEBUFFER_BINDING));
    }
    if (limits.draw_buffers > 1) {
        std::vector<GLenum> buffers;
        for (int i = 0; i < limits.draw_buffers; ++i)
            buffers.push_back(ask.enumeration(GLenum(GL_DRAW_BUFFER0 + i)));
        while (buffers.size() > 1 && buffers.back() == GL_NONE) buffers.pop_back();
        if (buffers.size() > 1)
            return packets::DrawBuffers::write(stream, GLsizei(buffers.size()), buffers.data());
    }
    packets::DrawBuffer::write(
        stream, ask.enumeration(GL_DRAW_BUFFER)); // takes GL_FRONT_AND_BACK, glDrawBuffers does not
}

void write_viewport(Context& context, Stream& stream) {
    const Asker ask{context.real};
    const auto viewport = ask.integers(GL_VIEWPORT), scissor = ask.integers(GL_SCISSOR_BOX);
    packets::Viewport::write(stream, viewport[0], viewport[1], viewport[2], viewport[3]);
    packets::Scissor::write(stream, scissor[0], scissor[1], scissor[2], scissor[3]);
    GLdouble range[2] = {0, 1};
    context.real.GetDoublev(GL_DEPTH_RANGE, range);
    packets::DepthRange::write(stream, range[0], range[1]);
}

void write_rasterisation(Context& context, Stream& stream) {
    const Asker ask{context.real};
    packets::CullFace::write(stream, ask.enumeration(GL_CULL_FACE_MODE));
    packets::FrontFace::write(stream, ask.enumeration(GL_FRONT_FACE));
    packets::ShadeModel::write(stream, ask.enumeration(GL_SHADE_MODEL));
    const auto modes = ask.integers(GL_POLYGON_MODE);
    packets::PolygonMode::write(stream, GL_FRONT, GLenum(modes[0]));
    packets::PolygonMode::write(stream, GL_BACK, GLenum(modes[1]));
    if (context.get_limits().has(11))
        packets::PolygonOffset::write(stream, ask.number(GL_POLYGON_OFFSET_FACTOR),
                                      ask.number(GL_POLYGON_OFFSET_UNITS));
    GLubyte stipple[128] = {};
    {
        const DefaultPacking packing(context);
        context.real.GetPolygonStipple(stipple);
    }
    packets::PolygonStipple::write(stream, stipple);
    packets::LineWidth::write(stream, ask.number(GL_LINE_WIDTH));
    packets::LineStipple::write(stream, get_int(context.real, GL_LINE_STIPPLE_REPEAT),
                                GLushort(get_int(context.real, GL_LINE_STIPPLE_PATTERN)));
    packets::PointSize::write(stream, ask.number(GL_POINT_SIZE));
    if (context.get_limits().has(14, "GL_ARB_point_parameters"))
        for (const GLenum name : {GL_POINT_SIZE_MIN, GL_POINT_SIZE_MAX, GL_POINT_FADE_THRESHOLD_SIZE,
                                  GL_POINT_DISTANCE_ATTENUATION})
            packets::PointParameterfv::write(stream, name, ask.numbers(name).data());
    if (context.get_limits().has(20))
        packets::PointParameteri::write(stream, GL_POINT_SPRITE_COORD_ORIGIN,
                                        get_int(context.real, GL_POINT_SPRITE_COORD_ORIGIN));
    if (context.get_limits().has(32, "GL_EXT_provoking_vertex"))
        packets::ProvokingVertex::write(stream, ask.enumeration(GL_PROVOKING_VERTEX));
}

void write_blending(Context& context, Stream& stream) {
    const Asker ask{context.real};
    const Limits& limits = context.get_limits();
    if (limits.has(14))
        packets::BlendFuncSeparate::write(
            stream, ask.enumeration(GL_BLEND_SRC_RGB), ask.enumeration(GL_BLEND_DST_RGB),
            ask.enumeration(GL_BLEND_SRC_ALPHA), ask.enumeration(GL_BLEND_DST_ALPHA));
    else
        packets::BlendFunc::write(stream, ask.enumeration(GL_BLEND_SRC), ask.enumeration(GL_BLEND_DST));
    if (limits.has(20))
        packets::BlendEquationSeparate::write(stream, ask.enumeration(GL_BLEND_EQUATION_RGB),
                                              ask.enumeration(GL_BLEND_EQUATION_ALPHA));
    else if (limits.has(14))
        packets::BlendEquation::write(stream, ask.enumeration(GL_BLEND_EQUATION));
    if (limits.has(14)) {
        const auto colour = ask.numbers(GL_BLEND_COLOR);
        packets::BlendColor::write(stream, colour[0], colour[1], colour[2], colour[3]);
    }
    packets::LogicOp::write(stream, ask.enumeration(GL_LOGIC_OP_MODE));
    const auto mask = ask.booleans(GL_COLOR_WRITEMASK);
    packets::ColorMask::write(stream, mask[0], mask[1], mask[2], mask[3]);
    packets::IndexMask::write(stream, GLuint(get_int(context.real, GL_INDEX_WRITEMASK)));
    if (!limits.has(30, "GL_ARB_color_buffer_float")) return;
    for (const GLenum name : {GL_CLAMP_VERTEX_COLOR, GL_CLAMP_FRAGMENT_COLOR, GL_CLAMP_READ_COLOR})
        packets::ClampColor::write(stream, name, ask.enumeration(name));
}

void write_stencil_face(const Asker& ask, Stream& stream, GLenum face) {
    const bool back = face == GL_BACK;
    packets::StencilFuncSeparate::write(
        stream, face, ask.enumeration(back ? GL_STENCIL_BACK_FUNC : GL_STENCIL_FUNC),
        get_int(ask.gl, back ? GL_STENCIL_BACK_REF : GL_STENCIL_REF),
        ask.enumeration(back ? GL_STENCIL_BACK_VALUE_MASK : GL_STENCIL_VALUE_MASK));
    packets::StencilOpSeparate::write(
        stream, face, ask.enumeration(back ? GL_STENCIL_BACK_FAIL : GL_STENCIL_FAIL),
        ask.enumeration(back ? GL_STENCIL_BACK_PASS_DEPTH_FAIL : GL_STENCIL_PASS_DEPTH_FAIL),
        ask.enumeration(back ? GL_STENCIL_BACK_PASS_DEPTH_PASS : GL_STENCIL_PASS_DEPTH_PASS));
    packets::StencilMaskSeparate::write(
        stream, face, ask.enumeration(back ? GL_STENCIL_BACK_WRITEMASK : GL_STENCIL_WRITEMASK));
}

void write_tests(Context& context, Stream& stream) {
    const Asker ask{context.real};
    packets::AlphaFunc::write(stream, ask.enumeration(GL_ALPHA_TEST_FUNC), ask.number(GL_ALPHA_TEST_REF));
    packets::DepthFunc::write(stream, ask.enumeration(GL_DEPTH_FUNC));
    packets::DepthMask::write(stream, ask.booleans(GL_DEPTH_WRITEMASK)[0]);
    if (context.get_limits().has(20)) {
        write_stencil_face(ask, stream, GL_FRONT);
        write_stencil_face(ask, stream, GL_BACK);
        return;
    }
    packets::StencilFunc::write(stream, ask.enumeration(GL_STENCIL_FUNC), get_int(ask.gl, GL_STENCIL_REF),
                                ask.enumeration(GL_STENCIL_VALUE_MASK));
    packets::StencilOp::write(stream, ask.enumeration(GL_STENCIL_FAIL),
                              ask.enumeration(GL_STENCIL_PASS_DEPTH_FAIL),
                              ask.enumeration(GL_STENCIL_PASS_DEPTH_PASS));
    packets::StencilMask::write(stream, ask.enumeration(GL_STENCIL_WRITEMASK));
}

void write_clears(Context& context, Stream& stream) {
    const Asker ask{context.real};
    const auto colour = ask.numbers(GL_COLOR_CLEAR_VALUE), accumulation = ask.numbers(GL_ACCUM_CLEAR_VALUE);
    packets::ClearColor::write(stream, colour[0], colour[1], colour[2], colour[3]);
    packets::ClearAccum::write(stream, accumulation[0], accumulation[1], accumulation[2], accumulation[3]);
    GLdouble depth = 1;
    context.real.GetDoublev(GL_DEPTH_CLEAR_VALUE, &depth);
    packets::ClearDepth::write(stream, depth);
    packets::ClearStencil::write(stream, get_int(context.real, GL_STENCIL_CLEAR_VALUE));
    packets::ClearIndex::write(stream, ask.number(GL_INDEX_CLEAR_VALUE));
}

void write_fog(Context& context, Stream& stream) {
    const Asker ask{context.real};
    packets::Fogi::write(stream, GL_FOG_MODE, get_int(context.real, GL_FOG_MODE));
    for (const GLenum name : {GL_FOG_DENSITY, GL_FOG_START, GL_FOG_END, GL_FOG_INDEX})
        packets::Fogf::write(stream, name, ask.number(name));
    packets::Fogfv::write(stream, GL_FOG_COLOR, ask.numbers(GL_FOG_COLOR).data());
    if (context.get_limits().has(14, "GL_EXT_fog_coord"))
        packets::Fogi::write(stream, GL_FOG_COORD_SRC, get_int(context.real, GL_FOG_COORD_SRC));
}

void write_pixels(Context& context, Stream& stream) {
    const Asker ask{context.real};
    for (const GLenum name : pixel_transfers) packets::PixelTransferf::write(stream, name, ask.number(name));
    packets::PixelZoom::write(stream, ask.number(GL_ZOOM_X), ask.number(GL_ZOOM_Y));
    const DefaultPacking packing(context);
    for (const PixelMap& row : pixel_maps) {
        std::vector<GLfloat> values(std::size_t(std::max(get_int(context.real, row.size, 1), 1)));
        context.real.GetPixelMapfv(row.name, values.data());
        packets::PixelMapfv::write(stream, row.name, GLsizei(values.size()), values.data());
    }
}

void write_raster_position(Context& context, Stream& stream) {
    const Asker ask{context.real};
    if (!context.get_limits().has(14) || !ask.booleans(GL_CURRENT_RASTER_POSITION_VALID)[0]) return;
    const auto colour = ask.numbers(GL_CURRENT_RASTER_COLOR),
               position = ask.numbers(GL_CURRENT_RASTER_POSITION);
    packets::DepthRange::write(stream, 0,
                               1); // glWindowPos takes a depth from 0 to 1 and fits it into the range
    packets::Color4fv::write(stream, colour.data());
    packets::WindowPos3fv::write(stream, position.data());
}

void write_current_values(Context& context, Stream& stream) {
    const Asker ask{context.real};
    const Limits& limits = context.get_limits();
    packets::Color4fv::write(stream, ask.numbers(GL_CURRENT_COLOR).data());
    packets::Normal3fv::write(stream, ask.numbers(GL_CURRENT_NORMAL).data());
    packets::Indexf::write(stream, ask.number(GL_CURRENT_INDEX));
    packets::EdgeFlag::write(stream, ask.booleans(GL_EDGE_FLAG)[0]);
    if (limits.has(14, "GL_EXT_secondary_color"))
        packets::SecondaryColor3fv::write(stream, ask.numbers(GL_CURRENT_SECONDARY_COLOR).data());
    if (limits.has(14, "GL_EXT_fog_coord"))
        packets::FogCoordf::write(stream, ask.number(GL_CURRENT_FOG_COORD));
}

/// The modelview as it must be for what is given in eye space.
class IdentityModelview {
  public:
    IdentityModelview(Context& context, Stream& out, bool at_start)
        : stream(out), keep(!at_start), mode(GLenum(get_int(context.real, GL_MATRIX_MODE))) {
        packets::MatrixMode::write(stream, GL_MODELVIEW);
        if (keep) packets::PushMatrix::write(stream);
        packets::LoadIdentity::write(stream);
    }
    void end() {
        if (keep) packets::PopMatrix::write(stream);
        packets::MatrixMode::write(stream, mode);
    }

  private:
    Stream& stream;
    bool keep;
    GLenum mode;
};

} // namespace

DefaultPacking::DefaultPacking(Context& of) : context(of) {
    static constexpr GLint defaults[count][2] = {
        {GL_PACK_SWAP_BYTES, 0},  {GL_PACK_LSB_FIRST, 0}, {GL_PACK_ROW_LENGTH, 0},  {GL_PACK_SKIP_ROWS, 0},
        {GL_PACK_SKIP_PIXELS, 0}, {GL_PACK_ALIGNMENT, 1}, {GL_PACK_SKIP_IMAGES, 0}, {GL_PACK_IMAGE_HEIGHT, 0},
    };
    const GlTable& gl = context.real;
    // The stack keeps a buffer that another context has deleted, which no name binds again.
    is_pushed = context.get_limits().compatibility &&
                get_int(gl, GL_CLIENT_ATTRIB_STACK_DEPTH) < get_int(gl, GL_MAX_CLIENT_ATTRIB_STACK_DEPTH);
    if (is_pushed) gl.PushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    const int known = context.get_limits().has(12) ? count : count - 2;
    for (int i = 0; i < known; ++i) {
        before[i] = get_int(gl, GLenum(defaults[i][0]));
        gl.PixelStorei(GLenum(defaults[i][0]), defaults[i][1]);
    }
    if (!context.get_limits().has(21)) return;
    buffer = GLuint(get_int(gl, GL_PIXEL_PACK_BUFFER_BINDING));
    if (buffer) gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

DefaultPacking::~DefaultPacking() {
    static constexpr GLenum names[count] = {GL_PACK_SWAP_BYTES,  GL_PACK_LSB_FIRST,   GL_PACK_ROW_LENGTH,
                                            GL_PACK_SKIP_ROWS,   GL_PACK_SKIP_PIXELS, GL_PACK_ALIGNMENT,
                                            GL_PACK_SKIP_IMAGES, GL_PACK_IMAGE_HEIGHT};
    if (is_pushed) {
        context.real.PopClientAttrib();
        return;
    }
    const int known = context.get_limits().has(12) ? count : count - 2;
    for (int i = 0; i < known; ++i) context.real.PixelStorei(names[i], before[i]);
    if (buffer) context.real.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
}

void write_state(Context& context, Stream& stream, bool at_start) {
    IdentityModelview modelview(context, stream, at_start);
    packets::Disable::write(stream, GL_COLOR_MATERIAL); // else setting colours would set materials
    write_programs(context, stream);
    write_framebuffer(context, stream);
    write_lights(context, stream);
    write_fog(context, stream);
    write_pixels(context, stream);
    write_textures(context, stream);
    write_default_textures(context, stream);
    write_evaluators(context, stream);
    write_raster_position(context, stream);
    write_viewport(context, stream);
    write_rasterisation(context, stream);
    write_blending(context, stream);
    write_tests(context, stream);
    write_clears(context, stream);
    write_current_values(context, stream);
    write_capabilities(context, stream);
    packets::ListBase::write(stream, GLuint(get_int(context.real, GL_LIST_BASE)));
    modelview.end();
}

void read_matrices(Context& context, Recording& recording) {
    const GlTable& gl = context.real;
    Frame& frame = *recording.frame;
    const Limits& limits = context.get_limits();
    frame.version = limits.version;
    frame.has_multitexture = limits.has(13);
    frame.matrix_mode = GLenum(get_int(gl, GL_MATRIX_MODE, GL_MODELVIEW));
    if (frame.has_multitexture) frame.active_texture = GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0));
    static constexpr Matrix identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const int stacks = int(Stack::texture0) + limits.texture_coords;
    for (int stack = 0; stack < stacks; ++stack) {
        if (Stack(stack) == Stack::colour && !limits.has(99, "GL_ARB_imaging")) continue;
        const int unit = stack - int(Stack::texture0);
        if (unit >= 0 && frame.has_multitexture) gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        const StackNames names = stack_names(stack);
        const auto depth = std::size_t(std::max(get_int(gl, names.depth, 1), 1));
        frame.stacks[stack].assign(depth, identity);
        gl.GetFloatv(names.matrix, frame.stacks[stack].back().m);
        recording.lowest[stack] = int(depth);
        recording.has_unread_matrices |= depth > 1;
    }
    if (frame.has_multitexture) gl.ActiveTexture(frame.active_texture);
    recording.attrib_depth = get_int(gl, GL_ATTRIB_STACK_DEPTH);
}

} // namespace glcast::record
