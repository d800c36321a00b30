#include "shim/record/buffers.h"

#include <algorithm>

#include "shim/record/bound_objects.h"

namespace glcast::record {

namespace {

struct Target {
    GLenum target, binding;
    int since;
};
constexpr Target targets[] = {
    {GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING, 15},
    {GL_ELEMENT_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER_BINDING, 15},
    {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING, 21},
    {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING, 21},
    {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING, 31},
    {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING, 31},
    {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, 31},
    {GL_TRANSFORM_FEEDBACK_BUFFER, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, 30},
    {GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER, 31}, // the binding is asked for by the target's own name
    {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING, 43},
};

std::size_t size_of(const BoundBuffer& buffer) {
    return std::size_t(std::max(buffer.parameter(GL_BUFFER_SIZE), 0));
}

bool is_persistent(const BoundBuffer& buffer, const Limits& limits) {
    return limits.has(44, "GL_ARB_buffer_storage") && buffer.parameter(GL_BUFFER_MAPPED) &&
           (buffer.parameter(GL_BUFFER_ACCESS_FLAGS) & GL_MAP_PERSISTENT_BIT);
}

bool is_readable(const BoundBuffer& buffer, const Limits& limits) {
    return !buffer.parameter(GL_BUFFER_MAPPED) || is_persistent(buffer, limits);
}

constexpr int changes_worth_copies = 2; // after these, a buffer is read piece by piece

} // namespace

GLuint bound_buffer(const GlTable& gl, GLenum target) {
    for (const Target& row : targets)
        if (row.target == target) return GLuint(get_int(gl, row.binding));
    return 0;
}

void forget_buffer(Context& context, GLuint name) {
    const std::lock_guard lock(context.group->mutex);
    if (name)
        context.group->buffers.erase(name);
    else
        context.group->buffers.clear();
}

ForgetBuffer::ForgetBuffer(Context* changing, GLenum target_or_name, NamedBy by) : context(changing) {
    if (!context || (context->listening() && !context->can_query())) {
        context = nullptr; // inside glBegin the call fails
        return;
    }
    name = target_or_name;
    if (by == by_target) {
        const int version = context->get_limits().version;
        name = 0;
        for (const Target& row : targets)
            if (row.target == target_or_name && version >= row.since)
                name = bound_buffer(context->real, row.target);
    }
    if (!name) context = nullptr;
}

ForgetBuffer::~ForgetBuffer() {
    if (!context) return;
    if (context->recording) ++context->recording->buffer_changes[name];
    forget_buffer(*context, name);
}

bool read_buffer(Context& context, GLuint name, std::size_t offset, void* to, std::size_t bytes) {
    if (!context.can_query() || !context.real.IsBuffer(name)) return false;
    const BoundBuffer buffer(context, name);
    const std::size_t size = size_of(buffer);
    if (offset > size || bytes > size - offset || !is_readable(buffer, context.get_limits())) return false;
    buffer.read(offset, to, bytes);
    return true;
}

Blob whole_buffer(Context& context, GLuint name) {
    ShareGroup& group = *context.group;
    {
        const std::lock_guard lock(group.mutex);
        if (const auto found = group.buffers.find(name); found != group.buffers.end()) return found->second;
    }
    if (!context.can_query() || !context.real.IsBuffer(name)) return nullptr;
    if (context.recording && context.recording->buffer_changes[name] > changes_worth_copies) return nullptr;
    const BoundBuffer buffer(context, name);
    const Limits& limits = context.get_limits();
    if (!is_readable(buffer, limits) || is_persistent(buffer, limits)) return nullptr;
    const std::size_t size = size_of(buffer);
    struct Copy {
        Charge charge;
        std::vector<std::byte> bytes;
    };
    const auto made = std::make_shared<Copy>(Copy{Charge(size), std::vector<std::byte>(size)});
    const std::shared_ptr<std::vector<std::byte>> copy(made, &made->bytes);
    buffer.read(0, copy->data(), copy->size());
    const std::lock_guard lock(group.mutex);
    return group.buffers[name] = copy;
}

} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY DeleteBuffers(GLsizei n, const GLuint* buffers) {
    Context* context = changing_context();
    this_thread.real->DeleteBuffers(n, buffers);
    if (!context) return;
    context->arrays_dirty = true; // arrays of the current vertex array object lose their binding
    for (GLsizei i = 0; i < n; ++i)
        if (buffers[i]) forget_buffer(*context, buffers[i]);
}

void APIENTRY EndTransformFeedback() {
    this_thread.real->EndTransformFeedback();
    if (Context* context = changing_context()) {
        context->count("geometry captured by transform feedback");
        forget_buffer(*context, 0); // it may have written any of them
    }
}

} // namespace glcast::record::custom
