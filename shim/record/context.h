// What the recorder keeps: per thread, per context, per share group, per frame.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "capture/gl/gl_query.h"
#include "shim/record/record.h"
#include "shim/record/stream.h"

namespace glcast::record {

/// Contents of a buffer object as they were when the frame drew from it.
using Blob = std::shared_ptr<const std::vector<std::byte>>;
using List = std::shared_ptr<const Stream>;

/// A list that came, changed or went while a frame was recorded. Null: it was deleted.
struct ListChange {
    GLuint name;
    List list;
};

struct ShareGroup {
    std::mutex mutex; ///< guards all below: contexts of a group may live in different threads
    std::unordered_map<GLuint, List> lists;
    int recording = 0;               ///< contexts of the group that record a frame
    std::vector<ListChange> changes; ///< since the first of them began; emptied when the last has ended
    /// Contexts that record or compile: while there are any, `buffers` is true, whichever context of the
    /// group changes one.
    std::atomic<int> reading{0};
    std::unordered_map<GLuint, Blob>
        buffers; ///< copies of whole buffers, dropped when the program changes one
};

enum class Stack : std::uint8_t { modelview, projection, colour, texture0 }; // texture0 + unit
inline constexpr int max_texture_units = 32;
inline constexpr int stack_count = int(Stack::texture0) + max_texture_units;

struct Matrix {
    GLfloat m[16];
};
/// Bottom first. Entries below the top cannot be read without disturbing the program, so each is identity
/// until the program itself pops down to it; the ones it never comes to are never needed.
using MatrixStack = std::vector<Matrix>;

/// A texture as it was before the program changed or deleted it in the frame.
struct TextureCopy {
    GLuint name = 0; ///< the program's
    GLenum target = 0;
    Stream contents;  ///< its images and parameters
    Charge at_replay; ///< what the texture takes in the driver that replays make of it
};

struct Prepared; // prepare.h

struct Frame {
    int version = 0; ///< of the program's context, 10 * major + minor
    bool has_multitexture = false;
    GLenum matrix_mode = GL_MODELVIEW, active_texture = GL_TEXTURE0; ///< at the start
    Stream prologue, calls;
    MatrixStack stacks[stack_count];
    std::unordered_map<GLuint, List> lists; ///< as they stood at the start
    std::vector<List> redefinitions;        ///< by number, from define_list packets
    std::vector<Blob> blobs;                ///< by number, from draw packets
    std::vector<TextureCopy> textures;     ///< by number, from end_texture packets or nameless from the start
    mutable std::vector<GLuint> stand_ins; ///< texture objects that hold these, made by the first replay
    std::set<GLenum> filled_defaults;      ///< targets whose texture named 0 gets an image in the frame
    mutable std::map<GLenum, GLuint>
        default_textures; ///< target -> what replays bind for its texture named 0
    std::map<std::string, long> not_understood;
    mutable std::shared_ptr<Prepared>
        prepared; ///< by prepare(), before the first replay; null: played as recorded
};

/// What a context offers, read once.
struct Limits {
    int version = 0; ///< 10 * major + minor
    bool compatibility = false, es = false;
    int texture_units = 1, texture_coords = 1, lights = 8, clip_planes = 6, draw_buffers = 1;
    std::set<std::string, std::less<>> extensions;
    bool has(int since, const char* extension = nullptr) const {
        return version >= since || (extension && extensions.contains(extension));
    }
};

/// A frame that is being recorded.
struct Recording {
    std::shared_ptr<Frame> frame = std::make_shared<Frame>();
    std::vector<std::uint32_t> counts = std::vector<std::uint32_t>(gl_call_count);
    std::size_t seen_changes = 0; ///< of ShareGroup::changes
    int attrib_depth = 0;         ///< GL_ATTRIB_STACK_DEPTH that the frame reached at the lowest
    bool has_unread_matrices = false;
    int lowest[stack_count] = {}; ///< likewise of each matrix stack; 0: not watched, nothing lies below
    std::unordered_map<const void*, std::uint32_t> blob_numbers;
    std::unordered_map<GLuint, int> buffer_changes;
    struct TextureUse {
        GLenum target;
        std::uint64_t draws; ///< when it was bound first, or copied last
    };
    std::unordered_map<GLuint, TextureUse> textures;
    std::unordered_map<GLuint, std::uint32_t>
        nameless; ///< copies of those that no name finds, by what it was
    std::uint64_t draws = 0;
    bool calls_lists = false; ///< which may bind any texture
    std::optional<std::unordered_map<GLuint, GLenum>>
        list_textures;    ///< their targets; found when first asked for
    std::string given_up; ///< why; empty while all is well
};

/// A list that is being compiled.
struct Compilation {
    GLuint name;
    bool executes;
    std::shared_ptr<Stream> stream = std::make_shared<Stream>();
    Compilation(GLuint list, bool executes_too) : name(list), executes(executes_too) {}
};

/// One client array, as queried.
struct Array {
    GLenum kind;       ///< GL_VERTEX_ARRAY, ...
    std::uint8_t unit; ///< of texture coordinates
    GLint size;
    GLenum type;
    GLsizei stride; ///< as used, never 0
    bool normalized;
    GLuint buffer;
    const std::byte* pointer; ///< offset where `buffer` is not 0
};

struct Context {
    const GlTable& real;
    std::shared_ptr<ShareGroup> group;
    std::optional<Limits> limits;
    std::unique_ptr<Recording> recording;
    std::unique_ptr<Compilation> compilation;
    bool in_begin = false; ///< only true to life while `listening()`
    bool arrays_dirty = true;
    std::vector<Array> arrays;
    std::optional<std::uint32_t> restart; ///< the index that glArrayElement takes for a restart

