// glDrawArrays, glDrawElements and their kin: what they read is copied when they are called.
#include <algorithm>
#include <limits>

#include "shim/record/arrays.h"
#include "shim/record/buffers.h"
#include "shim/record/draw_packet.h"
#include "shim/record/packets.h"
#include "shim/record/readable.h"

namespace glcast::record {

namespace {

struct Call {
    GLenum mode;
    GLsizei count;
    GLint first = 0;
    GLenum index_type = 0; ///< 0: glDrawArrays
    const void* indices = nullptr;
    GLint base_vertex = 0;
    GLsizei instances = 1;
};

/// The indices of a call in client memory, and where to find them at replay.
struct Indices {
    const std::byte* data = nullptr;
    std::size_t bytes = 0;
    Blob blob; ///< where they come from a buffer that is kept
    std::size_t blob_offset = 0;
    std::vector<std::byte> own; ///< where they were read or rewritten for this draw
    std::vector<DrawSegment> segments;
    std::int64_t base = 0;        ///< added to each index
    std::int64_t lo = 0, hi = -1; ///< range of vertices, base included
    std::uint32_t largest = 0;    ///< index, base not included
    std::size_t used = 0;         ///< how many indices are not restarts
};

/// What one array contributes: bytes in the packet, or a reference to a blob.
struct Source {
    const Array* array = nullptr;
    const std::byte* from = nullptr; ///< of vertex `lo`
    Blob blob;                       ///< referenced where the draw may
    std::int64_t blob_element_0 = 0;
    std::vector<std::byte> own;
};

struct Draw {
    Context& context;
    const Call& call;
    Indices indices;
    std::vector<std::uint32_t> picked; ///< vertices used, ascending, where the range is sparse
    std::vector<Source> sources;
    bool may_refer; ///< to copies of whole buffers; display lists live long and take only what they need
};

std::size_t index_bytes(GLenum type) {
    switch (type) {
    case GL_UNSIGNED_BYTE:
        return 1;
    case GL_UNSIGNED_SHORT:
        return 2;
    case GL_UNSIGNED_INT:
        return 4;
    default:
        return 0;
    }
}

template <class Visitor>
void for_each_index(const std::byte* data, GLenum type, std::size_t count, Visitor&& visit) {
    const std::size_t bytes = index_bytes(type);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t index = 0;
        std::memcpy(&index, data + i * bytes, bytes); // little-endian, as all platforms with a desktop GL
        visit(i, index);
    }
}

bool find_indices(Draw& draw) {
    Indices& indices = draw.indices;
    const Call& call = draw.call;
    indices.bytes = std::size_t(call.count) * index_bytes(call.index_type);
    Context& context = draw.context;
    const GLuint buffer =
        context.get_limits().has(15) ? bound_buffer(context.real, GL_ELEMENT_ARRAY_BUFFER) : 0;
    if (!buffer) {
        indices.data = static_cast<const std::byte*>(call.indices);
        return indices.data;
    }
    const auto offset = reinterpret_cast<std::uintptr_t>(call.indices);
    if (draw.may_refer) indices.blob = whole_buffer(context, buffer);
    if (indices.blob) {
        if (offset > indices.blob->size() || indices.bytes > indices.blob->size() - offset) return false;
        indices.data = indices.blob->data() + offset;
        indices.blob_offset = offset;
        return true;
    }
    indices.own.resize(indices.bytes);
    indices.data = indices.own.data();
    return read_buffer(context, buffer, offset, indices.own.data(), indices.bytes);
}

/// Range and segments of the indices. A segment ends at each restart index.
void scan_indices(Draw& draw) {
    Indices& indices = draw.indices;
    const Call& call = draw.call;
    const std::optional<std::uint32_t> restart = restart_index(draw.context, call.index_type);
    std::uint32_t lo = std::numeric_limits<std::uint32_t>::max(), hi = 0, start = 0;
    const auto close = [&](std::uint32_t end) {
        if (end > start) indices.segments.push_back({start, end - start});
        start = end + 1;
    };
    for_each_index(indices.data, call.index_type, std::size_t(call.count),
                   [&](std::size_t i, std::uint32_t index) {
                       if (restart && index == *restart) return close(std::uint32_t(i));
                       lo = std::min(lo, index);
                       hi = std::max(hi, index);
                       ++indices.used;
                   });
    close(std::uint32_t(call.count));
    if (indices.used) {
        constexpr std::int64_t wrap = std::int64_t(1) << 32; // sums are taken in 32 bits
        indices.base = std::int64_t(lo) + call.base_vertex >= wrap ? call.base_vertex - wrap : call.base_vertex;
        indices.lo = lo + indices.base;
        indices.hi = hi + indices.base;
        indices.largest = hi;
    }
}

/// Copying a range of which little is used would waste memory, and touch memory that the program may not even
/// have.
bool is_sparse(const Draw& draw) {
    const bool client = std::any_of(draw.context.arrays.begin(), draw.context.arrays.end(),
                                    [&](const Array& array) { return !array.buffer || !draw.may_refer; });
    return client && draw.indices.hi - draw.indices.lo + 1 > std::int64_t(2 * draw.indices.used + 64);
}

/// Replay reads client memory from where index 0 would lie. With an index of two thousand millions, brought
/// back by the base vertex, llvmpipe falls over the offset (piglit's arb_draw_elements_base_vertex-negative-index).
bool is_far_off(const Indices& indices) { return indices.base != 0 && indices.largest >= 1u << 24; }

/// Renumbers the vertices that are used 0, 1, 2, ...
void pick_vertices(Draw& draw) {
    Indices& indices = draw.indices;
    const Call& call = draw.call;
    std::vector<std::uint32_t>& picked = draw.picked;
    for (const DrawSegment& segment : indices.segments)
        for_each_index(indices.data + segment.first * index_bytes(call.index_type), call.index_type,
                       segment.count, [&](std::size_t, std::uint32_t index) { picked.push_back(index); });
    std::sort(picked.begin(), picked.end());
    picked.erase(std::unique(picked.begin(), picked.end()), picked.end());
    std::vector<std::byte> rewritten(std::size_t(call.count) * 4);
    for_each_index(
        indices.data, call.index_type, std::size_t(call.count), [&](std::size_t i, std::uint32_t index) {
            const auto place = std::lower_bound(picked.begin(), picked.end(), index) - picked.begin();
            const auto number = std::uint32_t(place);
            std::memcpy(rewritten.data() + i * 4, &number, 4);
        });
    indices.own = std::move(rewritten);
    indices.data = indices.own.data();
    indices.bytes = indices.own.size();
    indices.blob = nullptr;
}

bool is_position(const Array& array) {
    return array.kind == GL_VERTEX_ARRAY || array.kind == attribute_0_array;
}

bool find_source(Draw& draw, const Array& array) {
    Source source;
    source.array = &array;
    const std::size_t element = element_bytes(array);
    const std::int64_t lo = draw.indices.lo,
                       offset = std::int64_t(reinterpret_cast<std::intptr_t>(array.pointer));
    const std::int64_t start = lo * array.stride;
    const std::size_t bytes = std::size_t(draw.indices.hi - lo) * std::size_t(array.stride) + element;
    if (element == 0 || lo < 0) return false;
    if (!array.buffer) {
        source.from = array.pointer + start;
        if (!array.pointer || !is_readable(source.from, draw.picked.empty() ? bytes : element))
            return !is_position(array); // nobody reads it, or GL would have fallen over it
    } else if (Blob blob = draw.may_refer ? whole_buffer(draw.context, array.buffer) : nullptr) {
        if (offset < 0 || std::size_t(offset + start) + bytes > blob->size()) return false;
        source.from = blob->data() + offset + start;
        source.blob_element_0 = offset + draw.indices.base * array.stride;
        source.blob = std::move(blob);
    } else {
        source.own.resize(bytes);
        if (!read_buffer(draw.context, array.buffer, std::size_t(offset + start), source.own.data(), bytes))
            return false;
        source.from = source.own.data();
    }
    draw.sources.push_back(std::move(source));
    return true;
}

std::size_t vertex_count(const Draw& draw) {
    return draw.picked.empty() ? std::size_t(draw.indices.hi - draw.indices.lo + 1) : draw.picked.size();
}

bool refers(const Draw& draw, const Source& source) { return source.blob && draw.picked.empty(); }

constexpr std::size_t align8(std::size_t n) { return (n + 7) / 8 * 8; }

void copy_vertices(const Draw& draw, const Source& source, std::byte* to) {
    const std::size_t element = element_bytes(*source.array), stride = std::size_t(source.array->stride);
    const std::size_t count = vertex_count(draw);
    if (draw.picked.empty() && element == stride) {
        std::memcpy(to, source.from, count * element);
        return;
    }
    const std::int64_t base = draw.indices.base - draw.indices.lo;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t vertex = draw.picked.empty() ? i : std::size_t(draw.picked[i] + base);
        std::memcpy(to + i * element, source.from + vertex * stride, element);
    }
}

