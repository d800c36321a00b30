#include "tools/io/exr_decompress.h"

#include <algorithm>
#include <stdexcept>

#include <zlib.h>

namespace glcast::exr {
namespace {

[[noreturn]] void damaged() {
    throw std::runtime_error("a chunk is damaged: it does not unpack to its lines");
}

std::vector<char> inflate(std::span<const char> chunk, std::size_t size) {
    std::vector<char> bytes(size);
    uLongf made = size;
    const int result = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &made,
                                  reinterpret_cast<const Bytef*>(chunk.data()), chunk.size());
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != Z_OK || made != size) damaged();
    return bytes;
}

/// A count below 0 and as many bytes to copy, or a count and a byte to be there once more often.
std::vector<char> expand_runs(std::span<const char> chunk, std::size_t size) {
    std::vector<char> bytes;
    bytes.reserve(size);
    while (!chunk.empty()) {
        const int count = static_cast<signed char>(chunk[0]);
        const std::size_t taken = count < 0 ? std::size_t(-count) : 1;
        const std::size_t made = count < 0 ? taken : std::size_t(count) + 1;
        if (chunk.size() < 1 + taken || bytes.size() + made > size) damaged();
        if (count < 0)
            bytes.insert(bytes.end(), chunk.begin() + 1, chunk.begin() + 1 + long(taken));
        else
            bytes.insert(bytes.end(), made, chunk[1]);
        chunk = chunk.subspan(1 + taken);
    }
    if (bytes.size() != size) damaged();
    return bytes;
}

/// Each byte was stored as its difference from the one before, off by 128; even bytes first, then odd ones.
std::vector<char> undo_filter(std::vector<char> bytes) {
    unsigned char before = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]);
    for (std::size_t k = 1; k < bytes.size(); ++k)
        bytes[k] =
            char(before = static_cast<unsigned char>(before + static_cast<unsigned char>(bytes[k]) - 128));
    std::vector<char> woven(bytes.size());
    const std::size_t even = (bytes.size() + 1) / 2;
    for (std::size_t k = 0; k < even; ++k) woven[2 * k] = bytes[k];
    for (std::size_t k = even; k < bytes.size(); ++k) woven[2 * (k - even) + 1] = bytes[k];
    return woven;
}

} // namespace

std::vector<char> decompress(std::span<const char> chunk, Compression compression, std::size_t size) {
    if (chunk.size() == size) return {chunk.begin(), chunk.end()}; // what does not shrink is stored as it is
    if (chunk.size() > size) damaged();
    switch (compression) {
    case Compression::rle:
        return undo_filter(expand_runs(chunk, size));
    case Compression::zips:
    case Compression::zip:
        return undo_filter(inflate(chunk, size));
    default:
        damaged();
    }
}

} // namespace glcast::exr
