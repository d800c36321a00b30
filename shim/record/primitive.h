// What lies between a glBegin and its glEnd, read from the stream: which attributes its vertices have, and
// whether arrays of them draw the same.
#pragma once
#include <optional>
#include <vector>

#include "shim/record/stream.h"

#include "capture/gl/gl_table.h"

namespace glcast::record {

/// A vertex, or an attribute of the vertices that follow.
struct VertexCall {
    GLenum kind;       ///< of the array that it would be an element of; GL_VERTEX_ARRAY: a vertex
    std::uint8_t unit; ///< of texture coordinates
    std::uint8_t size;
    float values[4]; ///< as GL keeps them; 0, 0, 0, 1 beyond `size`
};

/// Nothing for any other packet, and for types that drivers do not all convert alike.
std::optional<VertexCall> read_vertex_call(const Packet& packet);

/// glBegin to glEnd.
struct Primitive {
    struct Attribute {
        GLenum kind;
        std::uint8_t unit, size;
        Stream::Run last; ///< the call that gave it last
    };
    GLenum mode = GL_POINTS;
    std::size_t vertices = 0;
    std::vector<Attribute> attributes; ///< the position, which comes last, included
    Stream::Cursor begin, end;         ///< behind glBegin; at glEnd

    explicit Primitive(const Stream::Cursor& at) : begin(at), end(at) {}
};

/// The primitive that begins at the cursor, at a glBegin. Nothing where arrays would not draw the same: where
/// another call lies in it, where an attribute is given to some vertices and not to those before them, or
/// glEnd does not follow.
std::optional<Primitive> read_primitive(const Stream::Cursor& at);

} // namespace glcast::record
