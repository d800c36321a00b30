#include "capture/exr_header.h"

#include <bit>
#include <cstring>

namespace glcast::exr {

static_assert(std::endian::native == std::endian::little,
              "OpenEXR is little-endian; swap bytes here for other machines");

void Bytes::raw(const void* from, std::size_t size) {
    const char* bytes = static_cast<const char*>(from);
    data.insert(data.end(), bytes, bytes + size);
}
void Bytes::u32(std::uint32_t value) { raw(&value, sizeof value); }
void Bytes::u64(std::uint64_t value) { raw(&value, sizeof value); }
void Bytes::text(std::string_view value) {
    raw(value.data(), value.size());
    data.push_back(0);
}

namespace {

void add(Bytes& to, std::string_view name, std::string_view type, const void* value, std::size_t size) {
    to.text(name);
    to.text(type);
    to.u32(static_cast<std::uint32_t>(size));
    to.raw(value, size);
}

} // namespace

void add_int(Bytes& to, std::string_view name, int value) { add(to, name, "int", &value, sizeof value); }
void add_byte(Bytes& to, std::string_view name, std::string_view type, unsigned char value) {
    add(to, name, type, &value, 1);
}
void add_float(Bytes& to, std::string_view name, float value) {
    add(to, name, "float", &value, sizeof value);
}
void add_double(Bytes& to, std::string_view name, double value) {
    add(to, name, "double", &value, sizeof value);
}
void add_string(Bytes& to, std::string_view name, std::string_view value) {
    add(to, name, "string", value.data(), value.size());
}
void add_strings(Bytes& to, std::string_view name, const std::vector<std::string>& values) {
    Bytes value;
    for (const std::string& s : values) {
        value.u32(static_cast<std::uint32_t>(s.size()));
        value.raw(s.data(), s.size());
    }
    add(to, name, "stringvector", value.data.data(), value.data.size());
}
void add_v2f(Bytes& to, std::string_view name, float x, float y) {
    const float value[] = {x, y};
    add(to, name, "v2f", value, sizeof value);
}
void add_v3i(Bytes& to, std::string_view name, const int* xyz) { add(to, name, "v3i", xyz, 3 * sizeof *xyz); }
void add_v3d(Bytes& to, std::string_view name, const double* xyz) {
    add(to, name, "v3d", xyz, 3 * sizeof *xyz);
}
void add_m44d(Bytes& to, std::string_view name, const double* rows) {
    add(to, name, "m44d", rows, 16 * sizeof *rows);
}
void add_box2i(Bytes& to, std::string_view name, int x0, int y0, int x1, int y1) {
    const int value[] = {x0, y0, x1, y1};
    add(to, name, "box2i", value, sizeof value);
}

std::uint32_t read_u32(const char* from) {
    std::uint32_t value;
    std::memcpy(&value, from, sizeof value);
    return value;
}
std::uint64_t read_u64(const char* from) {
    std::uint64_t value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

bool next_attribute(std::span<const char> bytes, std::size_t& offset, Attribute& attribute) {
    const auto text = [&](std::string_view& to) {
        if (offset >= bytes.size()) return false;
        const char* begin = bytes.data() + offset;
        const void* end = std::memchr(begin, 0, bytes.size() - offset);
        if (!end) return false;
        to = std::string_view(begin, static_cast<const char*>(end) - begin);
        offset += to.size() + 1;
        return true;
    };
    attribute = {};
    if (!text(attribute.name)) return false;
    if (attribute.name.empty()) return true;
    if (!text(attribute.type) || bytes.size() - offset < 4) return false;
    const std::uint32_t size = read_u32(bytes.data() + offset);
    offset += 4;
    if (size > bytes.size() - offset) return false;
    attribute.value = bytes.subspan(offset, size);
    offset += size;
    return true;
}

} // namespace glcast::exr
