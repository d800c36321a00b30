// The bytes of an OpenEXR header: written by the capture file, walked over wherever a header must be skipped
// or checked.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glcast::exr {

inline constexpr std::uint32_t magic = 20000630;
inline constexpr std::uint32_t version_multipart = 2 | 0x1000;

/// Appends little-endian values, as OpenEXR wants them.
struct Bytes {
    std::vector<char> data;

    void raw(const void* from, std::size_t size);
    void u32(std::uint32_t value);
    void u64(std::uint64_t value);
    void text(std::string_view value); ///< with the closing 0
};

/// Attributes of one header; each appends name, type, size and value.
void add_int(Bytes& to, std::string_view name, int value);
void add_byte(Bytes& to, std::string_view name, std::string_view type, unsigned char value);
void add_float(Bytes& to, std::string_view name, float value);
void add_double(Bytes& to, std::string_view name, double value);
void add_string(Bytes& to, std::string_view name, std::string_view value);
void add_strings(Bytes& to, std::string_view name, const std::vector<std::string>& values);
void add_v2f(Bytes& to, std::string_view name, float x, float y);
void add_v3i(Bytes& to, std::string_view name, const int* xyz);
void add_v3d(Bytes& to, std::string_view name, const double* xyz);
void add_m44d(Bytes& to, std::string_view name, const double* rows); ///< 16 values
void add_box2i(Bytes& to, std::string_view name, int x0, int y0, int x1, int y1);

struct Attribute {
    std::string_view name, type;
    std::span<const char> value;
};

/// Reads the attribute at `offset` and moves past it; at the end of the header moves past its 0 and gives an
/// empty name. False when the bytes end before, or the size is impossible.
bool next_attribute(std::span<const char> bytes, std::size_t& offset, Attribute& attribute);

std::uint32_t read_u32(const char* from);
std::uint64_t read_u64(const char* from);

} // namespace glcast::exr
