// A stream of a progressive mesh taken apart and put together with right checksums: for damage that lies behind them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/progressive/packing.h"

namespace glcast::test {

template <class T> T number(const std::string& bytes, std::size_t at) {
    T value = 0;
    for (std::size_t k = 0; k < sizeof value; ++k)
        value = T(value | T(std::uint8_t(bytes.at(at + k))) << 8 * k);
    return value;
}
template <class T> void put(std::string& bytes, std::size_t at, T value) {
    for (std::size_t k = 0; k < sizeof value; ++k) bytes.at(at + k) = char(std::uint8_t(value >> 8 * k));
}

/// A stream taken apart as docs/reference/progressive-meshes.md says: header, then chunks, unpacked.
struct Apart {
    std::string header; ///< without its checksum
    struct Chunk {
        std::uint32_t count;
        std::string bytes;
    };
    std::vector<Chunk> chunks;

    explicit Apart(const std::string& stream) {
        const std::size_t name = number<std::uint16_t>(stream, 36);
        header = stream.substr(0, 38 + name);
        for (std::size_t at = 38 + name + 4; at < stream.size();) {
            const auto size = number<std::uint64_t>(stream, at + 4),
                       packed_size = number<std::uint64_t>(stream, at + 12);
            chunks.push_back(
                {number<std::uint32_t>(stream, at), progressive::unpacked(stream.substr(at + 28, packed_size), size)});
            at += 28 + packed_size;
        }
    }

    std::string together() const {
        std::string stream = header + std::string(4, '\0');
        put(stream, header.size(), progressive::checksum(header));
        for (const Chunk& chunk : chunks) {
            const std::string data = progressive::packed({chunk.bytes, {}});
            std::string head(28, '\0');
            put(head, 0, chunk.count);
            put(head, 4, std::uint64_t(chunk.bytes.size())), put(head, 12, std::uint64_t(data.size()));
            put(head, 20, progressive::checksum(data));
            put(head, 24, progressive::checksum(head.substr(0, 24)));
            stream += head + data;
        }
        return stream;
    }
};

} // namespace glcast::test
