// A chunk of an OpenEXR file unpacked: none, RLE, ZIPS and ZIP, by zlib.
#pragma once
#include <span>
#include <vector>

#include "capture/exr_compress.h"

namespace glcast::exr {

/// The bytes of a chunk as they were before it was compressed, exactly `size` of them: lines from top to
/// bottom, of each line all of the first channel, then all of the next. Throws std::runtime_error when the
/// chunk makes more or less.
std::vector<char> decompress(std::span<const char> chunk, Compression compression, std::size_t size);

} // namespace glcast::exr
