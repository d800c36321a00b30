#include "tools/io/capture_layout.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "capture/capture_file.h"
#include "capture/exr_header.h"

namespace glcast {
namespace {

constexpr std::size_t largest_header =
    16u << 20; // hundreds of parts of a few kB each, and thousands of not-understood calls
constexpr std::uint64_t best_ratio = 1100; // deflate makes 1032 bytes of one at most
constexpr std::uint64_t bytes_per_pixel = 26;

using Header = std::map<std::string_view, exr::Attribute>;

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

class File {
  public:
    explicit File(const std::filesystem::path& path) : stream(path, std::ios::binary) {
        std::error_code code;
        if (std::filesystem::is_directory(path, code)) refuse("is a folder");
        if (!stream) refuse(std::strerror(errno));
        size = std::filesystem::file_size(path, code);
        if (code) refuse(code.message());
    }
    std::vector<char> read(std::uint64_t offset, std::size_t bytes) {
        std::vector<char> data(bytes);
        stream.clear();
        stream.seekg(static_cast<std::streamoff>(offset));
        if (!stream.read(data.data(), static_cast<std::streamsize>(bytes))) refuse("the file is truncated");
        return data;
    }
    std::uint64_t size = 0;

  private:
    std::ifstream stream;
};

std::vector<Header> walk_headers(std::span<const char> bytes, std::size_t& offset) {
    std::vector<Header> headers;
    offset = 8;
    for (;;) {
        if (offset >= bytes.size()) refuse("the file is truncated");
        if (bytes[offset] == 0) break;
        Header& header = headers.emplace_back();
        for (;;) {
            exr::Attribute attribute;
            if (!exr::next_attribute(bytes, offset, attribute))
                refuse("the file is truncated or its header damaged");
            if (attribute.name.empty()) break;
            if (!header.emplace(attribute.name, attribute).second) refuse("the header is damaged");
        }
    }
    ++offset;
    return headers;
}

/// The value of a 4-byte or 1-byte attribute of that type.
int number(const Header& header, std::string_view name, std::string_view type) {
    const auto found = header.find(name);
    if (found == header.end() || found->second.type != type)
        refuse("the header is damaged: no " + std::string(name));
    const std::span<const char> value = found->second.value;
    if (value.size() == 1) return static_cast<unsigned char>(value[0]);
    if (value.size() != 4) refuse("the header is damaged: " + std::string(name));
    return static_cast<int>(exr::read_u32(value.data()));
}

int check_format(const Header& header) {
    if (!header.contains("glcast.format")) refuse("is an OpenEXR file, but no capture of glcast");
    const int format = number(header, "glcast.format", "int");
    if (format > capture_format_version)
        refuse("was made by a newer glcast: its format is " + std::to_string(format) +
               ", this one reads up to " + std::to_string(capture_format_version));
    if (format < 1) refuse("the header is damaged: glcast.format");
    return format;
}

void check_window(const Header& header, const char* name, int n) {
    const auto found = header.find(name);
    if (found == header.end() || found->second.type != "box2i" || found->second.value.size() != 16)
        refuse("the header is damaged: no " + std::string(name));
    const char* value = found->second.value.data();
    const int x0 = int(exr::read_u32(value)), y0 = int(exr::read_u32(value + 4)),
              x1 = int(exr::read_u32(value + 8)), y1 = int(exr::read_u32(value + 12));
    if (x0 != 0 || y0 != 0 || x1 != n - 1 || y1 != n - 1)
        refuse("the header is damaged: " + std::string(name) + " is not " + std::to_string(n) + " square");
}

/// Lines that share a chunk, by the compression of the header: none, RLE, ZIPS, ZIP.
int lines_per_chunk(const Header& header) {
    constexpr int table[] = {1, 1, 1, 16};
    const int compression = number(header, "compression", "compression");
    if (compression < 0 || compression > 3) refuse("its compression is none that glcast writes");
    return table[compression];
}

/// Number of chunks of a part, from a header in which everything about size agrees.
int check_header(const Header& header, int n, int format) {
    if (check_format(header) != format) refuse("its parts differ in format");
    if (number(header, "glcast.n", "int") != n) refuse("its parts differ in n");
    check_window(header, "dataWindow", n);
    check_window(header, "displayWindow", n);
    const int lines = lines_per_chunk(header), chunks = (n + lines - 1) / lines;
    if (number(header, "chunkCount", "int") != chunks) refuse("the header is damaged: chunkCount");
    if (number(header, "lineOrder", "lineOrder") != 0) refuse("the header is damaged: lineOrder");
    return chunks;
}

void check_chunks(File& file, const std::vector<Header>& headers, const CaptureLayout& layout,
                  std::uint64_t tables_at) {
    std::vector<int> chunks;
    std::uint64_t total = 0;
    for (const Header& header : headers)
        total += chunks.emplace_back(check_header(header, layout.n, layout.format));
    const std::uint64_t data_at = tables_at + total * 8;
    if (data_at > file.size) refuse("the file is truncated");
    const std::vector<char> tables = file.read(tables_at, total * 8);
    const char* table = tables.data();
    std::uint64_t end = data_at;
    for (std::size_t part = 0; part < headers.size(); ++part) {
        const int lines = lines_per_chunk(headers[part]);
        for (int c = 0; c < chunks[part]; ++c, table += 8) {
            const std::uint64_t at = exr::read_u64(table);
            if (at == 0) refuse("the file was never finished");
            if (at < data_at || at > file.size || file.size - at < 12) refuse("the file is truncated");
            const std::vector<char> head = file.read(at, 12);
            const std::uint64_t size = exr::read_u32(head.data() + 8);
            if (exr::read_u32(head.data()) != part ||
                exr::read_u32(head.data() + 4) != std::uint32_t(c * lines))
                refuse("a chunk is damaged");
            if (size > file.size - at - 12) refuse("the file is truncated");
            end = std::max(end, at + 12 + size);
        }
    }
    if (end != file.size) refuse("the file is longer than its contents");
}

} // namespace

CaptureLayout check_capture_layout(const std::filesystem::path& path) {
    File file(path);
    if (file.size < 8) refuse(file.size == 0 ? "the file is empty" : "is no OpenEXR file");
    const std::vector<char> front = file.read(0, std::min<std::uint64_t>(file.size, largest_header));
    if (exr::read_u32(front.data()) != exr::magic) refuse("is no OpenEXR file");
    if (exr::read_u32(front.data() + 4) != exr::version_multipart)
        refuse("is an OpenEXR file, but no capture of glcast");
    std::size_t tables_at = 0;
    const std::vector<Header> headers = walk_headers(front, tables_at);
    if (headers.empty()) refuse("has no parts");
    CaptureLayout layout;
    layout.format = check_format(headers[0]);
    layout.n = number(headers[0], "glcast.n", "int");
    layout.parts = static_cast<int>(headers.size());
    layout.file_bytes = file.size;
    if (layout.n < min_resolution || layout.n > max_resolution)
        refuse("its n is " + std::to_string(layout.n) + ", not " + std::to_string(min_resolution) + " to " +
               std::to_string(max_resolution));
    const std::uint64_t pixels = std::uint64_t(layout.n) * layout.n * headers.size();
    if (pixels * bytes_per_pixel / best_ratio > file.size)
        refuse("the file is truncated: too short for its n");
    check_chunks(file, headers, layout, tables_at);
    return layout;
}

} // namespace glcast
