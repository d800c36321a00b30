// The only file that knows tinyexr. Its writer wants a whole picture in memory, and a multi-part file all
// pictures at once; so it is given a band of lines as a picture of its own, and the chunks are taken out of
// what it makes.
#include "capture/exr_compress.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "capture/exr_header.h"

#include <zlib.h>

namespace {
/// tinyexr calls zlib's compress(), which is level 6; level 1 takes half the time for a tenth more bytes
/// (docs).
int quick_compress(Bytef* to, uLongf* to_size, const Bytef* from, uLong from_size) {
    return compress2(to, to_size, from, from_size, 1);
}
} // namespace
#define compress quick_compress
#define TINYEXR_IMPLEMENTATION
#include <tinyexr.h>
#undef compress

namespace glcast::exr {
namespace {

struct FreeMemory {
    void operator()(unsigned char* p) const { std::free(p); }
};

/// Past magic, version, attributes and the offset table of a single-part file.
bool find_chunks(std::span<const char> file, int chunk_count, std::size_t& offset) {
    offset = 8;
    Attribute attribute;
    do {
        if (!next_attribute(file, offset, attribute)) return false;
    } while (!attribute.name.empty());
    offset += static_cast<std::size_t>(chunk_count) * 8;
    return offset <= file.size();
}

bool take_chunks(std::span<const char> file, int chunk_count, int first_line, std::vector<Chunk>& chunks) {
    std::size_t offset = 0;
    if (!find_chunks(file, chunk_count, offset)) return false;
    for (int i = 0; i < chunk_count; ++i) {
        if (file.size() - offset < 8) return false;
        const std::uint32_t size = read_u32(file.data() + offset + 4);
        if (size > file.size() - offset - 8) return false;
        const char* begin = file.data() + offset + 8;
        chunks.push_back(
            {first_line + static_cast<int>(read_u32(file.data() + offset)), {begin, begin + size}});
        offset += 8 + size;
    }
    return offset == file.size();
}

} // namespace

int lines_per_chunk(Compression compression) {
    switch (compression) {
    case Compression::zip:
        return 16;
    case Compression::piz:
        return 32;
    default:
        return 1;
    }
}

bool compress_band(const std::vector<Channel>& channels, const std::vector<std::vector<float>>& planes,
                   int width, int lines, int first_line, Compression compression, std::vector<Chunk>& chunks,
                   std::string& error) {
    const int count = static_cast<int>(channels.size());
    std::vector<EXRChannelInfo> infos(count);
    std::vector<int> in(count, TINYEXR_PIXELTYPE_FLOAT), out(count);
    std::vector<unsigned char*> pointers(count);
    for (int c = 0; c < count; ++c) {
        std::strncpy(infos[c].name, channels[c].name, sizeof infos[c].name - 1);
        out[c] = channels[c].half ? TINYEXR_PIXELTYPE_HALF : TINYEXR_PIXELTYPE_FLOAT;
        pointers[c] = reinterpret_cast<unsigned char*>(const_cast<float*>(planes[c].data()));
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = count;
    header.channels = infos.data();
    header.pixel_types = in.data();
    header.requested_pixel_types = out.data();
    header.compression_type = static_cast<int>(compression);
    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = count;
    image.images = pointers.data();
    image.width = width;
    image.height = lines;

    unsigned char* memory = nullptr;
    const char* why = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &why);
    const std::unique_ptr<unsigned char, FreeMemory> owner(memory);
    if (size == 0 || !memory) {
        error = std::string("tinyexr: ") + (why ? why : "out of memory");
        if (why) FreeEXRErrorMessage(why);
        return false;
    }
    const int per_chunk = lines_per_chunk(compression);
    const std::span<const char> file(reinterpret_cast<const char*>(memory), size);
    if (take_chunks(file, (lines + per_chunk - 1) / per_chunk, first_line, chunks)) return true;
    error = "tinyexr: unexpected layout";
    return false;
}

} // namespace glcast::exr
