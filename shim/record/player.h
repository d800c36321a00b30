// Plays packets into a GlTable: the state of one replay.
#pragma once
#include <functional>
#include <unordered_map>
#include <vector>

#include "shim/record/context.h"
#include "shim/record/default_textures.h"
#include "shim/record/texture_stand_ins.h"

namespace glcast::record {

/// How to play each packet, indexed by Op: the entry points (null where none is recorded), then the extra
/// ones.
extern const PlayFunction play_functions[];

/// Packets that are no entry points.
enum class ExtraOp : Op {
    draw = gl_call_count, ///< one glDrawArrays or glDrawElements with its arrays
    define_list,
    delete_list,
    end_texture, ///< the program changes or deletes a texture: the copy of it is no longer what it draws from
    count_
};

class Player {
  public:
    Player(const Frame& recorded, const GlTable& table)
        : gl(table), frame(recorded), defaults(recorded, table), textures(recorded, table, defaults) {}
    void run(const std::function<void()>& before_calls);
    void play(const Stream& stream);
    void play(const Packet& packet) {
        if (const PlayFunction function = play_functions[packet.op]) function(*this, packet);
    }
    void call_list(GLuint name);
    void set_list(GLuint name, const Stream* list) { changed_lists[name] = list; }

    /// Why draws cannot be played now: programs that we do not replay, selection.
    enum Skip : unsigned { glsl = 1, pipeline = 2, vertex_program = 4, fragment_program = 8, selecting = 16 };
    bool skips_draws() const { return state.skip != 0; }
    void set_skip(Skip reason, bool on) {
        state.skip = on ? state.skip | reason : state.skip & ~unsigned(reason);
    }

    void push_attrib(GLbitfield mask);
    void pop_attrib();

    /// What later packets depend on, and glPushAttrib saves; followed here because `gl` may drop calls.
    struct State {
        unsigned skip = 0;
        GLuint list_base = 0;
    } state;
    const GlTable& gl;
    const Frame& frame;
    DefaultTextures defaults;
    TextureStandIns textures;

  private:
    void reset_client_state();
    void empty_stacks();
    void load_stacks();
    const Stream* find_list(GLuint name) const;

    static constexpr int max_depth = 64; // Mesa's MAX_LIST_NESTING, and the least that GL asks for
    int depth = 0;
    struct Saved {
        GLbitfield mask;
        State state;
    };
    std::vector<Saved> saved;
    std::unordered_map<GLuint, const Stream*> changed_lists;
};

} // namespace glcast::record