std::uint32_t blob_number(Recording& recording, const Blob& blob) {
    const auto [found, is_new] =
        recording.blob_numbers.try_emplace(blob.get(), recording.frame->blobs.size());
    if (is_new) recording.frame->blobs.push_back(blob);
    return found->second;
}

/// Data in the packet: the indices, then each array's vertices, each aligned to 8.
void write_draw(Draw& draw, Stream& stream) {
    const Call& call = draw.call;
    const Indices& indices = draw.indices;
    Recording* recording = draw.context.recording.get();
    DrawHeader header{call.mode,
                      call.index_type,
                      std::uint32_t(draw.sources.size()),
                      std::uint32_t(indices.segments.size()),
                      std::uint32_t(call.instances),
                      in_packet,
                      0};
    std::size_t data = 0;
    if (call.index_type && indices.blob) {
        header.index_blob = blob_number(*recording, indices.blob);
        header.index_offset = indices.blob_offset;
    } else if (call.index_type) {
        if (!draw.picked.empty()) header.index_type = GL_UNSIGNED_INT;
        data = align8(indices.bytes);
    }
    // With picked vertices, or with no indices, element 0 of the data is the first one; else it is vertex
    // `lo`, which index `lo` - base names.
    const std::int64_t first_index = draw.picked.empty() ? indices.lo - indices.base : 0;
    std::vector<DrawArray> arrays;
    for (const Source& source : draw.sources) {
        const Array& array = *source.array;
        DrawArray entry{array.kind,       array.unit, array.size, array.type, array.stride,
                        array.normalized, in_packet,  0,          0};
        if (refers(draw, source)) {
            entry.blob = blob_number(*recording, source.blob);
            entry.element_0 = source.blob_element_0;
        } else {
            entry.stride = GLsizei(element_bytes(array));
            entry.element_0 = std::int64_t(data) - first_index * entry.stride;
            data += align8(vertex_count(draw) * std::size_t(entry.stride));
        }
        arrays.push_back(entry);
    }
    const std::size_t head =
        sizeof header + arrays.size() * sizeof(DrawArray) + indices.segments.size() * sizeof(DrawSegment);
    Writer writer(stream.append(Op(ExtraOp::draw), head + 8 + data));
    writer.put(header).put_bytes(arrays.data(), arrays.size() * sizeof(DrawArray));
    writer.put_bytes(indices.segments.data(), indices.segments.size() * sizeof(DrawSegment)).align(8);
    std::byte* at = writer.position();
    if (call.index_type && !indices.blob) {
        std::memcpy(at, indices.data, indices.bytes);
        at += align8(indices.bytes);
    }
    for (const Source& source : draw.sources) {
        if (refers(draw, source)) continue;
        copy_vertices(draw, source, at);
        at += align8(vertex_count(draw) * element_bytes(*source.array));
    }
}

