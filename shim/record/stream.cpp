#include "shim/record/stream.h"

#include <algorithm>
#include <new>

namespace glcast::record {

// Not inlined: what it cleans up after would slow append() down.
[[gnu::noinline]] void Stream::add_chunk(std::size_t at_least) {
    const std::size_t next =
        chunks.empty() ? first_chunk : std::min(chunks.back().block.capacity() * 2, largest_chunk);
    chunks.push_back({Block(std::max(next, at_least)), 0});
}

std::byte* Stream::append(Op op, std::size_t bytes) {
    const std::size_t words = (bytes + 3) / 4;
    if (words > 0xFFFFFFFFu) throw std::bad_alloc();
    const bool is_long = words >= long_packet;
    const std::size_t header_bytes = is_long ? 8 : 4, total = header_bytes + words * 4;
    if (chunks.empty() || chunks.back().block.capacity() - chunks.back().used < total) add_chunk(total);
    Chunk& chunk = chunks.back();
    std::byte* at = chunk.block.data() + chunk.used;
    chunk.used += total;
    const std::uint32_t header = op | (is_long ? long_packet : std::uint32_t(words)) << 16;
    std::memcpy(at, &header, 4);
    if (is_long) {
        const auto count = std::uint32_t(words);
        std::memcpy(at + 4, &count, 4);
    }
    return at + header_bytes;
}

void Stream::shrink() {
    if (chunks.empty()) return;
    // Only the last chunk may move: alignment inside a chunk counts from its start, which is aligned to 16.
    chunks.back().block.shrink(chunks.back().used);
    chunks.shrink_to_fit();
}

std::size_t Stream::allocated_bytes() const {
    std::size_t sum = chunks.capacity() * sizeof(Chunk);
    for (const Chunk& chunk : chunks) sum += chunk.block.capacity();
    return sum;
}

} // namespace glcast::record
