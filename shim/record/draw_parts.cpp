// Where the vertices of a draw packet lie, and the parts in which it may be drawn.
#include <algorithm>
#include <cmath>

#include "shim/record/arrays.h"
#include "shim/record/prepare.h"

namespace glcast::record {
namespace {

/// Of a part; whole triangles and quads.
constexpr std::uint32_t part_elements = 48;

/// The elements after which a draw of the mode may be cut, and those that the next part needs again. Nothing
/// where it may not: a fan, or lines, whose stipple goes on.
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

class PartsFinder {
  public:
    PartsFinder(const Frame& frame, const Packet& packet) : draw(frame, packet) {
        const DrawHeader& header = draw.header;
        Reader arrays({packet.op, draw.arrays, header.arrays * sizeof(DrawArray)});
        for (std::uint32_t i = 0; i < header.arrays; ++i) position = arrays.get<DrawArray>(); // comes last
        Reader segment({packet.op, draw.segments, header.segments * sizeof(DrawSegment)});
        for (std::uint32_t i = 0; i < header.segments; ++i) segments.push_back(segment.get<DrawSegment>());
    }

    DrawParts find() const {
        const DrawHeader& header = draw.header;
        DrawParts found{header.mode, false, false, {}};
        const bool has_position = header.arrays > 0 && position.kind == GL_VERTEX_ARRAY && position.size >= 2;
        if (!has_position || segments.size() != 1 || header.instances != 1) return found;
        const std::uint32_t count = segments[0].count;
        double p[3];
        for (std::uint32_t i = 0; i < count; ++i)
            if (!read(element(segments[0].first + i), p)) return found;
        found.is_known = true;
        found.is_whole = record::is_whole(header.mode, count);
        const auto cut = cut_of(header.mode);
        if (!cut || !found.is_whole || count < 2 * part_elements) {
            found.parts.push_back({0, count});
            return found;
        }
        for (std::uint32_t at = 0; at + cut->overlap < count; at += cut->step)
            found.parts.push_back({at, std::min(cut->step + cut->overlap, count - at)});
        return found;
    }

    void read_positions(const DrawParts::Part& part, std::vector<float>& xyz) const {
        xyz.resize(std::size_t(part.count) * 3);
        double p[3] = {};
        for (std::uint32_t i = 0; i < part.count; ++i) {
            read(element(segments[0].first + part.first + i), p);
            for (int k = 0; k < 3; ++k) xyz[std::size_t(i) * 3 + k] = static_cast<float>(p[k]);
        }
    }

  private:
    std::uint32_t element(std::uint32_t at) const {
        if (!draw.header.index_type) return at;
        std::uint32_t index = 0;
        std::memcpy(&index, draw.indices() + at * draw.index_bytes(), draw.index_bytes());
        return index;
    }

    template <class T> bool read_as(const std::byte* from, double (&p)[3]) const {
        T values[4] = {};
        std::memcpy(values, from, sizeof(T) * std::size_t(position.size));
        for (int i = 0; i < 3; ++i) p[i] = i < position.size ? double(values[i]) : 0;
        return (position.size < 4 || values[3] == 1) && std::isfinite(float(p[0])) &&
               std::isfinite(float(p[1])) && std::isfinite(float(p[2]));
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

DrawParts find_parts(const Frame& frame, const Packet& packet) { return PartsFinder(frame, packet).find(); }

ShownDraw::ShownDraw(const Frame& frame, const Packet& packet) { shown = {&frame, packet}; }
ShownDraw::~ShownDraw() { shown = {}; }

const DrawParts* parts_of_draw() {
    if (!shown.frame || !shown.frame->prepared) return nullptr;
    auto& found = shown.frame->prepared->parts[shown.packet.body];
    if (!found) found = std::make_unique<const DrawParts>(find_parts(*shown.frame, shown.packet));
    return found.get();
}

void read_positions(const DrawParts::Part& part, std::vector<float>& xyz) {
    PartsFinder(*shown.frame, shown.packet).read_positions(part, xyz);
}

} // namespace glcast::record
