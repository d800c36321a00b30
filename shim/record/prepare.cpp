#include "shim/record/prepare.h"

#include <algorithm>

#include "shim/record/player.h"
#include "shim/record/primitive.h"

namespace glcast::record {
namespace {

/// Fewer are not worth the calls that set arrays.
constexpr std::size_t fewest_vertices = 24;

constexpr std::size_t align8(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

/// Vertices as one array for each attribute, in the packet.
class VertexWriter {
  public:
    explicit VertexWriter(const Primitive& of) : primitive(of) {
        std::size_t at = 0;
        for (const auto& attribute : primitive.attributes) {
            const std::size_t stride = attribute.size * sizeof(float);
            arrays.push_back({attribute.kind, attribute.unit, attribute.size, GL_FLOAT, GLsizei(stride),
                              GL_FALSE, in_packet, 0, std::int64_t(at)});
            at += align8(stride * primitive.vertices);
        }
        data_bytes = at;
    }

    Stream::Run write(Stream& to) const {
        const DrawHeader header{primitive.mode, 0, std::uint32_t(arrays.size()), 1, 1, in_packet, 0};
        const DrawSegment segment{0, std::uint32_t(primitive.vertices)};
        const std::size_t bytes =
            sizeof header + arrays.size() * sizeof(DrawArray) + sizeof segment + 8 + data_bytes;
        Writer writer(to.append(Op(ExtraOp::draw), bytes));
        writer.put(header).put_bytes(arrays.data(), arrays.size() * sizeof(DrawArray)).put(segment).align(8);
        write_vertices(writer.position());
        return to.last_packet(bytes);
    }

  private:
    std::size_t number_of(const VertexCall& call) const {
        const auto at = std::find_if(arrays.begin(), arrays.end(), [&](const DrawArray& array) {
            return array.kind == call.kind && array.unit == call.unit;
        });
        return std::size_t(at - arrays.begin());
    }

    void write_vertices(std::byte* data) const {
        struct Value {
            float of[4];
        };
        std::vector<Value> now(arrays.size());
        std::size_t vertex = 0;
        for (Stream::Cursor at = primitive.begin; at.packet().body != primitive.end.packet().body;
             at.step()) {
            const VertexCall call = *read_vertex_call(at.packet());
            std::copy(std::begin(call.values), std::end(call.values), now[number_of(call)].of);
            if (call.kind != GL_VERTEX_ARRAY) continue;
            for (std::size_t i = 0; i < arrays.size(); ++i) {
                const auto stride = std::size_t(arrays[i].stride);
                std::memcpy(data + std::size_t(arrays[i].element_0) + vertex * stride, now[i].of, stride);
            }
            ++vertex;
        }
    }

    const Primitive& primitive;
    std::vector<DrawArray> arrays;
    std::size_t data_bytes = 0;
};

/// One stream: what stays as it is, and draws between.
class Preparation {
  public:
    Preparation(const Stream& stream, Stream& for_draws) : cursor(stream), made(for_draws) {}

    void run() {
        while (!cursor.at_end()) {
            if (cursor.packet().op == Op(GlCall::Begin) && replace()) continue;
            keep(cursor.run());
            cursor.step();
        }
    }

    Prepared::Runs runs;
    bool replaced = false;

  private:
    void keep(const Stream::Run& run) {
        if (!runs.empty() && runs.back().end == run.begin)
            runs.back().end = run.end;
        else
            runs.push_back(run);
    }

    bool replace() {
        const auto primitive = read_primitive(cursor);
        if (!primitive || primitive->vertices < fewest_vertices || primitive->vertices > INT32_MAX)
            return false;
        runs.push_back(VertexWriter(*primitive).write(made));
        replaced = true;
        // What the vertices leave as the current values.
        for (const auto& attribute : primitive->attributes)
            if (attribute.kind != GL_VERTEX_ARRAY) keep(attribute.last);
        cursor = primitive->end;
        cursor.step();
        return true;
    }

    Stream::Cursor cursor;
    Stream& made;
};

void prepare_stream(Prepared& prepared, const Stream& stream) {
    if (prepared.runs.contains(&stream)) return;
    Preparation preparation(stream, prepared.made);
    preparation.run();
    if (preparation.replaced) prepared.runs.emplace(&stream, std::move(preparation.runs));
}

} // namespace

void prepare(const Frame& frame) {
    if (frame.prepared) return;
    try {
        frame.prepared = std::make_shared<Prepared>();
        prepare_stream(*frame.prepared, frame.calls);
        for (const auto& [name, list] : frame.lists)
            if (list) prepare_stream(*frame.prepared, *list);
        for (const List& list : frame.redefinitions)
            if (list) prepare_stream(*frame.prepared, *list);
    } catch (const std::bad_alloc&) {
        // What was not reached is played call by call.
    }
}

} // namespace glcast::record
