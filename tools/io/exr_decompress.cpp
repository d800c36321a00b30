#include "tools/io/exr_decompress.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
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

/// Each byte was stored as its difference from the one before, off by 128. Eight at a time.
void undo_differences(std::vector<char>& bytes) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::uint64_t each = 0x0101010101010101, low = 0x7f7f7f7f7f7f7f7f;
    constexpr std::uint64_t offsets = 0x8000800080008000;    // of every other byte one more than of the last
    const auto plus = [](std::uint64_t a, std::uint64_t b) { // byte by byte, without carries
        return ((a & low) + (b & low)) ^ ((a ^ b) & ~low);
    };
    std::uint64_t before = 0; // the last sum, in every byte
    std::size_t k = 0;
    for (; k + 8 <= bytes.size(); k += 8) {
        std::uint64_t sums;
        std::memcpy(&sums, &bytes[k], 8);
        for (const int shift : {8, 16, 32}) sums = plus(sums, sums << shift);
        sums = plus(sums, before);
        before = (sums >> 56) * each;
        sums ^= offsets;
        std::memcpy(&bytes[k], &sums, 8);
    }
    auto sum = static_cast<unsigned char>(before);
    for (; k < bytes.size(); ++k) {
        sum = static_cast<unsigned char>(sum + static_cast<unsigned char>(bytes[k]));
        bytes[k] = char(sum ^ (k % 2 ? 0x80 : 0));
    }
}

/// Even bytes come first, then odd ones.
std::vector<char> undo_filter(std::vector<char> bytes) {
    undo_differences(bytes);
    std::vector<char> woven(bytes.size());
    const std::size_t odd = bytes.size() / 2;
    const char *first = bytes.data(), *second = first + (bytes.size() - odd);
    char* out = woven.data();
    for (std::size_t k = 0; k < odd; ++k) {
        out[2 * k] = first[k];
        out[2 * k + 1] = second[k];
    }
    if (bytes.size() % 2) out[2 * odd] = first[odd];
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
