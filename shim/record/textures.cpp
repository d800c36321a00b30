#include "shim/record/textures.h"

#include <algorithm>

#include "shim/record/bound_objects.h"
#include "shim/record/packets.h"
#include "shim/record/snapshot.h"

namespace glcast::record {
namespace {

/// glPixelTransfer at its defaults for as long as it lives: it applies to glGetTexImage too.
class DefaultTransfer {
  public:
    explicit DefaultTransfer(const GlTable& table) : gl(table) {
        for (std::size_t i = 0; i < std::size(rows); ++i) {
            gl.GetFloatv(rows[i].name, &before[i]);
            if (before[i] != rows[i].value) gl.PixelTransferf(rows[i].name, rows[i].value);
        }
    }
    ~DefaultTransfer() {
        for (std::size_t i = 0; i < std::size(rows); ++i)
            if (before[i] != rows[i].value) gl.PixelTransferf(rows[i].name, before[i]);
    }
    DefaultTransfer(const DefaultTransfer&) = delete;
    DefaultTransfer& operator=(const DefaultTransfer&) = delete;

  private:
    const GlTable& gl;
    struct Row {
        GLenum name;
        GLfloat value;
    };
    static constexpr Row rows[] = {{GL_MAP_COLOR, 0},  {GL_RED_SCALE, 1},   {GL_GREEN_SCALE, 1},
                                   {GL_BLUE_SCALE, 1}, {GL_ALPHA_SCALE, 1}, {GL_DEPTH_SCALE, 1},
                                   {GL_RED_BIAS, 0},   {GL_GREEN_BIAS, 0},  {GL_BLUE_BIAS, 0},
                                   {GL_ALPHA_BIAS, 0}, {GL_DEPTH_BIAS, 0}};
    GLfloat before[std::size(rows)] = {};
};

/// Of colours or depths: integers and stencils are read in other ways, which fixed functions never need.
bool is_sampled(Context& context, GLenum target) {
    const GLenum image = target == GL_TEXTURE_CUBE_MAP ? GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X) : target;
    const auto get = [&](GLenum name) {
        GLint value = 0;
        context.real.GetTexLevelParameteriv(image, 0, name, &value);
        return value;
    };
    if (get(GL_TEXTURE_WIDTH) <= 0) return false;
    const Limits& limits = context.get_limits();
    if (limits.has(30)) {
        if (limits.has(44) && get(GL_TEXTURE_STENCIL_SIZE) > 0 && get(GL_TEXTURE_DEPTH_SIZE) == 0)
            return false;
        for (const GLenum type :
             {GL_TEXTURE_RED_TYPE, GL_TEXTURE_GREEN_TYPE, GL_TEXTURE_BLUE_TYPE, GL_TEXTURE_ALPHA_TYPE})
            if (const GLint is = get(type); is == GL_INT || is == GL_UNSIGNED_INT) return false;
    }
    return true;
}

/// What a texture like the one that is bound takes in a driver, about: whole words a texel, and a third more for smaller
/// levels.
std::size_t driver_bytes(Context& context, GLenum target) {
    const bool is_cube = target == GL_TEXTURE_CUBE_MAP;
    const auto get = [&](GLenum name) {
        GLint value = 0;
        context.real.GetTexLevelParameteriv(is_cube ? GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X) : target, 0, name, &value);
        return std::size_t(std::max(value, 0));
    };
    std::size_t bits = 0;
    for (const GLenum size : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE,
                              GL_TEXTURE_LUMINANCE_SIZE, GL_TEXTURE_INTENSITY_SIZE})
        bits += get(size);
    if (context.get_limits().has(14)) bits += get(GL_TEXTURE_DEPTH_SIZE);
    const std::size_t depth = context.get_limits().has(12) ? std::max<std::size_t>(get(GL_TEXTURE_DEPTH), 1) : 1;
    const std::size_t texels = get(GL_TEXTURE_WIDTH) * std::max<std::size_t>(get(GL_TEXTURE_HEIGHT), 1) * depth;
    return texels * ((bits + 31) / 32 * 4) * (is_cube ? 6 : 1) / 3 * 4;
}

/// Keeps what the texture that is bound to `target` holds now; its number, or nothing where fixed functions
/// do not sample it.
std::optional<std::uint32_t> copy_bound(Context& context, GLuint name, GLenum target) {
    Recording& recording = *context.recording;
    if (!is_sampled(context, target)) return std::nullopt;
    TextureCopy copy{name, target, {}, {}};
    {
        const DefaultTransfer transfer(context.real);
        write_texture(context, copy.contents, target);
    }
    copy.contents.shrink();
    copy.at_replay = Charge(driver_bytes(context, target));
    recording.frame->textures.push_back(std::move(copy));
    return std::uint32_t(recording.frame->textures.size() - 1);
}

void emit_end(Context& context, std::uint32_t number, bool deleted) {
    context.emit(false, [&](Stream& stream) {
        Writer(stream.append(Op(ExtraOp::end_texture), 8)).put(number).put(std::uint32_t(deleted));
    });
}

void copy_texture(Context& context, GLuint name, GLenum target, bool deleted) {
    std::optional<std::uint32_t> number;
    if (const BoundTexture bound(context, target, name); bound) number = copy_bound(context, name, target);
    if (number) emit_end(context, *number, deleted);
}

