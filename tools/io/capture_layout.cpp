#include "tools/io/capture_layout.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "capture/exr_header.h"

namespace glcast {
namespace {

constexpr std::uint64_t head_bytes = 12; // part, first line, size

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

std::uint64_t chunk_count(const CaptureHeader& header, const PartHeader& part) {
    const int lines = exr::lines_per_chunk(part.compression);
    return std::uint64_t((header.info.n + lines - 1) / lines);
}

ChunkPlace read_head(const InputFile& file, std::uint64_t at, std::size_t part, std::uint64_t first_line) {
    const std::vector<char> head = file.read(at, head_bytes);
    const std::uint32_t bytes = exr::read_u32(head.data() + 8);
    if (exr::read_u32(head.data()) != part || exr::read_u32(head.data() + 4) != first_line)
        refuse("a chunk is damaged");
    if (bytes > file.size() - at - head_bytes) refuse("the file is truncated");
    return {at + head_bytes, bytes};
}

void check_overlaps(const CaptureLayout& layout, std::uint64_t file_bytes) {
    std::vector<ChunkPlace> all;
    for (const std::vector<ChunkPlace>& chunks : layout) all.insert(all.end(), chunks.begin(), chunks.end());
    std::ranges::sort(all, {}, &ChunkPlace::at);
    std::uint64_t end = 0;
    for (const ChunkPlace& chunk : all) {
        if (chunk.at - head_bytes < end) refuse("a chunk is damaged: it begins in another");
        end = chunk.at + chunk.bytes;
    }
    if (end != file_bytes) refuse("the file is longer than its contents");
}

} // namespace

CaptureLayout read_capture_layout(const InputFile& file, const CaptureHeader& header) {
    std::uint64_t total = 0;
    for (const PartHeader& part : header.parts) total += chunk_count(header, part);
    const std::uint64_t data_at = header.tables_at + total * 8;
    const std::vector<char> tables = file.read(header.tables_at, total * 8);
    const char* entry = tables.data();
    CaptureLayout layout(header.parts.size());
    for (std::size_t part = 0; part < layout.size(); ++part) {
        const std::uint64_t lines = std::uint64_t(exr::lines_per_chunk(header.parts[part].compression));
        const std::uint64_t count = chunk_count(header, header.parts[part]);
        for (std::uint64_t c = 0; c < count; ++c, entry += 8) {
            const std::uint64_t at = exr::read_u64(entry);
            if (at == 0) refuse("the file was never finished");
            if (at < data_at) refuse("a chunk is damaged");
            layout[part].push_back(read_head(file, at, part, c * lines));
        }
    }
    check_overlaps(layout, file.size());
    return layout;
}

} // namespace glcast
