#include "shim/record/texture_stand_ins.h"

#include <algorithm>

#include "shim/record/packets.h"
#include "shim/record/snapshot.h"

namespace glcast::record {

TextureStandIns::TextureStandIns(const Frame& of, const GlTable& table, const DefaultTextures& for_0)
    : frame(of), gl(table), defaults(for_0), ended(of.textures.size()), deleted(of.textures.size()) {
    for (auto number = std::uint32_t(frame.textures.size()); number-- > 0;)
        copies[frame.textures[number].name].push_back(number);
}

GLuint TextureStandIns::find(GLenum target, GLuint name) const {
    if (const auto found = copies.find(name); found != copies.end() && !found->second.empty()) {
        const std::uint32_t number = found->second.back();
        if (frame.textures[number].target == target && number < frame.stand_ins.size())
            return frame.stand_ins[number];
    }
    // Binding a name that the program has deleted would make it anew, in the program's own name space.
    return name && gl.IsTexture(name) ? name : defaults.find(target);
}

void TextureStandIns::end(std::uint32_t number, bool by_deletion) {
    ended[number] = true;
    deleted[number] = by_deletion;
    std::erase(copies[frame.textures[number].name], number);
    refresh();
}

void TextureStandIns::refresh() const {
    if (std::find(ended.begin(), ended.end(), true) == ended.end()) return;
    const int units =
        frame.has_multitexture ? std::min(get_int(gl, GL_MAX_TEXTURE_UNITS, 1), max_texture_units) : 1;
    const auto active_unit = frame.has_multitexture ? GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0)) : 0;
    for (int unit = 0; unit < units; ++unit) {
        if (active_unit) gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        for (std::size_t number = 0; number < std::min(ended.size(), frame.stand_ins.size()); ++number) {
            if (!ended[number]) continue;
            const TextureCopy& copy = frame.textures[number];
            if (GLuint(get_int(gl, texture_binding(copy.target))) == frame.stand_ins[number])
                gl.BindTexture(copy.target, find(copy.target, deleted[number] ? 0 : copy.name));
        }
    }
    if (active_unit) gl.ActiveTexture(active_unit);
}

namespace {

void set_default_transfer(const GlTable& gl) {
    gl.PixelTransferi(GL_MAP_COLOR, 0);
    for (const GLenum name : {GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE, GL_DEPTH_SCALE})
        gl.PixelTransferf(name, 1);
    for (const GLenum name : {GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS, GL_DEPTH_BIAS})
        gl.PixelTransferf(name, 0);
}

/// The images of the frame's calls are played for the texture named 0 alone; these are played whatever is
/// bound.
void play_contents(Player& player, const Stream& contents) {
    contents.for_each([&](const Packet& packet) {
        switch (GlCall(packet.op)) {
        case GlCall::TexImage1D:
            return packets::TexImage1D::play(player, packet);
        case GlCall::TexImage2D:
            return packets::TexImage2D::play(player, packet);
        case GlCall::TexImage3D:
            return packets::TexImage3D::play(player, packet);
        case GlCall::TexParameteri:
            return packets::TexParameteri::play(player, packet);
        case GlCall::TexParameterfv:
            return packets::TexParameterfv::play(player, packet);
        default:
            return;
        }
    });
}

} // namespace

void make_stand_ins(Player& player) {
    const Frame& frame = player.frame;
    if (frame.stand_ins.size() == frame.textures.size()) return;
    std::vector<GLuint> names(frame.textures.size());
    player.gl.GenTextures(GLsizei(names.size()), names.data());
    set_default_transfer(player.gl);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const TextureCopy& copy = frame.textures[i];
        player.gl.BindTexture(copy.target, names[i]);
        play_contents(player, copy.contents);
        player.gl.BindTexture(copy.target, 0);
    }
    frame.stand_ins = std::move(names);
}

bool has_copies(const Frame& frame) { return !frame.stand_ins.empty() || !frame.default_textures.empty(); }

void delete_copies(const Frame& frame, const GlTable& gl) {
    if (!has_copies(frame)) return;
    gl.DeleteTextures(GLsizei(frame.stand_ins.size()), frame.stand_ins.data());
    frame.stand_ins.clear();
    for (const auto& [target, name] : frame.default_textures) gl.DeleteTextures(1, &name);
    frame.default_textures.clear();
}

} // namespace glcast::record

namespace glcast::record::custom {

void play_BindTexture(Player& player, const Packet& packet) {
    Reader reader(packet);
    const auto target = reader.get<GLenum>();
    const auto name = reader.get<GLuint>();
    player.gl.BindTexture(target, player.textures.find(target, name));
}

void play_end_texture(Player& player, const Packet& packet) {
    Reader reader(packet);
    const auto number = reader.get<std::uint32_t>();
    player.textures.end(number, reader.get<std::uint32_t>() != 0);
}

} // namespace glcast::record::custom
