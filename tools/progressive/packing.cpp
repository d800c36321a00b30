#include "tools/progressive/packing.h"

#include <algorithm>
#include <limits>
#include <zlib.h>

namespace glcast::progressive {
namespace {

constexpr std::size_t piece = 1u << 18;
constexpr std::size_t worth_a_code = 4096; ///< bytes: a code of its own takes some 80

/// What zlib's counters hold.
uInt part_of(std::size_t bytes) { return uInt(std::min<std::size_t>(bytes, 1u << 30)); }

struct Inflater {
    z_stream z{};
    Inflater() {
        if (inflateInit(&z) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&z); }
};

Bytef* bytes_at(std::string_view text) { return reinterpret_cast<Bytef*>(const_cast<char*>(text.data())); }

struct Deflater {
    z_stream z{};
    Deflater() {
        if (deflateInit2(&z, 6, Z_DEFLATED, 15, 9, Z_RLE) != Z_OK) throw std::bad_alloc();
    }
    ~Deflater() { deflateEnd(&z); }

    void add(std::string_view bytes, int then, std::string& out) {
        do {
            z.next_in = bytes_at(bytes), z.avail_in = part_of(bytes.size());
            bytes.remove_prefix(z.avail_in);
            do {
                const std::size_t before = out.size();
                out.resize(before + piece);
                z.next_out = bytes_at(out) + before, z.avail_out = piece;
                deflate(&z, bytes.empty() ? then : Z_NO_FLUSH);
                out.resize(out.size() - z.avail_out);
            } while (z.avail_out == 0);
        } while (!bytes.empty());
    }
};

} // namespace

std::string packed(const Planes& planes) {
    Deflater deflater;
    std::string out;
    std::size_t done = 0;
    for (const std::size_t end : planes.ends)
        if (end - done >= worth_a_code && end < planes.bytes.size()) {
            deflater.add(std::string_view(planes.bytes).substr(done, end - done), Z_BLOCK, out);
            done = end;
        }
    deflater.add(std::string_view(planes.bytes).substr(done), Z_FINISH, out);
    return out;
}

std::string unpacked(std::string_view bytes, std::uint64_t size) {
    Inflater inflater;
    z_stream& z = inflater.z;
    std::string out;
    int state = Z_OK;
    while (state == Z_OK) {
        if (z.avail_in == 0) {
            z.next_in = bytes_at(bytes), z.avail_in = part_of(bytes.size());
            bytes.remove_prefix(z.avail_in);
        }
        const std::size_t before = out.size(),
                          room = std::size_t(std::min<std::uint64_t>(size - before, piece));
        out.resize(before + room + 1); // one more, to see what is too much
        z.next_out = bytes_at(out) + before, z.avail_out = uInt(room + 1);
        state = inflate(&z, Z_NO_FLUSH);
        out.resize(out.size() - z.avail_out);
        if (out.size() > size) break;
    }
    if (state != Z_STREAM_END || out.size() != size || z.avail_in || !bytes.empty())
        throw std::runtime_error("it does not unpack to what it says");
    return out;
}

std::uint32_t checksum(std::string_view bytes) {
    return std::uint32_t(crc32_z(crc32_z(0, nullptr, 0), bytes_at(bytes), bytes.size()));
}

} // namespace glcast::progressive
