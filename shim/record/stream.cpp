#include "shim/record/stream.h"

#include <algorithm>
#include <new>

namespace glcast::record {

void Stream::add_chunk(std::size_t at_least) {
    const std::size_t next =
        chunks.empty() ? first_chunk : std::min(chunks.back().capacity * 2, largest_chunk);
    Chunk chunk;
    chunk.capacity = std::max(next, at_least);
    if (chunk.capacity > most_bytes || chunk_bytes > most_bytes - chunk.capacity) throw std::bad_alloc();
    chunk.data.reset(static_cast<std::byte*>(std::malloc(chunk.capacity)));
    if (!chunk.data) throw std::bad_alloc();
    chunks.push_back(std::move(chunk));
    chunk_bytes += chunks.back().capacity;
}

std::byte* Stream::append(Op op, std::size_t bytes) {
    const std::size_t words = (bytes + 3) / 4;
    if (words > 0xFFFFFFFFu) throw std::bad_alloc();
    const bool is_long = words >= long_packet;
    const std::size_t header_bytes = is_long ? 8 : 4, total = header_bytes + words * 4;
    if (chunks.empty() || chunks.back().capacity - chunks.back().used < total) add_chunk(total);
    Chunk& chunk = chunks.back();
    std::byte* at = chunk.data.get() + chunk.used;
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
    // Only the last chunk can be moved: alignment inside a chunk counts from its start, which malloc aligns
    // to 16.
    Chunk& last = chunks.back();
    if (auto* smaller =
            static_cast<std::byte*>(std::realloc(last.data.get(), std::max<std::size_t>(last.used, 1)))) {
        last.data.release();
        last.data.reset(smaller);
        chunk_bytes -= last.capacity - last.used;
        last.capacity = last.used;
    }
    chunks.shrink_to_fit();
}

std::size_t Stream::allocated_bytes() const {
    return chunks.capacity() * sizeof(Chunk) + chunk_bytes;
}

} // namespace glcast::record
