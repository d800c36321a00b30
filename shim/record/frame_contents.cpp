#include "shim/record/frame_contents.h"

#include <unordered_map>

#include "shim/record/context.h"
#include "shim/record/draw_packet.h"
#include "shim/record/player.h"
#include "shim/record/primitive.h"

namespace glcast::record {
namespace {

bool is_texturing(GLenum what) {
    return what == GL_TEXTURE_1D || what == GL_TEXTURE_2D || what == GL_TEXTURE_3D ||
           what == GL_TEXTURE_CUBE_MAP || what == GL_TEXTURE_RECTANGLE;
}

bool is_filled(GLenum mode) { return mode >= GL_TRIANGLES && mode <= GL_POLYGON; }

/// Of glRect and of what evaluators make: how many they draw is not counted.
constexpr long a_few = 4;

class Census {
  public:
    explicit Census(const Frame& of) : frame(of), lists(of.lists) {}

    FrameContents take() {
        look(frame.prologue, 0);
        found = {}; // but for what is switched on
        look(frame.calls, 0);
        found.shows_images |= textures || programs;
        for (const auto& [what, times] : frame.not_understood)
            found.shows_images |= what.starts_with("a draw under");
        return found;
    }

  private:
    static constexpr int deepest = 64;

    void look(const Stream& stream, int depth) {
        stream.for_each([&](const Packet& packet) {
            if (packet.op >= Op(gl_call_count))
                look_at_extra(packet);
            else
                look_at_call(packet, depth);
        });
    }

    void look_at_extra(const Packet& packet) {
        Reader reader(packet);
        if (packet.op == Op(ExtraOp::define_list)) {
            const auto name = reader.get<GLuint>();
            lists[name] = frame.redefinitions[reader.get<std::uint32_t>()];
        } else if (packet.op == Op(ExtraOp::draw)) {
            const auto header = reader.get<DrawHeader>();
            reader.take(header.arrays * sizeof(DrawArray));
            for (std::uint32_t i = 0; i < header.segments; ++i) {
                const auto count = reader.get<DrawSegment>().count;
                if (is_filled(header.mode)) found.filled += long(count) * long(header.instances);
            }
        }
    }

    void look_at_call(const Packet& packet, int depth) {
        Reader reader(packet);
        switch (GlCall(packet.op)) {
        case GlCall::Begin:
            fills = is_filled(reader.get<GLenum>());
            return;
        case GlCall::End:
            fills = false;
            return;
        case GlCall::Enable:
            return enable(reader.get<GLenum>(), true);
        case GlCall::Disable:
            return enable(reader.get<GLenum>(), false);
        case GlCall::Clear:
            found.clears |= !scissors && (reader.get<GLbitfield>() & GL_COLOR_BUFFER_BIT) != 0;
            return;
        case GlCall::DrawPixels:
        case GlCall::CopyPixels:
        case GlCall::Accum:
        case GlCall::BlitFramebuffer:
            found.shows_images = true;
            return;
        case GlCall::Rectf:
        case GlCall::EvalMesh2:
            found.filled += a_few;
            return;
        case GlCall::UseProgram:
            programs |= reader.get<GLuint>() != 0;
            return;
        case GlCall::ListBase:
            base = reader.get<GLuint>();
            return;
        case GlCall::CallList:
            return call(reader.get<GLuint>(), depth);
        case GlCall::CallLists: {
            const GLuint first = base;
            for (auto left = reader.get<std::uint32_t>(); left > 0; --left)
                call(first + reader.get<GLuint>(), depth);
            return;
        }
        default:
            if (!fills) return;
            if (const auto vertex = read_vertex_call(packet))
                found.filled += vertex->kind == GL_VERTEX_ARRAY;
            else
                ++found.filled; // of a kind that is not read, like glEvalCoord: a vertex as likely as not
        }
    }

    void enable(GLenum what, bool on) {
        if (what == GL_SCISSOR_TEST) scissors = on;
        textures |= on && is_texturing(what);
    }

    void call(GLuint name, int depth) {
        const auto list = lists.find(name);
        if (list != lists.end() && list->second && depth < deepest) look(*list->second, depth + 1);
    }

    const Frame& frame;
    std::unordered_map<GLuint, List> lists;
    FrameContents found;
    GLuint base = 0;
    bool fills = false, scissors = false, textures = false, programs = false;
};

} // namespace

FrameContents contents_of(const Frame& frame) { return Census(frame).take(); }

} // namespace glcast::record
