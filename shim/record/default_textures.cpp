#include "shim/record/default_textures.h"

#include <algorithm>
#include <bit>

#include "shim/record/packets.h"
#include "shim/record/player.h"
#include "shim/record/snapshot.h"

namespace glcast::record {
namespace {

void clear_image(const GlTable& gl, GLenum target, GLint level) {
    if (target == GL_TEXTURE_1D)
        gl.TexImage1D(target, level, GL_RGBA, 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    else if (target == GL_TEXTURE_3D)
        gl.TexImage3D(target, level, GL_RGBA, 0, 0, 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    else
        gl.TexImage2D(target, level, GL_RGBA, 0, 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
}

/// How many a texture can have.
GLint count_levels(const GlTable& gl, GLenum object) {
    if (object == GL_TEXTURE_RECTANGLE) return 1;
    const GLenum limit = object == GL_TEXTURE_3D         ? GL_MAX_3D_TEXTURE_SIZE
                         : object == GL_TEXTURE_CUBE_MAP ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                                                         : GL_MAX_TEXTURE_SIZE;
    return std::bit_width(unsigned(std::max(get_int(gl, limit, 1), 1)));
}

/// Of the texture that is bound.
void clear_images(const GlTable& gl, GLenum object) {
    const int faces = object == GL_TEXTURE_CUBE_MAP ? 6 : 1;
    const GLint levels = count_levels(gl, object);
    for (int face = 0; face < faces; ++face) {
        const GLenum target = faces == 6 ? GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face) : object;
        for (GLint level = 0; level < levels; ++level) {
            GLint width = 0;
            gl.GetTexLevelParameteriv(target, level, GL_TEXTURE_WIDTH, &width);
            if (width > 0) clear_image(gl, target, level);
        }
    }
}

} // namespace

DefaultTextures::DefaultTextures(const Frame& of, const GlTable& table) : frame(of), gl(table) {}

void DefaultTextures::begin(Player& player) {
    for (const GLenum object : frame.filled_defaults)
        if (!find(object)) make(player, object);
    for (const auto& [object, name] : frame.default_textures) {
        gl.BindTexture(object, name);
        clear_images(gl, object);
    }
}

GLuint DefaultTextures::find(GLenum target) const {
    const auto found = frame.default_textures.find(target);
    return found == frame.default_textures.end() ? 0 : found->second;
}

bool DefaultTextures::is_bound(GLenum target) const {
    GLenum object = 0;
    const GLenum binding = texture_binding(target, &object);
    return binding && GLuint(get_int(gl, binding, -1)) == find(object);
}

void DefaultTextures::play_image(Player& player, const Packet& packet, PlayFunction play) {
    const auto target = Reader(packet).get<GLenum>();
    if (!is_bound(target)) return;
    GLenum object = 0;
    texture_binding(target, &object);
    if (!find(object)) make(player, object);
    play(player, packet);
}

void DefaultTextures::play_parameter(Player& player, const Packet& packet, PlayFunction play) {
    const auto target = Reader(packet).get<GLenum>();
    if (!is_bound(target)) return;
    if (find(target))
        play(player, packet);
    else
        parameters[target].push_back({packet, play});
}

void DefaultTextures::play_mipmap(Player& player, const Packet& packet, PlayFunction play) {
    const auto target = Reader(packet).get<GLenum>();
    if (find(target) && is_bound(target)) play(player, packet);
}

void DefaultTextures::attributes_were_popped() const {
    for (const auto& [object, name] : frame.default_textures) bind_wherever_0_is(object, name);
}

void DefaultTextures::make(Player& player, GLenum object) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    frame.default_textures.emplace(object, name);
    bind_wherever_0_is(object, name);
    for (const Parameter& parameter : parameters[object]) parameter.play(player, parameter.packet);
    parameters.erase(object);
}

void DefaultTextures::bind_wherever_0_is(GLenum object, GLuint name) const {
    const GLenum binding = texture_binding(object);
    if (!frame.has_multitexture) {
        if (get_int(gl, binding) == 0) gl.BindTexture(object, name);
        return;
    }
    const auto active = GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0));
    const int units = std::min(get_int(gl, GL_MAX_TEXTURE_UNITS, 1), max_texture_units);
    for (int unit = 0; unit < units; ++unit) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        if (get_int(gl, binding) == 0) gl.BindTexture(object, name);
    }
    gl.ActiveTexture(active);
}

} // namespace glcast::record

namespace glcast::record::custom {

#define PLAY(kind, call)                                                                                     \
    void play_##call(Player& player, const Packet& packet) {                                                 \
        player.defaults.play_##kind(player, packet, packets::call::play);                                    \
    }
PLAY(image, TexImage1D)
PLAY(image, TexImage2D)
PLAY(image, TexImage3D)
PLAY(image, TexSubImage1D)
PLAY(image, TexSubImage2D)
PLAY(image, TexSubImage3D)
PLAY(image, CompressedTexImage1D)
PLAY(image, CompressedTexImage2D)
PLAY(image, CompressedTexImage3D)
PLAY(image, CompressedTexSubImage1D)
PLAY(image, CompressedTexSubImage2D)
PLAY(image, CompressedTexSubImage3D)
PLAY(mipmap, GenerateMipmap)
PLAY(parameter, TexParameterf)
PLAY(parameter, TexParameteri)
PLAY(parameter, TexParameterfv)
PLAY(parameter, TexParameteriv)
#undef PLAY

} // namespace glcast::record::custom