void end_texture(Context& context, GLuint name, GLenum target, bool deleted) {
    Recording& recording = *context.recording;
    const auto [use, is_new] = recording.textures.try_emplace(name, Recording::TextureUse{target, 0});
    if (recording.draws == use->second.draws) return; // nothing can have been drawn from it
    use->second = {target, recording.draws};
    if (recording.nameless.contains(name))
        return context.count("a texture changed that another context has deleted");
    // While a list is open, binding the texture for it would go into the list.
    if (context.compilation)
        return context.count("a texture changed while a list was made, after it was drawn from");
    try {
        copy_texture(context, name, target, deleted);
    } catch (const std::exception&) {
        context.count("a texture changed after it was drawn from, and too large to copy");
    }
}

/// What the display lists bind that stood when the frame began.
void find_list_textures(Recording& recording) {
    recording.list_textures.emplace();
    for (const auto& [name, list] : recording.frame->lists)
        list->for_each([&](const Packet& packet) {
            if (packet.op != Op(GlCall::BindTexture)) return;
            Reader reader(packet);
            const auto target = reader.get<GLenum>();
            recording.list_textures->emplace(reader.get<GLuint>(), target);
        });
}

/// 0: not known, so nothing can have been drawn from it.
GLenum target_of(Context& context, GLuint name) {
    Recording& recording = *context.recording;
    if (const auto use = recording.textures.find(name); use != recording.textures.end())
        return use->second.target;
    if (!recording.calls_lists) return 0;
    if (!recording.list_textures) find_list_textures(recording);
    const auto found = recording.list_textures->find(name);
    if (found == recording.list_textures->end() || !texture_binding(found->second)) return 0;
    return context.real.IsTexture(name) ? found->second : 0;
}

/// What is noted here must not end the program where memory runs out.
template <class Work> void guarded(Context& context, Work&& work) noexcept {
    try {
        if (context.recording->given_up.empty()) work(*context.recording);
    } catch (const std::exception&) {
        context.give_up_frame("out of memory");
    }
}

void note_deletion(Context& context, GLuint name) {
    guarded(context, [&](Recording& recording) {
        if (recording.nameless.contains(name)) return; // another's name, or nobody's
        if (const GLenum target = target_of(context, name)) end_texture(context, name, target, true);
        recording.textures.erase(name); // the name may come again as another texture's
    });
}

} // namespace

void note_bound_textures(Recording& recording) {
    recording.frame->prologue.for_each([&](const Packet& packet) {
        if (packet.op != Op(GlCall::BindTexture)) return;
        Reader reader(packet);
        const auto target = reader.get<GLenum>();
        if (const auto name = reader.get<GLuint>())
            recording.textures.try_emplace(name, Recording::TextureUse{target, 0});
    });
}

void copy_nameless_textures(Context& context) {
    const GlTable& gl = context.real;
    const Limits& limits = context.get_limits();
    std::vector<std::pair<GLuint, GLenum>> nameless;
    for (const auto& [name, use] : context.recording->textures)
        if (!gl.IsTexture(name)) nameless.emplace_back(name, use.target);
    if (nameless.empty()) return;
    const auto active = limits.has(13) ? GLenum(get_int(gl, GL_ACTIVE_TEXTURE, GL_TEXTURE0)) : 0;
    for (const auto& [name, target] : nameless)
        for (int unit = 0; unit < limits.texture_units; ++unit) {
            if (active) gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
            if (GLuint(get_int(gl, texture_binding(target))) != name) continue;
            guarded(context, [&, name = name, target = target](Recording& recording) {
                if (const auto number = copy_bound(context, name, target)) recording.nameless[name] = *number;
            });
            break;
        }
    if (active) gl.ActiveTexture(active);
}

void copy_before_change(Context& context, GLenum target) {
    if (!context.recording || !context.executes()) return;
    GLenum object = 0;
    const GLenum binding = texture_binding(target, &object);
    if (const GLint name = binding ? get_int(context.real, binding) : 0)
        guarded(context, [&](Recording&) { end_texture(context, GLuint(name), object, false); });
}

bool note_default_filled(Context& context, GLenum target) {
    GLenum object = 0;
    const GLenum binding = texture_binding(target, &object);
    if (!binding || get_int(context.real, binding, -1) != 0) return false;
    if (context.recording)
        guarded(context, [&](Recording& recording) { recording.frame->filled_defaults.insert(object); });
    return true;
}

} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY BindTexture(GLenum target, GLuint name) {
    Context* context = listening_context();
    if (context)
        context->emit(true, [&](Stream& stream) { packets::BindTexture::write(stream, target, name); });
    if (context && context->recording && context->executes())
        if (const auto gone = context->recording->nameless.extract(name))
            emit_end(*context, gone.mapped(), false); // the name is another object's, from now on
    const Recording* recording =
        context && context->executes() && context->can_query() ? context->recording.get() : nullptr;
    const GLenum binding =
        recording && name && !recording->textures.contains(name) ? texture_binding(target) : 0;
    const bool lists_may_have = binding && recording->calls_lists && context->real.IsTexture(name);
    this_thread.real->BindTexture(target, name);
    if (!binding || GLuint(get_int(context->real, binding)) != name) return; // known, or refused
    guarded(*context, [&](Recording& of) {
        of.textures.try_emplace(name, Recording::TextureUse{target, lists_may_have ? 0 : of.draws});
    });
}

void APIENTRY DeleteTextures(GLsizei n, const GLuint* names) {
    Context* context = listening_context();
    if (context && context->recording && context->can_query() && names)
        for (GLsizei i = 0; i < n; ++i)
            if (names[i]) note_deletion(*context, names[i]);
    this_thread.real->DeleteTextures(n, names);
}

} // namespace glcast::record::custom
