// Lights and materials, texture units, the texture objects named 0, evaluators.
#include <iterator>

#include "shim/record/bound_objects.h"
#include "shim/record/packets.h"
#include "shim/record/snapshot.h"

namespace glcast::record {

namespace {

constexpr GLenum light_parameters[] = {
    GL_AMBIENT,
    GL_DIFFUSE,
    GL_SPECULAR,
    GL_POSITION,
    GL_SPOT_DIRECTION,
    GL_SPOT_EXPONENT,
    GL_SPOT_CUTOFF,
    GL_CONSTANT_ATTENUATION,
    GL_LINEAR_ATTENUATION,
    GL_QUADRATIC_ATTENUATION,
};
constexpr GLenum material_parameters[] = {GL_AMBIENT,  GL_DIFFUSE,   GL_SPECULAR,
                                          GL_EMISSION, GL_SHININESS, GL_COLOR_INDEXES};

struct TextureTarget {
    GLenum target, binding;
    int since;
    const char* extension;
};
constexpr TextureTarget texture_targets[] = {
    {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D, 11, nullptr},
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D, 11, nullptr},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D, 12, nullptr},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP, 13, nullptr},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE, 31, "GL_ARB_texture_rectangle"},
};

struct Parameter {
    GLenum name;
    int since;
};
constexpr Parameter environment[] = {
    {GL_TEXTURE_ENV_MODE, 10}, {GL_TEXTURE_ENV_COLOR, 10}, {GL_COMBINE_RGB, 13},    {GL_COMBINE_ALPHA, 13},
    {GL_SRC0_RGB, 13},         {GL_SRC1_RGB, 13},          {GL_SRC2_RGB, 13},       {GL_SRC0_ALPHA, 13},
    {GL_SRC1_ALPHA, 13},       {GL_SRC2_ALPHA, 13},        {GL_OPERAND0_RGB, 13},   {GL_OPERAND1_RGB, 13},
    {GL_OPERAND2_RGB, 13},     {GL_OPERAND0_ALPHA, 13},    {GL_OPERAND1_ALPHA, 13}, {GL_OPERAND2_ALPHA, 13},
    {GL_RGB_SCALE, 13},        {GL_ALPHA_SCALE, 13},
};
constexpr Parameter texture_parameters[] = {
    {GL_TEXTURE_MIN_FILTER, 10},   {GL_TEXTURE_MAG_FILTER, 10},   {GL_TEXTURE_WRAP_S, 10},
    {GL_TEXTURE_WRAP_T, 10},       {GL_TEXTURE_WRAP_R, 12},       {GL_TEXTURE_BORDER_COLOR, 10},
    {GL_TEXTURE_PRIORITY, 11},     {GL_TEXTURE_MIN_LOD, 12},      {GL_TEXTURE_MAX_LOD, 12},
    {GL_TEXTURE_BASE_LEVEL, 12},   {GL_TEXTURE_MAX_LEVEL, 12},    {GL_TEXTURE_LOD_BIAS, 14},
    {GL_TEXTURE_COMPARE_MODE, 14}, {GL_TEXTURE_COMPARE_FUNC, 14}, {GL_DEPTH_TEXTURE_MODE, 14},
    {GL_GENERATE_MIPMAP, 14},
};

void write_light(const GlTable& gl, Stream& stream, GLenum light) {
    for (const GLenum name : light_parameters) {
        GLfloat values[4] = {};
        gl.GetLightfv(light, name, values);
        packets::Lightfv::write(stream, light, name, values);
    }
}

void write_material(const GlTable& gl, Stream& stream, GLenum face) {
    for (const GLenum name : material_parameters) {
        GLfloat values[4] = {};
        gl.GetMaterialfv(face, name, values);
        packets::Materialfv::write(stream, face, name, values);
    }
}

void write_clip_planes(Context& context, Stream& stream) {
    for (int i = 0; i < context.get_limits().clip_planes; ++i) {
        GLdouble equation[4] = {};
        context.real.GetClipPlane(GLenum(GL_CLIP_PLANE0 + i), equation);
        packets::ClipPlane::write(stream, GLenum(GL_CLIP_PLANE0 + i), equation);
    }
}

void write_switch(const GlTable& gl, Stream& stream, GLenum capability) {
    if (gl.IsEnabled(capability))
        packets::Enable::write(stream, capability);
    else
        packets::Disable::write(stream, capability);
}

void write_generation(const GlTable& gl, Stream& stream) {
    for (int i = 0; i < 4; ++i) {
        const auto coordinate = GLenum(GL_S + i);
        GLint mode = GL_EYE_LINEAR;
        gl.GetTexGeniv(coordinate, GL_TEXTURE_GEN_MODE, &mode);
        packets::TexGeni::write(stream, coordinate, GL_TEXTURE_GEN_MODE, mode);
        for (const GLenum plane : {GL_OBJECT_PLANE, GL_EYE_PLANE}) {
            GLdouble values[4] = {};
            gl.GetTexGendv(coordinate, plane, values);
            packets::TexGendv::write(stream, coordinate, plane, values);
        }
        write_switch(gl, stream, GLenum(GL_TEXTURE_GEN_S + i));
    }
}

