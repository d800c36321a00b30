#include "tools/io/exr_attributes.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace glcast::exr {
namespace {

constexpr std::size_t most_attributes = 256; // of a part; a capture has 27
constexpr std::size_t longest_name = 31;     // of files whose version does not announce long names

[[noreturn]] void damaged(std::string_view what) {
    throw std::runtime_error("the header is damaged: " + std::string(what));
}

struct TypeSize {
    std::string_view name;
    std::size_t bytes;
};
/// Types that are as long as they are, whatever stands in them. OpenEXR's others have parsers below, or are
/// of no use in a capture (preview, tiledesc, deepImageState, idmanifest, floatvector) and refused.
constexpr TypeSize fixed[] = {{"box2f", 16},      {"box2i", 16}, {"chromaticities", 32},
                              {"compression", 1}, {"double", 8}, {"envmap", 1},
                              {"float", 4},       {"int", 4},    {"keycode", 28},
                              {"lineOrder", 1},   {"m33d", 72},  {"m33f", 36},
                              {"m44d", 128},      {"m44f", 64},  {"rational", 8},
                              {"timecode", 8},    {"v2d", 16},   {"v2f", 8},
                              {"v2i", 8},         {"v3d", 24},   {"v3f", 12},
                              {"v3i", 12}};

/// Names by which OpenEXR takes a part for something else than plain lines of one picture.
constexpr std::string_view structural[] = {
    "deepImageState", "idManifest", "maxSamplesPerPixel", "multiView", "preview", "tiles", "version"};

/// Reads a value from its start to its end.
class Cursor {
  public:
    explicit Cursor(std::span<const char> bytes) : rest(bytes) {}
    bool done() const { return rest.empty(); }
    bool skip(std::size_t count) {
        if (count > rest.size()) return false;
        rest = rest.subspan(count);
        return true;
    }
    bool u32(std::uint32_t& value) {
        if (rest.size() < 4) return false;
        value = read_u32(rest.data());
        return skip(4);
    }
    bool text(std::size_t length, std::string_view& value) {
        value = {rest.data(), std::min(length, rest.size())};
        return skip(length);
    }
    bool text_to_zero(std::string_view& value) {
        const void* end = rest.empty() ? nullptr : std::memchr(rest.data(), 0, rest.size());
        return end && text(std::size_t(static_cast<const char*>(end) - rest.data()), value) && skip(1);
    }

  private:
    std::span<const char> rest;
};

/// True when the strings fill the value to its last byte.
bool parse_strings(std::span<const char> value, std::vector<std::string>* strings) {
    Cursor cursor(value);
    while (!cursor.done()) {
        std::uint32_t length;
        std::string_view text;
        if (!cursor.u32(length) || !cursor.text(length, text)) return false;
        if (strings) strings->emplace_back(text);
    }
    return true;
}

/// True when the channels and the 0 behind them fill the value to its last byte.
bool parse_channels(std::span<const char> value, std::vector<ChannelType>* channels) {
    Cursor cursor(value);
    for (;;) {
        std::string_view name;
        if (!cursor.text_to_zero(name) || name.size() > longest_name) return false;
        if (name.empty()) return cursor.done();
        std::uint32_t type, x, y;
        if (!cursor.u32(type) || !cursor.skip(4) || !cursor.u32(x) || !cursor.u32(y)) return false;
        if (channels) channels->push_back({std::string(name), int(type), int(x), int(y)});
    }
}

bool fills_its_length(const Attribute& attribute) {
    if (attribute.type == "string") return true;
    if (attribute.type == "stringvector") return parse_strings(attribute.value, nullptr);
    if (attribute.type == "chlist") return parse_channels(attribute.value, nullptr);
    const auto* type = std::ranges::find(fixed, attribute.type, &TypeSize::name);
    return type != std::end(fixed) && attribute.value.size() == type->bytes;
}

void add(Attributes& header, const Attribute& attribute) {
    const std::string name(attribute.name);
    if (name.size() > longest_name || attribute.type.size() > longest_name) damaged("a name is too long");
    if (std::ranges::find(structural, attribute.name) != std::end(structural))
        damaged(name + " is in no capture");
    if (!fills_its_length(attribute))
        damaged(name + " is not as long as its type, or of a type in no capture");
    if (!header.emplace(attribute.name, attribute).second) damaged(name + " is there twice");
    if (header.size() > most_attributes) damaged("too many attributes");
}

std::span<const char> value(const Attributes& header, std::string_view name, std::string_view type) {
    const auto found = header.find(name);
    if (found == header.end() || found->second.type != type) damaged("no " + std::string(name));
    return found->second.value;
}

/// Of an attribute whose length was checked when it was read.
template <class T>
std::vector<T> numbers(const Attributes& header, std::string_view name, std::string_view type) {
    const std::span<const char> bytes = value(header, name, type);
    std::vector<T> all(bytes.size() / sizeof(T));
    std::memcpy(all.data(), bytes.data(), all.size() * sizeof(T));
    return all;
}

} // namespace

std::vector<Attributes> read_headers(std::span<const char> bytes, std::size_t& offset,
                                     std::size_t most_parts) {
    std::vector<Attributes> headers;
    for (;;) {
        if (offset >= bytes.size()) throw std::runtime_error("the file is truncated");
        if (bytes[offset] == 0) break;
        if (headers.size() == most_parts) damaged("too many parts");
        Attributes& header = headers.emplace_back();
        for (;;) {
            Attribute attribute;
            if (!next_attribute(bytes, offset, attribute))
                throw std::runtime_error("the file is truncated or its header damaged");
            if (attribute.name.empty()) break;
            add(header, attribute);
        }
    }
    ++offset;
    return headers;
}

int int_value(const Attributes& header, std::string_view name) { return ints_value(header, name, "int")[0]; }
double double_value(const Attributes& header, std::string_view name) {
    return doubles_value(header, name, "double")[0];
}
unsigned char byte_value(const Attributes& header, std::string_view name) {
    return static_cast<unsigned char>(value(header, name, name)[0]);
}
std::string string_value(const Attributes& header, std::string_view name) {
    const std::span<const char> text = value(header, name, "string");
    return {text.begin(), text.end()};
}
std::vector<std::string> strings_value(const Attributes& header, std::string_view name) {
    std::vector<std::string> strings;
    parse_strings(value(header, name, "stringvector"), &strings);
    return strings;
}
std::vector<int> ints_value(const Attributes& header, std::string_view name, std::string_view type) {
    return numbers<int>(header, name, type);
}
std::vector<double> doubles_value(const Attributes& header, std::string_view name, std::string_view type) {
    return numbers<double>(header, name, type);
}
std::vector<ChannelType> channels_value(const Attributes& header, std::string_view name) {
    std::vector<ChannelType> channels;
    parse_channels(value(header, name, "chlist"), &channels);
    return channels;
}

} // namespace glcast::exr
