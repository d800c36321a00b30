// The pixels of one part of a capture.
#pragma once
#include "tools/io/capture_layout.h"

namespace glcast {

/// Unpacks a part's chunks, on all cores, and checks them against docs/reference/capture-format.md and the counts of
/// the header. Throws std::runtime_error: what is wrong, without the file's name.
ViewImage read_part(const InputFile& file, int n, const PartHeader& part,
                    const std::vector<ChunkPlace>& chunks);

} // namespace glcast