bool read_draw(Draw& draw) {
    const Call& call = draw.call;
    if (call.index_type) {
        if (!find_indices(draw)) return false;
        scan_indices(draw);
        if (!draw.indices.used) return true;
        if (is_sparse(draw) || is_far_off(draw.indices)) pick_vertices(draw);
    } else {
        draw.indices.segments.push_back({std::uint32_t(call.first), std::uint32_t(call.count)});
        draw.indices.lo = call.first;
        draw.indices.hi = std::int64_t(call.first) + call.count - 1;
        draw.indices.used = std::size_t(call.count);
    }
    for (const Array& array : draw.context.arrays)
        if (!find_source(draw, array)) return false;
    return true;
}

bool has_position(const Context& context) {
    return !context.arrays.empty() && is_position(context.arrays.back());
}

/// Calls that GL refuses draw nothing, so they are not recorded.
bool is_valid(const Context& context, const Call& call) {
    return context.can_query() && call.mode <= GL_PATCHES && call.count > 0 && call.first >= 0 &&
           call.instances > 0;
}

void record_draw(const Call& call) {
    Context* context = listening_context();
    if (!context || !is_valid(*context, call)) return;
    try {
        refresh_arrays(*context);
        if (!has_position(*context)) return;
        count_if_not_played(*context);
        context->note_draw();
        Draw draw{*context, call, {}, {}, {}, !context->compilation};
        if (!read_draw(draw)) return context->count("a draw that reads beyond its arrays or buffers");
        if (draw.indices.used) context->emit(true, [&](Stream& stream) { write_draw(draw, stream); });
    } catch (const std::exception&) {
        if (context->compilation) context->give_up_list();
        context->give_up_frame("out of memory");
    }
}

