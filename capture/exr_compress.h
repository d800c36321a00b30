// Compressing scan lines to OpenEXR chunks by tinyexr, a band at a time.
#pragma once
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace glcast::exr {

enum class Compression { none = 0, rle = 1, zips = 2, zip = 3, piz = 4 }; ///< numbers as in the file

struct Channel {
    const char* name;
    bool half; ///< 16-bit float in the file, else 32-bit
};

/// A chunk of a scan-line part: `bytes` are as in the file, less line number and length.
struct Chunk {
    int first_line = 0;
    std::vector<unsigned char> bytes;
};

/// A normal's component without the last 8 bits of its mantissa, which are noise: at most 0.001 degree off,
/// and the file is a sixth smaller.
inline float without_noise(float value) {
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) + 0x80u) & ~0xffu);
}

/// How many scan lines share a chunk.
int lines_per_chunk(Compression compression);

/// Rows of a band: a multiple of every lines_per_chunk(), so that bands can be compressed one by one.
inline constexpr int band_lines = 32;

/// Compresses `lines` rows of `width` pixels: `planes[c]` holds channel c, channels in alphabetical order.
/// Appends its chunks, lines counted from `first_line`. False with a line in `error` when tinyexr fails.
bool compress_band(const std::vector<Channel>& channels, const std::vector<std::vector<float>>& planes,
                   int width, int lines, int first_line, Compression compression, std::vector<Chunk>& chunks,
                   std::string& error);

} // namespace glcast::exr