void write_environment(Context& context, Stream& stream) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    GLfloat values[4] = {};
    for (const Parameter& row : environment) {
        if (!limits.has(row.since)) continue;
        gl.GetTexEnvfv(GL_TEXTURE_ENV, row.name, values);
        packets::TexEnvfv::write(stream, GL_TEXTURE_ENV, row.name, values);
    }
    if (limits.has(14)) {
        gl.GetTexEnvfv(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, values);
        packets::TexEnvf::write(stream, GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, values[0]);
    }
    if (limits.has(20)) {
        GLint replace = 0;
        gl.GetTexEnviv(GL_POINT_SPRITE, GL_COORD_REPLACE, &replace);
        packets::TexEnvi::write(stream, GL_POINT_SPRITE, GL_COORD_REPLACE, replace);
    }
}

void write_unit(Context& context, Stream& stream, int unit) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    if (unit < limits.texture_units) {
        for (const TextureTarget& row : texture_targets) {
            if (!limits.has(row.since, row.extension)) continue;
            packets::BindTexture::write(stream, row.target, GLuint(get_int(gl, row.binding)));
            write_switch(gl, stream, row.target);
        }
        write_environment(context, stream);
    }
    write_generation(gl, stream);
    GLfloat coordinates[4] = {0, 0, 0, 1};
    gl.GetFloatv(GL_CURRENT_TEXTURE_COORDS, coordinates);
    if (limits.has(13))
        packets::MultiTexCoord4fv::write(stream, GLenum(GL_TEXTURE0 + unit), coordinates);
    else
        packets::TexCoord4fv::write(stream, coordinates);
}

struct TargetBinding {
    GLenum target, binding;
};
constexpr TargetBinding bindings[] = {
    {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
};

void write_levels(Context& context, Stream& stream, GLenum target) {
    GLint levels = target == GL_TEXTURE_RECTANGLE ? 1 : 16;
    for (GLint level = 0; level < levels; ++level) {
        const int faces = target == GL_TEXTURE_CUBE_MAP ? 6 : 1;
        bool any = false;
        for (int face = 0; face < faces; ++face) {
            const GLenum image = faces == 6 ? GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face) : target;
            any |= write_level(context, stream, image, level);
        }
        if (!any) return;
    }
}

void write_texture_parameters(Context& context, Stream& stream, GLenum target) {
    for (const Parameter& row : texture_parameters) {
        if (!context.get_limits().has(row.since)) continue;
        GLfloat values[4] = {};
        context.real.GetTexParameterfv(target, row.name, values);
        packets::TexParameterfv::write(stream, target, row.name, values);
    }
}

} // namespace

GLenum texture_binding(GLenum target, GLenum* object) {
    if (target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z)
        target = GL_TEXTURE_CUBE_MAP;
    if (object) *object = target;
    for (const TargetBinding& row : bindings)
        if (row.target == target) return row.binding;
    return 0;
}

void write_texture(Context& context, Stream& stream, GLenum target) {
    // Levels first: with GL_GENERATE_MIPMAP set, giving level 0 would make the others anew.
    packets::TexParameteri::write(stream, target, GL_GENERATE_MIPMAP, GL_FALSE);
    write_levels(context, stream, target);
    write_texture_parameters(context, stream, target);
}

bool write_level(Context& context, Stream& stream, GLenum target, GLint level) {
    const GlTable& gl = context.real;
    const auto get = [&](GLenum name) {
        GLint value = 0;
        gl.GetTexLevelParameteriv(target, level, name, &value);
        return value;
    };
    const bool has_3d = context.get_limits().has(12);
    const GLint w = get(GL_TEXTURE_WIDTH), h = get(GL_TEXTURE_HEIGHT), d = has_3d ? get(GL_TEXTURE_DEPTH) : 1;
    if (w <= 0 || h <= 0 || d <= 0) return false;
    const GLint internal = get(GL_TEXTURE_INTERNAL_FORMAT), border = get(GL_TEXTURE_BORDER);
    const bool depth = context.get_limits().has(14) && get(GL_TEXTURE_DEPTH_SIZE) > 0;
    const GLenum format = depth ? GL_DEPTH_COMPONENT : GL_RGBA, type = GL_FLOAT;
    std::vector<std::byte> pixels(sizes::image_bytes(format, type, w, h, d));
    {
        const DefaultPacking packing(context);
        gl.GetTexImage(target, level, format, type, pixels.data());
    }
    if (target == GL_TEXTURE_1D)
        packets::TexImage1D::write(stream, target, level, internal, w, border, format, type, pixels.data());
    else if (target == GL_TEXTURE_3D)
        packets::TexImage3D::write(stream, target, level, internal, w, h, d, border, format, type,
                                   pixels.data());
    else
        packets::TexImage2D::write(stream, target, level, internal, w, h, border, format, type,
                                   pixels.data());
    return true;
}

