#include "shim/record/arrays.h"

#include "shim/record/buffers.h"

namespace glcast::record {

namespace {

/// How to ask for an array; 0 where it has no such parameter.
struct Row {
    GLenum kind, size, type, stride, buffer, pointer;
    GLint default_size;
    GLenum default_type;
    int since;
    const char* extension;
};
constexpr Row rows[] = {
    {GL_NORMAL_ARRAY, 0, GL_NORMAL_ARRAY_TYPE, GL_NORMAL_ARRAY_STRIDE, GL_NORMAL_ARRAY_BUFFER_BINDING,
     GL_NORMAL_ARRAY_POINTER, 3, 0, 11, nullptr},
    {GL_COLOR_ARRAY, GL_COLOR_ARRAY_SIZE, GL_COLOR_ARRAY_TYPE, GL_COLOR_ARRAY_STRIDE,
     GL_COLOR_ARRAY_BUFFER_BINDING, GL_COLOR_ARRAY_POINTER, 0, 0, 11, nullptr},
    {GL_SECONDARY_COLOR_ARRAY, GL_SECONDARY_COLOR_ARRAY_SIZE, GL_SECONDARY_COLOR_ARRAY_TYPE,
     GL_SECONDARY_COLOR_ARRAY_STRIDE, GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING,
     GL_SECONDARY_COLOR_ARRAY_POINTER, 0, 0, 14, "GL_EXT_secondary_color"},
    {GL_FOG_COORD_ARRAY, 0, GL_FOG_COORD_ARRAY_TYPE, GL_FOG_COORD_ARRAY_STRIDE,
     GL_FOG_COORD_ARRAY_BUFFER_BINDING, GL_FOG_COORD_ARRAY_POINTER, 1, 0, 14, "GL_EXT_fog_coord"},
    {GL_INDEX_ARRAY, 0, GL_INDEX_ARRAY_TYPE, GL_INDEX_ARRAY_STRIDE, GL_INDEX_ARRAY_BUFFER_BINDING,
     GL_INDEX_ARRAY_POINTER, 1, 0, 11, nullptr},
    {GL_EDGE_FLAG_ARRAY, 0, 0, GL_EDGE_FLAG_ARRAY_STRIDE, GL_EDGE_FLAG_ARRAY_BUFFER_BINDING,
     GL_EDGE_FLAG_ARRAY_POINTER, 1, GL_UNSIGNED_BYTE, 11, nullptr},
};
constexpr Row texture_row = {GL_TEXTURE_COORD_ARRAY,
                             GL_TEXTURE_COORD_ARRAY_SIZE,
                             GL_TEXTURE_COORD_ARRAY_TYPE,
                             GL_TEXTURE_COORD_ARRAY_STRIDE,
                             GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING,
                             GL_TEXTURE_COORD_ARRAY_POINTER,
                             0,
                             0,
                             11,
                             nullptr};
constexpr Row vertex_row = {GL_VERTEX_ARRAY,
                            GL_VERTEX_ARRAY_SIZE,
                            GL_VERTEX_ARRAY_TYPE,
                            GL_VERTEX_ARRAY_STRIDE,
                            GL_VERTEX_ARRAY_BUFFER_BINDING,
                            GL_VERTEX_ARRAY_POINTER,
                            0,
                            0,
                            11,
                            nullptr};

void add_array(Context& context, const Row& row, int unit) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    if (!limits.has(row.since, row.extension) || !gl.IsEnabled(row.kind)) return;
    Array array{};
    array.kind = row.kind;
    array.unit = std::uint8_t(unit);
    array.size = row.size ? get_int(gl, row.size) : row.default_size;
    array.type = row.type ? GLenum(get_int(gl, row.type)) : row.default_type;
    array.stride = get_int(gl, row.stride);
    array.normalized = false;
    array.buffer = limits.has(15) ? GLuint(get_int(gl, row.buffer)) : 0;
    void* pointer = nullptr;
    gl.GetPointerv(row.pointer, &pointer);
    array.pointer = static_cast<const std::byte*>(pointer);
    if (array.stride == 0) array.stride = GLsizei(element_bytes(array));
    context.arrays.push_back(array);
}

void add_texture_arrays(Context& context) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    if (!limits.has(13)) return add_array(context, texture_row, 0);
    const auto before = GLenum(get_int(gl, GL_CLIENT_ACTIVE_TEXTURE, GL_TEXTURE0));
    for (int unit = 0; unit < limits.texture_coords; ++unit) {
        gl.ClientActiveTexture(GLenum(GL_TEXTURE0 + unit));
        add_array(context, texture_row, unit);
    }
    gl.ClientActiveTexture(before);
}

