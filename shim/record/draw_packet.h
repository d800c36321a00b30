// One drawing call over arrays, with all that it reads.
//
//   draw := DrawHeader  DrawArray*  DrawSegment*  pad to 8  indices  vertex data
//
// Vertex data is in the packet, or in a copy of a buffer object that draws of the frame share.
#pragma once
#include "shim/record/stream.h"

#include "capture/gl/gl_table.h"

namespace glcast::record {

inline constexpr std::uint32_t in_packet = 0xFFFFFFFF;

struct DrawHeader {
    GLenum mode;
    GLenum index_type; ///< 0: no indices
    std::uint32_t arrays, segments;
    std::uint32_t instances;
    std::uint32_t index_blob;   ///< number in Frame::blobs, or in_packet
    std::uint64_t index_offset; ///< from the start of the blob or of the data behind the padding
};

struct DrawArray {
    GLenum kind;
    std::uint32_t unit;
    GLint size;
    GLenum type;
    GLsizei stride;
    std::uint32_t normalized;
    std::uint32_t blob;
    std::uint32_t unused;
    std::int64_t
        element_0; ///< where element 0 would lie; before the data where the draw begins with a later one
};

/// Consecutive elements that are drawn as one: more than one where primitive restart cuts.
struct DrawSegment {
    std::uint32_t first, count;
};

} // namespace glcast::record