void write_lights(Context& context, Stream& stream) {
    const GlTable& gl = context.real;
    for (int i = 0; i < context.get_limits().lights; ++i) write_light(gl, stream, GLenum(GL_LIGHT0 + i));
    for (const GLenum name : {GL_LIGHT_MODEL_AMBIENT, GL_LIGHT_MODEL_LOCAL_VIEWER, GL_LIGHT_MODEL_TWO_SIDE}) {
        GLfloat values[4] = {};
        gl.GetFloatv(name, values);
        packets::LightModelfv::write(stream, name, values);
    }
    if (context.get_limits().has(12))
        packets::LightModeli::write(stream, GL_LIGHT_MODEL_COLOR_CONTROL,
                                    get_int(gl, GL_LIGHT_MODEL_COLOR_CONTROL));
    write_material(gl, stream, GL_FRONT);
    write_material(gl, stream, GL_BACK);
    packets::ColorMaterial::write(stream, GLenum(get_int(gl, GL_COLOR_MATERIAL_FACE)),
                                  GLenum(get_int(gl, GL_COLOR_MATERIAL_PARAMETER)));
    write_clip_planes(context, stream);
}

void write_textures(Context& context, Stream& stream) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    if (!limits.has(13)) return write_unit(context, stream, 0);
    const auto before = GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0));
    for (int unit = 0; unit < limits.texture_coords; ++unit) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        packets::ActiveTexture::write(stream, GLenum(GL_TEXTURE0 + unit));
        write_unit(context, stream, unit);
    }
    gl.ActiveTexture(before);
    packets::ActiveTexture::write(stream, before);
}

void write_default_textures(Context& context, Stream& stream) {
    for (const TextureTarget& row : texture_targets) {
        if (!context.get_limits().has(row.since, row.extension)) continue;
        const auto before = GLuint(get_int(context.real, row.binding));
        const BoundTexture bound(context, row.target, 0);
        if (!bound) continue;
        packets::BindTexture::write(stream, row.target, 0);
        write_texture(context, stream, row.target);
        packets::BindTexture::write(stream, row.target, before);
    }
}

void write_evaluators(Context& context, Stream& stream) {
    const GlTable& gl = context.real;
    const bool has_units = context.get_limits().has(13);
    if (has_units)
        packets::ActiveTexture::write(stream, GL_TEXTURE0); // GL refuses maps while another is active
    for (int i = 0; i < 9; ++i) {
        const auto map1 = GLenum(GL_MAP1_COLOR_4 + i), map2 = GLenum(GL_MAP2_COLOR_4 + i);
        const auto n = GLint(sizes::map_components(map1));
        GLint order[2] = {1, 1};
        GLfloat domain[4] = {0, 1, 0, 1};
        gl.GetMapiv(map1, GL_ORDER, order);
        gl.GetMapfv(map1, GL_DOMAIN, domain);
        std::vector<GLfloat> points(std::size_t(n * order[0]));
        gl.GetMapfv(map1, GL_COEFF, points.data());
        packets::Map1f::write(stream, map1, domain[0], domain[1], n, order[0], points.data());
        gl.GetMapiv(map2, GL_ORDER, order);
        gl.GetMapfv(map2, GL_DOMAIN, domain);
        points.resize(std::size_t(n * order[0] * order[1]));
        gl.GetMapfv(map2, GL_COEFF, points.data());
        packets::Map2f::write(stream, map2, domain[0], domain[1], n * order[1], order[0], domain[2],
                              domain[3], n, order[1], points.data());
        write_switch(gl, stream, map1);
        write_switch(gl, stream, map2);
    }
    GLdouble grid[4] = {};
    GLint segments[2] = {1, 1};
    gl.GetDoublev(GL_MAP1_GRID_DOMAIN, grid);
    packets::MapGrid1d::write(stream, get_int(gl, GL_MAP1_GRID_SEGMENTS, 1), grid[0], grid[1]);
    gl.GetDoublev(GL_MAP2_GRID_DOMAIN, grid);
    gl.GetIntegerv(GL_MAP2_GRID_SEGMENTS, segments);
    packets::MapGrid2d::write(stream, segments[0], grid[0], grid[1], segments[1], grid[2], grid[3]);
    if (has_units) packets::ActiveTexture::write(stream, GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0)));
}

} // namespace glcast::record
