// Plays draws: arrays from client memory, set for the draw alone and disabled after it.
#include "shim/record/arrays.h"
#include "shim/record/draw_packet.h"
#include "shim/record/packets.h"
#include "shim/record/prepare.h"

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
    const DrawReader draw(player.frame, packet);
    const DrawHeader& header = draw.header;
    const auto each_array = [&](auto&& visit) {
        Reader arrays({packet.op, draw.arrays, header.arrays * sizeof(DrawArray)});
        for (std::uint32_t i = 0; i < header.arrays; ++i) visit(arrays.get<DrawArray>());
    };
    each_array([&](const DrawArray& array) {
        switch_array(player, array, true);
        set_array(player.gl, array, reinterpret_cast<const void*>(draw.element_0(array)));
    });
    {
        const ShownDraw shown(player.frame, packet);
        for (std::uint32_t instance = 0; instance < header.instances; ++instance) {
            Reader segments({packet.op, draw.segments, header.segments * sizeof(DrawSegment)});
            for (std::uint32_t i = 0; i < header.segments; ++i) {
                const auto segment = segments.get<DrawSegment>();
                if (!header.index_type)
                    player.gl.DrawArrays(header.mode, GLint(segment.first), GLsizei(segment.count));
                else
                    player.gl.DrawElements(header.mode, GLsizei(segment.count), header.index_type,
                                           draw.indices() + segment.first * draw.index_bytes());
            }
        }
    }
    each_array([&](const DrawArray& array) { switch_array(player, array, false); });
}

} // namespace glcast::record::custom