void record_elements(GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei instances,
                     GLint base_vertex) {
    if (!index_bytes(type)) return;
    record_draw({mode, count, 0, type, indices, base_vertex, instances});
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY DrawArrays(GLenum mode, GLint first, GLsizei count) {
    record_draw({mode, count, first});
    this_thread.real->DrawArrays(mode, first, count);
}

void APIENTRY DrawArraysInstanced(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
    record_draw({mode, count, first, 0, nullptr, 0, instances});
    this_thread.real->DrawArraysInstanced(mode, first, count, instances);
}

void APIENTRY DrawArraysInstancedBaseInstance(GLenum mode, GLint first, GLsizei count, GLsizei instances,
                                              GLuint base) {
    record_draw({mode, count, first, 0, nullptr, 0, instances});
    this_thread.real->DrawArraysInstancedBaseInstance(mode, first, count, instances, base);
}

void APIENTRY MultiDrawArrays(GLenum mode, const GLint* first, const GLsizei* count, GLsizei drawcount) {
    if (listening_context())
        for (GLsizei i = 0; i < drawcount; ++i) record_draw({mode, count[i], first[i]});
    this_thread.real->MultiDrawArrays(mode, first, count, drawcount);
}

void APIENTRY DrawElements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    record_elements(mode, count, type, indices, 1, 0);
    this_thread.real->DrawElements(mode, count, type, indices);
}

void APIENTRY DrawRangeElements(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
                                const void* indices) {
    record_elements(mode, count, type, indices, 1, 0);
    this_thread.real->DrawRangeElements(mode, start, end, count, type, indices);
}

void APIENTRY DrawElementsBaseVertex(GLenum mode, GLsizei count, GLenum type, const void* indices,
                                     GLint base) {
    record_elements(mode, count, type, indices, 1, base);
    this_thread.real->DrawElementsBaseVertex(mode, count, type, indices, base);
}

void APIENTRY DrawRangeElementsBaseVertex(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
                                          const void* indices, GLint base) {
    record_elements(mode, count, type, indices, 1, base);
    this_thread.real->DrawRangeElementsBaseVertex(mode, start, end, count, type, indices, base);
}

void APIENTRY DrawElementsInstanced(GLenum mode, GLsizei count, GLenum type, const void* indices,
                                    GLsizei instances) {
    record_elements(mode, count, type, indices, instances, 0);
    this_thread.real->DrawElementsInstanced(mode, count, type, indices, instances);
}

void APIENTRY DrawElementsInstancedBaseInstance(GLenum mode, GLsizei count, GLenum type, const void* indices,
                                                GLsizei instances, GLuint base_instance) {
    record_elements(mode, count, type, indices, instances, 0);
    this_thread.real->DrawElementsInstancedBaseInstance(mode, count, type, indices, instances, base_instance);
}

void APIENTRY DrawElementsInstancedBaseVertex(GLenum mode, GLsizei count, GLenum type, const void* indices,
                                              GLsizei instances, GLint base) {
    record_elements(mode, count, type, indices, instances, base);
    this_thread.real->DrawElementsInstancedBaseVertex(mode, count, type, indices, instances, base);
}

void APIENTRY DrawElementsInstancedBaseVertexBaseInstance(GLenum mode, GLsizei count, GLenum type,
                                                          const void* indices, GLsizei instances, GLint base,
                                                          GLuint base_instance) {
    record_elements(mode, count, type, indices, instances, base);
    this_thread.real->DrawElementsInstancedBaseVertexBaseInstance(mode, count, type, indices, instances, base,
                                                                  base_instance);
}

void APIENTRY MultiDrawElements(GLenum mode, const GLsizei* count, GLenum type, const void* const* indices,
                                GLsizei drawcount) {
    if (listening_context())
        for (GLsizei i = 0; i < drawcount; ++i) record_elements(mode, count[i], type, indices[i], 1, 0);
    this_thread.real->MultiDrawElements(mode, count, type, indices, drawcount);
}

void APIENTRY MultiDrawElementsBaseVertex(GLenum mode, const GLsizei* count, GLenum type,
                                          const void* const* indices, GLsizei drawcount, const GLint* base) {
    if (listening_context())
        for (GLsizei i = 0; i < drawcount; ++i) record_elements(mode, count[i], type, indices[i], 1, base[i]);
    this_thread.real->MultiDrawElementsBaseVertex(mode, count, type, indices, drawcount, base);
}

} // namespace glcast::record::custom
