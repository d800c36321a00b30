// glArrayElement: written down as the immediate calls that it stands for.
#include <algorithm>
#include <iterator>

#include "shim/record/arrays.h"
#include "shim/record/buffers.h"
#include "shim/record/packets.h"
#include "shim/record/readable.h"

namespace glcast::record {

namespace {

using WriteElement = void (*)(Stream& stream, int unit, const void* element);

template <class Packet, class T> void write_vector(Stream& stream, int, const void* element) {
    Packet::write(stream, static_cast<const T*>(element));
}
template <class Packet, class T> void write_texture(Stream& stream, int unit, const void* element) {
    Packet::write(stream, GLenum(GL_TEXTURE0 + unit), static_cast<const T*>(element));
}
template <class Packet, class T> void write_attribute_0(Stream& stream, int, const void* element) {
    Packet::write(stream, 0, static_cast<const T*>(element));
}

struct Row {
    GLenum kind;
    GLint size;
    GLenum type;
    bool normalized;
    WriteElement write;
};

#define ROW(kind, size, type, call, T)                                                                       \
    { kind, size, type, false, write_vector<packets::call, T> }
#define TEXTURE(size, type, call, T)                                                                         \
    { GL_TEXTURE_COORD_ARRAY, size, type, false, write_texture<packets::call, T> }
#define ATTRIBUTE(size, type, normalized, call, T)                                                           \
    { attribute_0_array, size, type, normalized, write_attribute_0<packets::call, T> }
#define COLOURS(kind, size, call)                                                                            \
    ROW(kind, size, GL_BYTE, call##bv, GLbyte), ROW(kind, size, GL_UNSIGNED_BYTE, call##ubv, GLubyte),       \
        ROW(kind, size, GL_SHORT, call##sv, GLshort),                                                        \
        ROW(kind, size, GL_UNSIGNED_SHORT, call##usv, GLushort), ROW(kind, size, GL_INT, call##iv, GLint),   \
        ROW(kind, size, GL_UNSIGNED_INT, call##uiv, GLuint), ROW(kind, size, GL_FLOAT, call##fv, GLfloat),   \
        ROW(kind, size, GL_DOUBLE, call##dv, GLdouble)
#define COORDS(kind, size, call)                                                                             \
    ROW(kind, size, GL_SHORT, call##sv, GLshort), ROW(kind, size, GL_INT, call##iv, GLint),                  \
        ROW(kind, size, GL_FLOAT, call##fv, GLfloat), ROW(kind, size, GL_DOUBLE, call##dv, GLdouble)
#define TEXTURES(size, call)                                                                                 \
    TEXTURE(size, GL_SHORT, call##sv, GLshort), TEXTURE(size, GL_INT, call##iv, GLint),                      \
        TEXTURE(size, GL_FLOAT, call##fv, GLfloat), TEXTURE(size, GL_DOUBLE, call##dv, GLdouble)
#define ATTRIBUTES(size, call)                                                                               \
    ATTRIBUTE(size, GL_SHORT, false, call##sv, GLshort),                                                     \
        ATTRIBUTE(size, GL_FLOAT, false, call##fv, GLfloat),                                                 \
        ATTRIBUTE(size, GL_FLOAT, true, call##fv, GLfloat),                                                  \
        ATTRIBUTE(size, GL_DOUBLE, false, call##dv, GLdouble)

constexpr Row rows[] = {
    COLOURS(GL_COLOR_ARRAY, 3, Color3),
    COLOURS(GL_COLOR_ARRAY, 4, Color4),
    COLOURS(GL_SECONDARY_COLOR_ARRAY, 3, SecondaryColor3),
    COORDS(GL_NORMAL_ARRAY, 3, Normal3),
    ROW(GL_NORMAL_ARRAY, 3, GL_BYTE, Normal3bv, GLbyte),
    COORDS(GL_VERTEX_ARRAY, 2, Vertex2),
    COORDS(GL_VERTEX_ARRAY, 3, Vertex3),
    COORDS(GL_VERTEX_ARRAY, 4, Vertex4),
    TEXTURES(1, MultiTexCoord1),
    TEXTURES(2, MultiTexCoord2),
    TEXTURES(3, MultiTexCoord3),
    TEXTURES(4, MultiTexCoord4),
    ROW(GL_FOG_COORD_ARRAY, 1, GL_FLOAT, FogCoordfv, GLfloat),
    ROW(GL_FOG_COORD_ARRAY, 1, GL_DOUBLE, FogCoorddv, GLdouble),
    ROW(GL_INDEX_ARRAY, 1, GL_UNSIGNED_BYTE, Indexubv, GLubyte),
    COORDS(GL_INDEX_ARRAY, 1, Index),
    ROW(GL_EDGE_FLAG_ARRAY, 1, GL_UNSIGNED_BYTE, EdgeFlagv, GLboolean),
    ATTRIBUTES(1, VertexAttrib1),
    ATTRIBUTES(2, VertexAttrib2),
    ATTRIBUTES(3, VertexAttrib3),
    ATTRIBUTES(4, VertexAttrib4),
    ATTRIBUTE(4, GL_UNSIGNED_BYTE, true, VertexAttrib4Nubv, GLubyte),
};

WriteElement writer_of(const Array& array) {
    const auto* row = std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) {
        return r.kind == array.kind && r.size == array.size && r.type == array.type &&
               r.normalized == array.normalized;
    });
    return row == std::end(rows) ? nullptr : row->write;
}

/// Where element `index` lies; null when it cannot be read.
const std::byte* element_at(Context& context, const Array& array, GLint index, Blob& keep) {
    if (!array.buffer) return array.pointer ? array.pointer + std::ptrdiff_t(index) * array.stride : nullptr;
    keep = whole_buffer(context, array.buffer);
    const auto offset =
        reinterpret_cast<std::uintptr_t>(array.pointer) + std::size_t(index) * std::size_t(array.stride);
    return keep && index >= 0 && offset + element_bytes(array) <= keep->size() ? keep->data() + offset
                                                                               : nullptr;
}

/// Nobody has so many vertices: better ask than fall over it.
bool is_far(GLint index) { return index < 0 || index > 1 << 22; }

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY ArrayElement(GLint index) {
    if (Context* context = listening_context()) {
        if (context->can_query()) prepare_arrays(*context);
        if (context->restart == GLuint(index)) {
            context->emit(true, [](Stream& stream) { packets::PrimitiveRestartNV::write(stream); });
            return this_thread.real->ArrayElement(index);
        }
        for (const Array& array : context->arrays) {
            Blob keep;
            const WriteElement write = writer_of(array);
            const std::byte* element = write ? element_at(*context, array, index, keep) : nullptr;
            if (element && is_far(index) && !is_readable(element, element_bytes(array))) element = nullptr;
            if (element)
                context->emit(true, [&](Stream& stream) { write(stream, array.unit, element); });
            else
                context->count("glArrayElement of an array that cannot be read");
        }
    }
    this_thread.real->ArrayElement(index);
}

} // namespace glcast::record::custom
