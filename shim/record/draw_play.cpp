// Plays draws: arrays from client memory, set for the draw alone and disabled after it.
#include "shim/record/arrays.h"
#include "shim/record/draw_packet.h"
#include "shim/record/packets.h"

namespace glcast::record {

namespace {

void set_array(const GlTable& gl, const DrawArray& array, const void* pointer) {
    switch (array.kind) {
    case GL_VERTEX_ARRAY:
        gl.VertexPointer(array.size, array.type, array.stride, pointer);
        break;
    case GL_NORMAL_ARRAY:
        gl.NormalPointer(array.type, array.stride, pointer);
        break;
    case GL_COLOR_ARRAY:
        gl.ColorPointer(array.size, array.type, array.stride, pointer);
        break;
    case GL_SECONDARY_COLOR_ARRAY:
        gl.SecondaryColorPointer(array.size, array.type, array.stride, pointer);
        break;
    case GL_FOG_COORD_ARRAY:
        gl.FogCoordPointer(array.type, array.stride, pointer);
        break;
    case GL_INDEX_ARRAY:
        gl.IndexPointer(array.type, array.stride, pointer);
        break;
    case GL_EDGE_FLAG_ARRAY:
        gl.EdgeFlagPointer(array.stride, pointer);
        break;
    case GL_TEXTURE_COORD_ARRAY:
        gl.TexCoordPointer(array.size, array.type, array.stride, pointer);
        break;
    default:
        gl.VertexAttribPointer(0, array.size, array.type, GLboolean(array.normalized), array.stride, pointer);
        break;
    }
}

void switch_array(const Player& player, const DrawArray& array, bool on) {
    const GlTable& gl = player.gl;
    if (array.kind == attribute_0_array)
        return on ? gl.EnableVertexAttribArray(0) : gl.DisableVertexAttribArray(0);
    if (array.kind == GL_TEXTURE_COORD_ARRAY && player.frame.has_multitexture)
        gl.ClientActiveTexture(GL_TEXTURE0 + array.unit);
    if (on)
        gl.EnableClientState(array.kind);
    else
        gl.DisableClientState(array.kind);
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void play_draw(Player& player, const Packet& packet) {
    if (player.skips_draws()) return;
    Reader reader(packet);
    const auto header = reader.get<DrawHeader>();
    Reader arrays = reader;
    reader.take(header.arrays * sizeof(DrawArray));
    Reader segments = reader;
    reader.take(header.segments * sizeof(DrawSegment));
    const std::byte* data = reader.align(8).position();
    const auto start = [&](std::uint32_t blob) {
        return blob == in_packet ? data : player.frame.blobs[blob]->data();
    };

    Reader on = arrays, off = arrays;
    for (std::uint32_t i = 0; i < header.arrays; ++i) {
        const auto array = on.get<DrawArray>();
        switch_array(player, array, true);
        // Element 0 may lie before what is there: the draw begins with a later one. Hence no pointer
        // arithmetic.
        const auto address =
            reinterpret_cast<std::uintptr_t>(start(array.blob)) + std::uintptr_t(array.element_0);
        set_array(player.gl, array, reinterpret_cast<const void*>(address));
    }
    const std::byte* indices = start(header.index_blob) + header.index_offset;
    const std::size_t bytes = header.index_type == GL_UNSIGNED_BYTE    ? 1
                              : header.index_type == GL_UNSIGNED_SHORT ? 2
                                                                       : 4;
    for (std::uint32_t instance = 0; instance < header.instances; ++instance) {
        Reader each = segments;
        for (std::uint32_t i = 0; i < header.segments; ++i) {
            const auto segment = each.get<DrawSegment>();
            if (!header.index_type)
                player.gl.DrawArrays(header.mode, GLint(segment.first), GLsizei(segment.count));
            else
                player.gl.DrawElements(header.mode, GLsizei(segment.count), header.index_type,
                                       indices + segment.first * bytes);
        }
    }
    for (std::uint32_t i = 0; i < header.arrays; ++i) switch_array(player, off.get<DrawArray>(), false);
}

} // namespace glcast::record::custom