    Context(const GlTable& table, std::shared_ptr<ShareGroup> share_group)
        : real(table), group(std::move(share_group)) {}
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context();

    bool listening() const { return recording || compilation; }
    /// False when GL would raise an error for any query.
    bool can_query() const { return !in_begin; }
    const Limits& get_limits();
    void start_listening();
    void stop_listening();
    void give_up_frame(const char* why);
    void give_up_list();
    void count(GlCall call) {
        if (recording) ++recording->counts[std::size_t(call)];
    }
    void count(const std::string& reason, long times = 1);
    void note_draw() {
        if (recording) ++recording->draws;
        if (compilation) compilation->stream->draws = true;
    }
    void note_list_call() {
        if (!recording) return;
        ++recording->draws;
        recording->calls_lists = true;
    }

    /// Runs `write(stream)` for the list that is open, if this call compiles into lists, and for the frame,
    /// if the call is executed now. Out of memory ends the list or the frame, never the program.
    template <class Write> void emit(bool compiles, Write&& write) noexcept {
        if (compiles && compilation) {
            try {
                if (!compilation->stream->opaque) write(*compilation->stream);
            } catch (const std::exception&) {
                give_up_list();
            }
            if (!compilation->executes) return;
        }
        if (!recording || !recording->given_up.empty()) return;
        try {
            write(recording->frame->calls);
        } catch (const std::exception&) {
            give_up_frame("out of memory");
        }
    }
    /// Whether a call that compiles into lists is also executed now.
    bool executes() const { return !compilation || compilation->executes; }
};

struct Thread {
    Context* context = nullptr;
    const GlTable* real = nullptr;
};
extern thread_local Thread this_thread [[gnu::tls_model("initial-exec")]];

inline Context* listening_context() {
    Context* context = this_thread.context;
    return context && context->listening() ? context : nullptr;
}

/// Of calls that change objects which a frame or list of another context of the share group may read.
inline Context* changing_context() {
    Context* context = this_thread.context;
    return context && context->group->reading.load(std::memory_order_relaxed) > 0 ? context : nullptr;
}

} // namespace glcast::record
