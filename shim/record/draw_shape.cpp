// Where the vertices of a draw packet lie, and the parts in which it may be drawn.
#include <algorithm>
#include <cmath>

#include "shim/record/arrays.h"
#include "shim/record/prepare.h"

namespace glcast::record {
namespace {

/// Of a part; whole triangles and quads.
constexpr std::uint32_t part_elements = 48;

/// The elements after which a draw of the mode may be cut, and those that the next part needs again. Nothing where it may
/// not: a fan, or lines, whose stipple goes on.
struct Cut {
    std::uint32_t step, overlap;
};
std::optional<Cut> cut_of(GLenum mode) {
    switch (mode) {
    case GL_TRIANGLES:
    case GL_QUADS:
        return Cut{part_elements, 0};
    case GL_TRIANGLE_STRIP: // at an even place: triangles there turn as at the start
    case GL_QUAD_STRIP:
        return Cut{part_elements - 2, 2};
    default:
        return std::nullopt;
    }
}

bool is_whole(GLenum mode, std::uint32_t count) {
    switch (mode) {
    case GL_TRIANGLES:
        return count % 3 == 0;
    case GL_QUADS:
        return count % 4 == 0;
    case GL_QUAD_STRIP:
        return count >= 4 && count % 2 == 0;
    case GL_TRIANGLE_STRIP:
    case GL_TRIANGLE_FAN:
    case GL_POLYGON:
        return count >= 3;
    default:
        return false;
    }
}

void include(Extent& extent, bool& any, const double (&p)[3]) {
    for (int i = 0; i < 3; ++i) {
        const auto value = static_cast<float>(p[i]);
        extent.lo[i] = any ? std::min(extent.lo[i], value) : value;
        extent.hi[i] = any ? std::max(extent.hi[i], value) : value;
    }
    any = true;
}

class ShapeFinder {
  public:
    ShapeFinder(const Frame& frame, const Packet& packet) : draw(frame, packet) {
        const DrawHeader& header = draw.header;
        Reader arrays({packet.op, draw.arrays, header.arrays * sizeof(DrawArray)});
        for (std::uint32_t i = 0; i < header.arrays; ++i) position = arrays.get<DrawArray>(); // comes last
        Reader segment({packet.op, draw.segments, header.segments * sizeof(DrawSegment)});
        for (std::uint32_t i = 0; i < header.segments; ++i) segments.push_back(segment.get<DrawSegment>());
    }

    DrawShape find() const {
        DrawShape shape{{}, false, {}};
        const DrawHeader& header = draw.header;
        if (header.arrays == 0 || position.kind != GL_VERTEX_ARRAY || position.size < 2) return shape;
        shape.is_whole = std::all_of(segments.begin(), segments.end(),
                                     [&](const DrawSegment& s) { return record::is_whole(header.mode, s.count); });
        if (!add(shape.extent, segments)) return shape.extent = {}, shape;
        const auto cut = cut_of(header.mode);
        if (!cut || !shape.is_whole || segments.size() != 1 || segments[0].count < 2 * part_elements) return shape;
        const DrawSegment all = segments[0];
        for (std::uint32_t at = 0; at + cut->overlap < all.count; at += cut->step) {
            const std::uint32_t count = std::min(cut->step + cut->overlap, all.count - at);
            Extent extent;
            add(extent, {{all.first + at, count}});
            shape.parts.push_back({all.first + at, count, extent});
        }
        return shape;
    }

  private:
    /// False where a position cannot be known.
    bool add(Extent& extent, const std::vector<DrawSegment>& of) const {
        bool any = false;
        for (const DrawSegment& segment : of)
            for (std::uint32_t i = 0; i < segment.count; ++i) {
                double p[3] = {};
                if (!read(element(segment.first + i), p)) return false;
                include(extent, any, p);
            }
        return any;
    }

    std::uint32_t element(std::uint32_t at) const {
        if (!draw.header.index_type) return at;
        std::uint32_t index = 0;
        std::memcpy(&index, draw.indices() + at * draw.index_bytes(), draw.index_bytes());
        return index;
    }

    template <class T> bool read_as(const std::byte* from, double (&p)[3]) const {
        T values[4] = {};
        std::memcpy(values, from, sizeof(T) * std::size_t(position.size));
        for (int i = 0; i < std::min(position.size, 3); ++i) p[i] = double(values[i]);
        return (position.size < 4 || values[3] == 1) && std::isfinite(p[0] + p[1] + p[2]);
    }

    bool read(std::uint32_t index, double (&p)[3]) const {
        const auto at = draw.element_0(position) + std::uintptr_t(std::int64_t(index) * position.stride);
        const auto* from = reinterpret_cast<const std::byte*>(at);
        switch (position.type) {
        case GL_FLOAT:
            return read_as<GLfloat>(from, p);
        case GL_DOUBLE:
            return read_as<GLdouble>(from, p);
        case GL_SHORT:
            return read_as<GLshort>(from, p);
        case GL_INT:
            return read_as<GLint>(from, p);
        default:
            return false;
        }
    }

    const DrawReader draw;
    DrawArray position{};
    std::vector<DrawSegment> segments;
};

struct Shown {
    const Frame* frame = nullptr;
    Packet packet{};
};
constinit thread_local Shown shown;

} // namespace

DrawReader::DrawReader(const Frame& of, const Packet& packet) : frame(of) {
    Reader reader(packet);
    header = reader.get<DrawHeader>();
    arrays = reader.take(header.arrays * sizeof(DrawArray));
    segments = reader.take(header.segments * sizeof(DrawSegment));
    data = reader.align(8).position();
}

DrawShape find_shape(const Frame& frame, const Packet& packet) { return ShapeFinder(frame, packet).find(); }

ShownDraw::ShownDraw(const Frame& frame, const Packet& packet) { shown = {&frame, packet}; }
ShownDraw::~ShownDraw() { shown = {}; }

const DrawShape* shape_of_draw() {
    if (!shown.frame || !shown.frame->prepared) return nullptr;
    auto& shape = shown.frame->prepared->shapes[shown.packet.body];
    if (!shape) shape = std::make_unique<const DrawShape>(find_shape(*shown.frame, shown.packet));
    return shape.get();
}

} // namespace glcast::record
