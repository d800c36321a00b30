#include "shim/record/context.h"

#include <cstdlib>
#include <cstring>

namespace glcast::record {

std::atomic<std::uint32_t> active{0};
thread_local Thread this_thread;

namespace {

int parse_version(const char* text) {
    // "3.1 Mesa 22.3.6"; anything else before the digits is an OpenGL ES.
    char* dot = nullptr;
    const long major = std::strtol(text, &dot, 10);
    return dot == text || *dot != '.' ? 0 : int(10 * major + std::strtol(dot + 1, nullptr, 10) % 10);
}

void read_extensions(const GlTable& gl, Limits& limits) {
    if (limits.version >= 30) {
        for (GLint i = 0, n = get_int(gl, GL_NUM_EXTENSIONS); i < n; ++i)
            if (const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, GLuint(i)))
                limits.extensions.emplace(reinterpret_cast<const char*>(name));
        return;
    }
    const GLubyte* all = gl.GetString(GL_EXTENSIONS);
    for (const char* at = reinterpret_cast<const char*>(all); at && *at;) {
        const std::size_t length = std::strcspn(at, " ");
        if (length) limits.extensions.emplace(at, length);
        at += length + (at[length] == ' ');
    }
}

bool is_compatibility(const GlTable& gl, const Limits& limits) {
    if (limits.es || limits.version == 0) return false;
    if (limits.version < 31) return true;
    if (limits.version == 31) return limits.extensions.contains("GL_ARB_compatibility");
    return !(get_int(gl, GL_CONTEXT_PROFILE_MASK) & GL_CONTEXT_CORE_PROFILE_BIT); // 0 from some drivers
}

Limits read_limits(const GlTable& gl) {
    Limits limits;
    const GLubyte* version = gl.GetString(GL_VERSION);
    if (!version) return limits;
    limits.es = std::strncmp(reinterpret_cast<const char*>(version), "OpenGL ES", 9) == 0;
    if (limits.es) return limits;
    limits.version = parse_version(reinterpret_cast<const char*>(version));
    read_extensions(gl, limits);
    limits.compatibility = is_compatibility(gl, limits);
    if (!limits.compatibility) return limits;
    if (limits.has(13, "GL_ARB_multitexture")) {
        limits.texture_units = std::min(get_int(gl, GL_MAX_TEXTURE_UNITS, 1), max_texture_units);
        limits.texture_coords = limits.texture_units;
        if (limits.has(20))
            limits.texture_coords = std::min(get_int(gl, GL_MAX_TEXTURE_COORDS, 1), max_texture_units);
    }
    limits.lights = get_int(gl, GL_MAX_LIGHTS, 8);
    limits.clip_planes = get_int(gl, GL_MAX_CLIP_PLANES, 6);
    if (limits.has(20)) limits.draw_buffers = std::min(get_int(gl, GL_MAX_DRAW_BUFFERS, 1), 16);
    return limits;
}

} // namespace

const Limits& Context::get_limits() {
    if (!limits) limits = read_limits(real);
    return *limits;
}

void Context::start_listening() {
    arrays_dirty = true;
    in_begin = false; // both a frame and a list begin outside of glBegin
    active.fetch_add(1, std::memory_order_relaxed);
    const std::lock_guard lock(group->mutex);
    ++group->reading;
}

void Context::stop_listening() {
    active.fetch_sub(1, std::memory_order_relaxed);
    const std::lock_guard lock(group->mutex);
    if (--group->reading == 0) group->buffers.clear();
}

void Context::give_up_frame(const char* why) {
    if (!recording || !recording->given_up.empty()) return;
    recording->given_up = why;
    recording->frame->prologue = Stream();
    recording->frame->calls = Stream();
}

void Context::give_up_list() {
    *compilation->stream = Stream();
    compilation->stream->opaque = true;
}

void Context::count(const std::string& reason, long times) {
    if (recording) recording->frame->not_understood[reason] += times;
}

Context::~Context() {
    if (compilation) {
        compilation.reset();
        stop_listening();
    }
    if (recording) {
        {
            const std::lock_guard lock(group->mutex);
            if (--group->recording == 0) group->changes.clear();
        }
        recording.reset();
        stop_listening();
    }
}

std::shared_ptr<Context> make_context(const GlTable& real, const std::shared_ptr<Context>& shared_with) {
    return std::make_shared<Context>(real, shared_with ? shared_with->group : std::make_shared<ShareGroup>());
}

bool share_objects(const Context& a, const Context& b) { return a.group == b.group; }

void set_current(Context* context, const GlTable& fallback) {
    this_thread.context = context;
    this_thread.real = context ? &context->real : &fallback;
}

} // namespace glcast::record
