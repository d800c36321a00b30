#include "tests/record/state_dump.h"

#include <sstream>

namespace glcast::test {

namespace {

struct Name {
    const char* text;
    GLenum value;
    int count = 1;
};
#define N(name)                                                                                              \
    { #name, GL_##name }
#define NS(name, count)                                                                                      \
    { #name, GL_##name, count }

constexpr Name server[] = {
    N(ACCUM_CLEAR_VALUE),
    N(ALPHA_TEST_FUNC),
    N(ALPHA_TEST_REF),
    N(ATTRIB_STACK_DEPTH),
    N(BLEND_SRC_RGB),
    N(BLEND_DST_RGB),
    N(BLEND_SRC_ALPHA),
    N(BLEND_DST_ALPHA),
    NS(BLEND_COLOR, 4),
    N(BLEND_EQUATION_RGB),
    N(BLEND_EQUATION_ALPHA),
    NS(COLOR_CLEAR_VALUE, 4),
    N(COLOR_MATERIAL_FACE),
    N(COLOR_MATERIAL_PARAMETER),
    NS(COLOR_WRITEMASK, 4),
    N(CULL_FACE_MODE),
    NS(CURRENT_COLOR, 4),
    N(CURRENT_INDEX),
    NS(CURRENT_NORMAL, 3),
    NS(CURRENT_RASTER_COLOR, 4),
    NS(CURRENT_RASTER_POSITION, 3),
    N(CURRENT_RASTER_POSITION_VALID),
    NS(CURRENT_SECONDARY_COLOR, 3),
    N(CURRENT_FOG_COORD),
    N(CURRENT_PROGRAM),
    N(DEPTH_CLEAR_VALUE),
    N(DEPTH_FUNC),
    NS(DEPTH_RANGE, 2),
    N(DEPTH_WRITEMASK),
    N(DRAW_BUFFER),
    N(EDGE_FLAG),
    NS(FOG_COLOR, 4),
    N(FOG_DENSITY),
    N(FOG_END),
    N(FOG_INDEX),
    N(FOG_MODE),
    N(FOG_START),
    N(FOG_COORD_SRC),
    N(FRONT_FACE),
    N(INDEX_CLEAR_VALUE),
    N(INDEX_WRITEMASK),
    NS(LIGHT_MODEL_AMBIENT, 4),
    N(LIGHT_MODEL_COLOR_CONTROL),
    N(LIGHT_MODEL_LOCAL_VIEWER),
    N(LIGHT_MODEL_TWO_SIDE),
    N(LINE_STIPPLE_PATTERN),
    N(LINE_STIPPLE_REPEAT),
    N(LINE_WIDTH),
    N(LIST_BASE),
    N(LIST_INDEX),
    N(LOGIC_OP_MODE),
    NS(MAP1_GRID_DOMAIN, 2),
    N(MAP1_GRID_SEGMENTS),
    NS(MAP2_GRID_DOMAIN, 4),
    NS(MAP2_GRID_SEGMENTS, 2),
    N(MATRIX_MODE),
    NS(MODELVIEW_MATRIX, 16),
    N(MODELVIEW_STACK_DEPTH),
    N(POINT_SIZE),
    N(POINT_SIZE_MIN),
    N(POINT_SIZE_MAX),
    N(POINT_FADE_THRESHOLD_SIZE),
    NS(POINT_DISTANCE_ATTENUATION, 3),
    NS(POLYGON_MODE, 2),
    N(POLYGON_OFFSET_FACTOR),
    N(POLYGON_OFFSET_UNITS),
    NS(PROJECTION_MATRIX, 16),
    N(PROJECTION_STACK_DEPTH),
    N(RENDER_MODE),
    N(MAP_COLOR),
    N(RED_SCALE),
    N(RED_BIAS),
    N(ALPHA_BIAS),
    N(DEPTH_SCALE),
    N(INDEX_SHIFT),
    N(PIXEL_MAP_R_TO_R_SIZE),
    NS(SCISSOR_BOX, 4),
    N(SHADE_MODEL),
    N(STENCIL_CLEAR_VALUE),
    N(STENCIL_FAIL),
    N(STENCIL_FUNC),
    N(STENCIL_PASS_DEPTH_FAIL),
    N(STENCIL_PASS_DEPTH_PASS),
    N(STENCIL_REF),
    N(STENCIL_VALUE_MASK),
    N(STENCIL_WRITEMASK),
    N(STENCIL_BACK_FAIL),
    N(STENCIL_BACK_FUNC),
    N(STENCIL_BACK_REF),
    N(STENCIL_BACK_VALUE_MASK),
    N(STENCIL_BACK_WRITEMASK),
    NS(VIEWPORT, 4),
    N(ZOOM_X),
    N(ZOOM_Y),
    N(ACTIVE_TEXTURE),
    N(DRAW_FRAMEBUFFER_BINDING),
    N(READ_FRAMEBUFFER_BINDING),
    N(CLAMP_VERTEX_COLOR),
    N(CLAMP_FRAGMENT_COLOR),
    N(PROVOKING_VERTEX),
    N(POINT_SPRITE_COORD_ORIGIN),
};
constexpr Name client_state[] = {
    N(READ_BUFFER),
    N(CLIENT_ATTRIB_STACK_DEPTH),
    N(CLIENT_ACTIVE_TEXTURE),
    N(ARRAY_BUFFER_BINDING),
    N(ELEMENT_ARRAY_BUFFER_BINDING),
    N(PIXEL_PACK_BUFFER_BINDING),
    N(PIXEL_UNPACK_BUFFER_BINDING),
    N(VERTEX_ARRAY_BINDING),
    N(PACK_ALIGNMENT),
    N(PACK_ROW_LENGTH),
    N(PACK_SKIP_PIXELS),
    N(PACK_SKIP_ROWS),
    N(PACK_SWAP_BYTES),
    N(PACK_LSB_FIRST),
    N(PACK_SKIP_IMAGES),
    N(PACK_IMAGE_HEIGHT),
    N(UNPACK_ALIGNMENT),
    N(UNPACK_ROW_LENGTH),
    N(UNPACK_SKIP_PIXELS),
    N(UNPACK_SKIP_ROWS),
    N(VERTEX_ARRAY_SIZE),
    N(VERTEX_ARRAY_STRIDE),
    N(VERTEX_ARRAY_BUFFER_BINDING),
    N(NORMAL_ARRAY_STRIDE),
    N(COLOR_ARRAY_SIZE),
    N(TEXTURE_COORD_ARRAY_SIZE),
};
constexpr Name switches[] = {
    N(ALPHA_TEST),     N(AUTO_NORMAL),
    N(BLEND),          N(COLOR_LOGIC_OP),
    N(COLOR_MATERIAL), N(COLOR_SUM),
    N(CULL_FACE),      N(DEPTH_TEST),
    N(DITHER),         N(FOG),
    N(LIGHTING),       N(LINE_SMOOTH),
    N(LINE_STIPPLE),   N(MULTISAMPLE),
    N(NORMALIZE),      N(POINT_SMOOTH),
    N(POINT_SPRITE),   N(POLYGON_OFFSET_FILL),
    N(POLYGON_SMOOTH), N(POLYGON_STIPPLE),
    N(RESCALE_NORMAL), N(SCISSOR_TEST),
    N(STENCIL_TEST),   N(LIGHT0),
    N(LIGHT1),         N(LIGHT7),
    N(CLIP_PLANE0),    N(CLIP_PLANE5),
    N(MAP1_VERTEX_3),  N(MAP2_VERTEX_3),
    N(MAP2_COLOR_4),
};
constexpr Name client_switches[] = {N(VERTEX_ARRAY), N(NORMAL_ARRAY), N(COLOR_ARRAY), N(TEXTURE_COORD_ARRAY)};
constexpr Name unit_switches[] = {N(TEXTURE_1D),    N(TEXTURE_2D),    N(TEXTURE_3D),    N(TEXTURE_CUBE_MAP),
                                  N(TEXTURE_GEN_S), N(TEXTURE_GEN_T), N(TEXTURE_GEN_R), N(TEXTURE_GEN_Q)};
constexpr Name unit_values[] = {N(TEXTURE_BINDING_1D),        N(TEXTURE_BINDING_2D),  N(TEXTURE_BINDING_3D),
                                N(TEXTURE_BINDING_CUBE_MAP),  N(TEXTURE_STACK_DEPTH), NS(TEXTURE_MATRIX, 16),
                                NS(CURRENT_TEXTURE_COORDS, 4)};
constexpr Name environment[] = {
    N(TEXTURE_ENV_MODE), NS(TEXTURE_ENV_COLOR, 4), N(COMBINE_RGB), N(COMBINE_ALPHA),
    N(SRC0_RGB),         N(OPERAND0_RGB),          N(RGB_SCALE),   N(ALPHA_SCALE)};
constexpr Name light[] = {NS(AMBIENT, 4),  NS(DIFFUSE, 4),          NS(SPECULAR, 4),
                          NS(POSITION, 4), NS(SPOT_DIRECTION, 3),   N(SPOT_EXPONENT),
                          N(SPOT_CUTOFF),  N(CONSTANT_ATTENUATION), N(LINEAR_ATTENUATION)};
constexpr Name material[] = {NS(AMBIENT, 4), NS(DIFFUSE, 4), NS(SPECULAR, 4), NS(EMISSION, 4), N(SHININESS)};
constexpr Name texture[] = {N(TEXTURE_MIN_FILTER),       N(TEXTURE_MAG_FILTER), N(TEXTURE_WRAP_S),
                            NS(TEXTURE_BORDER_COLOR, 4), N(TEXTURE_MAX_LEVEL),  N(GENERATE_MIPMAP)};

void dump_units(const GlTable& gl, State& state) {
    GLint before = 0;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &before);
    for (int unit = 0; unit < 8; ++unit) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        const std::string prefix = "unit " + std::to_string(unit) + " ";
        for (const Name& name : unit_switches) state[prefix + name.text] = {double(gl.IsEnabled(name.value))};
        for (const Name& name : unit_values)
            gl.GetDoublev(name.value,
                          (state[prefix + name.text].resize(16), state[prefix + name.text].data()));
        for (const Name& name : environment) {
            GLfloat values[4] = {};
            gl.GetTexEnvfv(GL_TEXTURE_ENV, name.value, values);
            state[prefix + name.text] = {values, values + 4};
        }
        for (const GLenum s : {GL_S, GL_T, GL_R, GL_Q})
            for (const GLenum what : {GL_TEXTURE_GEN_MODE, GL_OBJECT_PLANE, GL_EYE_PLANE}) {
                GLdouble values[4] = {};
                gl.GetTexGendv(s, what, values);
                state[prefix + "generation " + std::to_string(s) + " " + std::to_string(what)] = {values,
                                                                                                  values + 4};
            }
    }
    gl.ActiveTexture(GLenum(before));
}

void dump_objects(const GlTable& gl, State& state) {
    GLfloat values[4] = {};
    for (int i = 0; i < 8; ++i)
        for (const Name& name : light) {
            gl.GetLightfv(GLenum(GL_LIGHT0 + i), name.value, values);
            state["light " + std::to_string(i) + " " + name.text] = {values, values + name.count};
        }
    for (const GLenum face : {GL_FRONT, GL_BACK})
        for (const Name& name : material) {
            gl.GetMaterialfv(face, name.value, values);
            state["material " + std::to_string(face) + " " + name.text] = {values, values + name.count};
        }
    for (int i = 0; i < 6; ++i) {
        GLdouble plane[4] = {};
        gl.GetClipPlane(GLenum(GL_CLIP_PLANE0 + i), plane);
        state["plane " + std::to_string(i)] = {plane, plane + 4};
    }
    for (const Name& name : texture) {
        gl.GetTexParameterfv(GL_TEXTURE_2D, name.value, values);
        state[std::string("texture ") + name.text] = {values, values + name.count};
    }
    for (const GLenum map : {GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3, GL_MAP2_COLOR_4}) {
        std::vector<GLdouble> points(512);
        gl.GetMapdv(map, GL_COEFF, points.data());
        state["map " + std::to_string(map)] = points;
    }
    GLint width = 0;
    gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    state["texture width"] = {double(width)};
}

} // namespace

State dump_state(const GlTable& gl, bool client) {
    State state;
    const auto get = [&](const Name& name) {
        GLdouble values[16] = {};
        gl.GetDoublev(name.value, values);
        state[name.text] = {values, values + name.count};
    };
    for (const Name& name : server) get(name);
    for (const Name& name : switches)
        state[std::string("enabled ") + name.text] = {double(gl.IsEnabled(name.value))};
    if (client) {
        for (const Name& name : client_state) get(name);
        for (const Name& name : client_switches)
            state[std::string("enabled ") + name.text] = {double(gl.IsEnabled(name.value))};
    }
    dump_units(gl, state);
    dump_objects(gl, state);
    return state;
}

std::string difference(const State& a, const State& b) {
    std::ostringstream out;
    for (const auto& [name, values] : a) {
        const auto other = b.find(name);
        if (other != b.end() && other->second == values) continue;
        out << name << ':';
        for (const double value : values) out << ' ' << value;
        out << " |";
        if (other != b.end())
            for (const double value : other->second) out << ' ' << value;
        out << '\n';
    }
    return out.str();
}

} // namespace glcast::test
