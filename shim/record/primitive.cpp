#include "shim/record/primitive.h"

#include <algorithm>
#include <type_traits>

namespace glcast::record {
namespace {

enum class Type : std::uint8_t { floats, doubles, bytes };

/// How a packet gives an attribute.
struct Row {
    GLenum kind = 0; ///< 0: it does not
    std::uint8_t size = 0;
    Type type = Type::floats;
    bool is_vector = false;
    bool has_unit = false;
};

struct Table {
    Row rows[gl_call_count];
};

#define GLCAST_ROWS(NAME, KIND, SIZE)                                                                        \
    set(GlCall::NAME##f, {KIND, SIZE, Type::floats, false, false});                                          \
    set(GlCall::NAME##fv, {KIND, SIZE, Type::floats, true, false});                                          \
    set(GlCall::NAME##d, {KIND, SIZE, Type::doubles, false, false});                                         \
    set(GlCall::NAME##dv, {KIND, SIZE, Type::doubles, true, false})
#define GLCAST_BYTE_ROWS(NAME, KIND, SIZE)                                                                   \
    set(GlCall::NAME##ub, {KIND, SIZE, Type::bytes, false, false});                                          \
    set(GlCall::NAME##ubv, {KIND, SIZE, Type::bytes, true, false})
#define GLCAST_UNIT_ROWS(NAME, SIZE)                                                                         \
    set(GlCall::NAME##f, {GL_TEXTURE_COORD_ARRAY, SIZE, Type::floats, false, true});                         \
    set(GlCall::NAME##fv, {GL_TEXTURE_COORD_ARRAY, SIZE, Type::floats, true, true});                         \
    set(GlCall::NAME##d, {GL_TEXTURE_COORD_ARRAY, SIZE, Type::doubles, false, true});                        \
    set(GlCall::NAME##dv, {GL_TEXTURE_COORD_ARRAY, SIZE, Type::doubles, true, true})

constexpr Table make_table() {
    Table table;
    const auto set = [&](GlCall call, Row row) { table.rows[static_cast<std::size_t>(call)] = row; };
    GLCAST_ROWS(Vertex2, GL_VERTEX_ARRAY, 2);
    GLCAST_ROWS(Vertex3, GL_VERTEX_ARRAY, 3);
    GLCAST_ROWS(Vertex4, GL_VERTEX_ARRAY, 4);
    GLCAST_ROWS(Normal3, GL_NORMAL_ARRAY, 3);
    GLCAST_ROWS(Color3, GL_COLOR_ARRAY, 3);
    GLCAST_ROWS(Color4, GL_COLOR_ARRAY, 4);
    GLCAST_BYTE_ROWS(Color3, GL_COLOR_ARRAY, 3);
    GLCAST_BYTE_ROWS(Color4, GL_COLOR_ARRAY, 4);
    GLCAST_ROWS(TexCoord1, GL_TEXTURE_COORD_ARRAY, 1);
    GLCAST_ROWS(TexCoord2, GL_TEXTURE_COORD_ARRAY, 2);
    GLCAST_ROWS(TexCoord3, GL_TEXTURE_COORD_ARRAY, 3);
    GLCAST_ROWS(TexCoord4, GL_TEXTURE_COORD_ARRAY, 4);
    GLCAST_UNIT_ROWS(MultiTexCoord1, 1);
    GLCAST_UNIT_ROWS(MultiTexCoord2, 2);
    GLCAST_UNIT_ROWS(MultiTexCoord3, 3);
    GLCAST_UNIT_ROWS(MultiTexCoord4, 4);
    return table;
}

constexpr Table table = make_table();
constexpr GLenum most_units = 8;

template <class T> void read_values(Reader& reader, bool is_vector, VertexCall& call) {
    if (is_vector) reader.align(alignof(T));
    for (int i = 0; i < call.size; ++i) {
        const T value = reader.get<T>();
        if constexpr (std::is_same_v<T, GLubyte>)
            call.values[i] = static_cast<float>(value) / 255.0f;
        else
            call.values[i] = static_cast<float>(value);
    }
}

/// Adds the call to what is known of its attribute. False where vertices have gone before without it, or with
/// another number of values: Mesa's vertices then differ from those of arrays.
bool note(Primitive& primitive, const VertexCall& call, const Stream::Run& run) {
    auto& all = primitive.attributes;
    auto at = std::find_if(all.begin(), all.end(), [&](const Primitive::Attribute& a) {
        return a.kind == call.kind && a.unit == call.unit;
    });
    if (at == all.end()) {
        if (primitive.vertices > (call.kind == GL_VERTEX_ARRAY)) return false;
        at = all.insert(at, {call.kind, call.unit, call.size, run});
    }
    at->last = run;
    return at->size == call.size;
}

} // namespace

std::optional<VertexCall> read_vertex_call(const Packet& packet) {
    if (packet.op >= gl_call_count) return std::nullopt;
    const Row& row = table.rows[packet.op];
    if (row.kind == 0) return std::nullopt;
    VertexCall call{row.kind, 0, row.size, {0, 0, 0, 1}};
    Reader reader(packet);
    if (row.has_unit) {
        const GLenum unit = reader.get<GLenum>() - GL_TEXTURE0;
        if (unit >= most_units) return std::nullopt;
        call.unit = static_cast<std::uint8_t>(unit);
    }
    if (row.type == Type::floats)
        read_values<GLfloat>(reader, row.is_vector, call);
    else if (row.type == Type::doubles)
        read_values<GLdouble>(reader, row.is_vector, call);
    else
        read_values<GLubyte>(reader, row.is_vector, call);
    return call;
}

std::optional<Primitive> read_primitive(const Stream::Cursor& at) {
    Stream::Cursor cursor = at;
    const auto mode = Reader(cursor.packet()).get<GLenum>();
    if (mode > GL_POLYGON) return std::nullopt;
    cursor.step();
    Primitive primitive(cursor);
    primitive.mode = mode;
    for (; !cursor.at_end(); cursor.step()) {
        const Packet packet = cursor.packet();
        if (packet.op == Op(GlCall::End)) {
            primitive.end = cursor;
            auto& all = primitive.attributes;
            std::stable_partition(all.begin(), all.end(),
                                  [](const auto& a) { return a.kind != GL_VERTEX_ARRAY; });
            return primitive;
        }
        const auto call = read_vertex_call(packet);
        if (!call) return std::nullopt;
        primitive.vertices += call->kind == GL_VERTEX_ARRAY;
        if (!note(primitive, *call, cursor.run())) return std::nullopt;
    }
    return std::nullopt;
}

} // namespace glcast::record
