// Where the pixels of a capture stand in its file.
#pragma once
#include <cstdint>
#include <vector>

#include "tools/io/capture_header.h"

namespace glcast {

/// The bytes of a chunk, less its head.
struct ChunkPlace {
    std::uint64_t at = 0;
    std::uint32_t bytes = 0;
};

/// The chunks of each part, from the first lines to the last.
using CaptureLayout = std::vector<std::vector<ChunkPlace>>;

/// Walks the offset tables and the chunk heads. All chunks are there, none overlaps another, and the last one
/// ends where the file ends; so no truncation goes unseen, and all that is read is no more than the file.
/// Throws std::runtime_error: what is wrong, without the file's name.
CaptureLayout read_capture_layout(const InputFile& file, const CaptureHeader& header);

} // namespace glcast
