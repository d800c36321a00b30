#include "shim/record/player.h"

#include <algorithm>

#include "shim/record/prepare.h"
#include "shim/record/snapshot.h"
#include "shim/record/state.h"

namespace glcast::record {

void Player::run(const std::function<void()>& before_calls) {
    reset_client_state();
    make_stand_ins(*this);
    defaults.begin(*this);
    empty_stacks();
    play(frame.prologue); // leaves an identity modelview: it sets lights and planes in eye space
    load_stacks();
    if (before_calls) before_calls();
    play(frame.calls);
}

void Player::play(const Stream& stream) {
    const auto play_one = [this](const Packet& packet) { play(packet); };
    if (const auto* runs = frame.prepared ? frame.prepared->runs_of(stream) : nullptr)
        for (const Stream::Run& run : *runs) Stream::for_each(run, play_one);
    else
        stream.for_each(play_one);
}

const Stream* Player::find_list(GLuint name) const {
    if (const auto changed = changed_lists.find(name); changed != changed_lists.end()) return changed->second;
    const auto found = frame.lists.find(name);
    return found == frame.lists.end() ? nullptr : found->second.get();
}

void Player::call_list(GLuint name) {
    const Stream* list = find_list(name);
    if (!list || depth == max_depth) return;
    ++depth;
    play(*list);
    --depth;
}

namespace {
constexpr GLint deepest = 256; // no GL has deeper stacks; guards against a table that answers nonsense

/// Counts before it pops, as the loop over matrices does: `gl` may swallow the pops of a stack that it keeps
/// for itself.
void pop_attributes(const GlTable& gl) {
    const GLint attribs = std::min(get_int(gl, GL_ATTRIB_STACK_DEPTH), deepest);
    for (GLint i = 0; i < attribs; ++i) gl.PopAttrib();
}

void select_unit(const GlTable& gl, const Frame& frame, int stack) {
    const int unit = stack - int(Stack::texture0);
    if (unit >= 0 && frame.has_multitexture) gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
}
} // namespace

void Player::reset_client_state() {
    if (frame.version >= 30) gl.BindVertexArray(0);
    if (frame.version >= 15) {
        gl.BindBuffer(GL_ARRAY_BUFFER, 0);
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    }
    if (frame.version >= 21) gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    // How images are laid out in packets.
    for (const GLenum name : {GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH,
                              GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
        gl.PixelStorei(name, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (frame.version < 12) return;
    gl.PixelStorei(GL_UNPACK_SKIP_IMAGES, 0);
    gl.PixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
}

void Player::empty_stacks() {
    pop_attributes(gl);
    for (int stack = 0; stack < stack_count; ++stack) {
        if (frame.stacks[stack].empty()) continue;
        select_unit(gl, frame, stack);
        const StackNames names = stack_names(stack);
        gl.MatrixMode(names.mode);
        const GLint matrices = std::min(get_int(gl, names.depth, 1), deepest);
        for (GLint i = 1; i < matrices; ++i) gl.PopMatrix();
    }
}

void Player::load_stacks() {
    for (int stack = 0; stack < stack_count; ++stack) {
        const MatrixStack& matrices = frame.stacks[stack];
        if (matrices.empty()) continue;
        select_unit(gl, frame, stack);
        gl.MatrixMode(stack_names(stack).mode);
        for (std::size_t i = 0; i < matrices.size(); ++i) {
            if (i) gl.PushMatrix();
            gl.LoadMatrixf(matrices[i].m);
        }
    }
    if (frame.has_multitexture) gl.ActiveTexture(frame.active_texture);
    gl.MatrixMode(frame.matrix_mode);
}

void Player::push_attrib(GLbitfield mask) { saved.push_back({mask, state}); }

void Player::pop_attrib() {
    if (saved.empty()) return;
    const Saved& top = saved.back();
    constexpr unsigned programs = vertex_program | fragment_program;
    if (top.mask & GL_ENABLE_BIT) state.skip = (state.skip & ~programs) | (top.state.skip & programs);
    if (top.mask & GL_LIST_BIT) state.list_base = top.state.list_base;
    saved.pop_back();
}

void let_go(const Frame& frame, const GlTable& gl) {
    pop_attributes(gl);
    const GLenum most = frame.version >= 20 ? GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS : GL_MAX_TEXTURE_UNITS;
    const int units = frame.has_multitexture ? get_int(gl, most, 1) : 1;
    for (int unit = 0; unit < units; ++unit) {
        if (frame.has_multitexture) gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
        for (const GLenum target :
             {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE})
            if (get_int(gl, texture_binding(target))) gl.BindTexture(target, 0);
    }
    if (frame.has_multitexture) gl.ActiveTexture(GL_TEXTURE0);
    for (int i = 0; i < 8 && gl.GetError() != GL_NO_ERROR; ++i) {
    } // not every version has every target
}

void replay(const Frame& frame, const GlTable& gl, const std::function<void()>& before_calls) {
    Player(frame, gl).run(before_calls);
}

} // namespace glcast::record
