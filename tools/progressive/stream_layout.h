// What writer and reader of the stream share. Internal.
#pragma once
#include <cstdint>

namespace glcast::progressive {

constexpr char magic[8] = {'g', 'l', 'c', 'a', 's', 't', 'P', 'M'};
constexpr std::uint16_t version = 1;
constexpr std::uint16_t with_colours = 1, with_normals = 2; ///< flags

constexpr std::size_t header_bytes = 8 + 2 + 2 + 4 * 4 + 8 + 2; ///< before the name
constexpr std::size_t chunk_header_bytes = 4 + 8 + 8 + 4 + 4;

/// Unpacked bytes of a base mesh.
constexpr std::uint64_t base_bytes(std::uint64_t vertices, std::uint64_t triangles, std::uint16_t flags) {
    return vertices * (4 + 24 + (flags & with_colours ? 12 : 0) + (flags & with_normals ? 12 : 0)) +
           triangles * (4 + 12);
}

} // namespace glcast::progressive