bool add_attribute_0(Context& context) {
    const GlTable& gl = context.real;
    if (!context.get_limits().has(20)) return false;
    const auto get = [&](GLenum name) {
        GLint values[4] = {};
        gl.GetVertexAttribiv(0, name, values);
        return values[0];
    };
    if (!get(GL_VERTEX_ATTRIB_ARRAY_ENABLED)) return false;
    Array array{};
    array.kind = attribute_0_array;
    array.size = get(GL_VERTEX_ATTRIB_ARRAY_SIZE);
    array.type = GLenum(get(GL_VERTEX_ATTRIB_ARRAY_TYPE));
    array.stride = get(GL_VERTEX_ATTRIB_ARRAY_STRIDE);
    array.normalized = get(GL_VERTEX_ATTRIB_ARRAY_NORMALIZED);
    array.buffer = GLuint(get(GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING));
    void* pointer = nullptr;
    gl.GetVertexAttribPointerv(0, GL_VERTEX_ATTRIB_ARRAY_POINTER, &pointer);
    array.pointer = static_cast<const std::byte*>(pointer);
    if (array.stride == 0) array.stride = GLsizei(element_bytes(array));
    context.arrays.push_back(array);
    return true;
}

/// Programs that are not GLSL's, and what is counted of a draw under them.
struct ProgramSwitch {
    GLenum capability;
    const char* extension;
    const char* draw;
};
constexpr ProgramSwitch program_switches[] = {
    {GL_VERTEX_PROGRAM_ARB, "GL_ARB_vertex_program", "a draw under an assembly program"},
    {GL_FRAGMENT_PROGRAM_ARB, "GL_ARB_fragment_program", "a draw under an assembly program"},
    {GL_VERTEX_PROGRAM_NV, "GL_NV_vertex_program", "a draw under an assembly program"},
    {GL_FRAGMENT_PROGRAM_NV, "GL_NV_fragment_program", "a draw under an assembly program"},
    {GL_FRAGMENT_SHADER_ATI, "GL_ATI_fragment_shader", "a draw under an ATI fragment shader"},
    {GL_REGISTER_COMBINERS_NV, "GL_NV_register_combiners", "a draw under register combiners"},
};

} // namespace

std::optional<std::uint32_t> restart_index(Context& context, GLenum type) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    const std::uint32_t largest = type == GL_UNSIGNED_BYTE    ? 0xFF
                                  : type == GL_UNSIGNED_SHORT ? 0xFFFF
                                                              : 0xFFFFFFFF;
    if (limits.has(43, "GL_ARB_ES3_compatibility") && gl.IsEnabled(GL_PRIMITIVE_RESTART_FIXED_INDEX))
        return largest;
    if (limits.has(31) && gl.IsEnabled(GL_PRIMITIVE_RESTART))
        return std::uint32_t(get_int(gl, GL_PRIMITIVE_RESTART_INDEX));
    if (limits.has(99, "GL_NV_primitive_restart") && gl.IsEnabled(GL_PRIMITIVE_RESTART_NV))
        return std::uint32_t(get_int(gl, GL_PRIMITIVE_RESTART_INDEX_NV));
    return std::nullopt;
}

std::size_t element_bytes(const Array& array) {
    const auto n = std::size_t(array.size == GL_BGRA ? 4 : array.size);
    switch (array.type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
        return n;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_HALF_FLOAT:
        return 2 * n;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FIXED:
    case GL_FLOAT:
        return 4 * n;
    case GL_DOUBLE:
        return 8 * n;
    case GL_INT_2_10_10_10_REV:
    case GL_UNSIGNED_INT_2_10_10_10_REV:
    case GL_UNSIGNED_INT_10F_11F_11F_REV:
        return 4;
    default:
        return 0;
    }
}

void refresh_arrays(Context& context) {
    if (!context.arrays_dirty) return;
    context.arrays.clear();
    for (const Row& row : rows) add_array(context, row, 0);
    add_texture_arrays(context);
    if (!add_attribute_0(context)) add_array(context, vertex_row, 0);
    context.restart = restart_index(context, GL_UNSIGNED_INT);
    context.arrays_dirty = false;
}

void prepare_arrays(Context& context) {
    try {
        refresh_arrays(context);
        for (const Array& array : context.arrays)
            if (array.buffer) whole_buffer(context, array.buffer);
    } catch (const std::exception&) {
        context.give_up_frame("out of memory");
    }
}

void count_if_not_played(Context& context) {
    if (!context.recording || !context.can_query() || !context.executes()) return;
    const Limits& limits = context.get_limits();
    const GlTable& gl = context.real;
    const bool glsl =
        (limits.has(20) && get_int(gl, GL_CURRENT_PROGRAM)) ||
        (limits.has(41, "GL_ARB_separate_shader_objects") && get_int(gl, GL_PROGRAM_PIPELINE_BINDING));
    if (glsl) return context.count("a draw under a GLSL program");
    for (const ProgramSwitch& row : program_switches)
        if (limits.has(99, row.extension) && gl.IsEnabled(row.capability)) return context.count(row.draw);
}

} // namespace glcast::record
