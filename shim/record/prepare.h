// A frame made ready to be played many times: the vertices between glBegin and glEnd as arrays.
#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "shim/record/context.h"
#include "shim/record/draw_packet.h"

namespace glcast::record {

struct Prepared {
    using Runs = std::vector<Stream::Run>;

    /// Null: the stream is played as it is.
    const Runs* runs_of(const Stream& stream) const {
        const auto found = runs.find(&stream);
        return found == runs.end() ? nullptr : &found->second;
    }

    std::unordered_map<const Stream*, Runs> runs; ///< parts of the streams, and of `made` between them
    Stream made;                                  ///< draw packets
    std::unordered_map<const std::byte*, std::unique_ptr<const DrawParts>>
        parts; ///< by packet, as they are asked for
};

/// What a draw packet draws.
DrawParts find_parts(const Frame& frame, const Packet& packet);

/// The parts of a draw packet.
struct DrawReader {
    DrawReader(const Frame& frame, const Packet& packet);
    /// Where element 0 of an array would lie. It may lie before what is there: the draw begins with a later
    /// one. Hence no pointer.
    std::uintptr_t element_0(const DrawArray& array) const {
        return reinterpret_cast<std::uintptr_t>(start(array.blob)) + std::uintptr_t(array.element_0);
    }
    const std::byte* indices() const { return start(header.index_blob) + header.index_offset; }
    std::size_t index_bytes() const {
        return header.index_type == GL_UNSIGNED_BYTE ? 1 : header.index_type == GL_UNSIGNED_SHORT ? 2 : 4;
    }
    const std::byte* start(std::uint32_t blob) const {
        return blob == in_packet ? data : frame.blobs[blob]->data();
    }

    const Frame& frame;
    DrawHeader header;
    const std::byte *arrays, *segments, *data;
};

/// While it lives, parts_of_draw() tells of this packet.
class ShownDraw {
  public:
    ShownDraw(const Frame& frame, const Packet& packet);
    ~ShownDraw();
    ShownDraw(const ShownDraw&) = delete;
    ShownDraw& operator=(const ShownDraw&) = delete;
};

} // namespace glcast::record
