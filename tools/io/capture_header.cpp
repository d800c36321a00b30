#include "tools/io/capture_header.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "tools/io/exr_attributes.h"

namespace glcast {
namespace {

using exr::Attributes;

constexpr std::uint64_t largest_header =
    16u << 20; // hundreds of parts of a few kB each, and thousands of not-understood calls
constexpr std::uint64_t best_ratio = 1100;    // deflate makes 1032 bytes of one at most
constexpr std::uint64_t bytes_per_pixel = 26; // at least
constexpr int format_of_both_sides = 3;
constexpr std::size_t most_parts = 3 * (max_layers + 1);

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }
[[noreturn]] void damaged(const std::string& what) { refuse("the header is damaged: " + what); }

int check_format(const Attributes& header) {
    if (!header.contains("glcast.format")) refuse("is an OpenEXR file, but no capture of glcast");
    const int format = exr::int_value(header, "glcast.format");
    if (format > capture_format_version)
        refuse("was made by a newer glcast: its format is " + std::to_string(format) +
               ", this one reads up to " + std::to_string(capture_format_version));
    if (format < 1) damaged("glcast.format");
    return format;
}

void check_window(const Attributes& header, const char* name, int n) {
    const int square[] = {0, 0, n - 1, n - 1};
    if (!std::ranges::equal(exr::ints_value(header, name, "box2i"), square))
        damaged(std::string(name) + " is not " + std::to_string(n) + " square");
}

/// What OpenEXR needs to know, and what must be one value in a capture.
void check_standard(const Attributes& header, int n, exr::Compression compression) {
    check_window(header, "dataWindow", n);
    check_window(header, "displayWindow", n);
    const int lines = exr::lines_per_chunk(compression);
    if (exr::int_value(header, "chunkCount") != (n + lines - 1) / lines) damaged("chunkCount");
    if (exr::byte_value(header, "lineOrder") != 0) damaged("lineOrder");
    if (exr::string_value(header, "type") != "scanlineimage") damaged("type");
}

exr::Compression compression_of(const Attributes& header) {
    const int number = exr::byte_value(header, "compression");
    if (number > static_cast<int>(exr::Compression::zip))
        refuse("its compression is none that glcast writes");
    return static_cast<exr::Compression>(number);
}

std::span<const char* const> channel_names(bool both_sides) {
    static constexpr const char* of_one[channel_count] = {"A",   "B",   "G", "N.V", "N.X",
                                                          "N.Y", "N.Z", "R", "Z"};
    static constexpr const char* of_both[both_channel_count] = {
        "A",   "B",   "G",     "N.V",   "N.X",   "N.Y",   "N.Z", "R",
        "T.B", "T.G", "T.N.V", "T.N.X", "T.N.Y", "T.N.Z", "T.R", "Z"};
    if (both_sides) return of_both;
    return of_one;
}

std::vector<bool> channels_of(const Attributes& header, bool both_sides) {
    const auto names = channel_names(both_sides);
    constexpr int half = 1, whole_float = 2;
    const std::vector<exr::ChannelType> channels = exr::channels_value(header, "channels");
    if (channels.size() != names.size()) damaged("channels");
    std::vector<bool> is_half(names.size());
    for (std::size_t c = 0; c < names.size(); ++c) {
        const exr::ChannelType& channel = channels[c];
        if (channel.name != names[c] || (channel.type != half && channel.type != whole_float) ||
            channel.x_sampling != 1 || channel.y_sampling != 1)
            damaged("channels");
        is_half[c] = channel.type == half;
    }
    return is_half;
}

View view_of(const Attributes& header) {
    const std::string axis = exr::string_value(header, "glcast.axis"),
                      side = exr::string_value(header, "glcast.side");
    const std::size_t index = axis.size() == 1 ? std::string("xyz").find(axis) : std::string::npos;
    if (index == std::string::npos || (side != "-" && side != "+")) damaged("view");
    const View view{static_cast<Axis>(index), side == "-" ? Side::minus : Side::plus,
                    exr::int_value(header, "glcast.layer")};
    if (view.layer < 0 || view.layer >= max_layers || exr::string_value(header, "name") != part_name(view))
        damaged("view");
    return view;
}

/// "12 glFancy" -> {"glFancy", 12}
std::map<std::string, long> counts_of(const std::vector<std::string>& lines) {
    std::map<std::string, long> counts;
    for (const std::string& line : lines) {
        const std::size_t space = line.find(' ');
        if (space == 0 || space > 18 || line.find_first_not_of("0123456789") != space)
            damaged("glcast.notUnderstood");
        counts[line.substr(space + 1)] = std::stol(line.substr(0, space));
    }
    return counts;
}

template <class Kind>
Kind named(const Attributes& header, const char* attribute, const char* (*name_of)(Kind)) {
    const std::string name = exr::string_value(header, attribute);
    for (int k = 0; k < 3; ++k)
        if (name == name_of(static_cast<Kind>(k))) return static_cast<Kind>(k);
    damaged(attribute);
}

/// Format 1 has no layers but the first.
void read_layers(const Attributes& header, CaptureInfo& info) {
    if (exr::int_value(header, "glcast.format") < 2) return;
    info.layers = named(header, "glcast.layers", layers_name);
    info.layer_method = named(header, "glcast.layerMethod", layer_method_name);
    const std::vector<int> count = exr::ints_value(header, "glcast.layerCount", "v3i");
    std::ranges::copy(count, info.layer_count.begin());
    for (int layers : info.layer_count)
        if (layers < 1 || layers > max_layers) damaged("glcast.layerCount");
    if ((info.layer_method != LayerMethod::none) != (info.layers != Layers::outer)) damaged("glcast.layers");
}

glm::dmat4 matrix_of(const Attributes& header, const char* name) {
    const std::vector<double> rows = exr::doubles_value(header, name, "m44d");
    glm::dmat4 m;
    for (int k = 0; k < 16; ++k) {
        if (!std::isfinite(rows[k])) damaged(std::string(name) + " is not finite");
        m[k % 4][k / 4] = rows[k];
    }
    return m;
}

glm::dvec3 place_of(const Attributes& header, const std::string& name) {
    const std::vector<double> at = exr::doubles_value(header, name, "v3d");
    for (const double each : at)
        if (!std::isfinite(each)) damaged(name + " is not finite");
    return {at[0], at[1], at[2]};
}

/// Older captures have none.
void read_places(const Attributes& header, CaptureInfo& info) {
    if (header.contains("glcast.eye")) info.eye = place_of(header, "glcast.eye");
    for (std::size_t k = 0; k < most_seen_places && header.contains(seen_place_name(k)); ++k)
        info.seen_places.push_back(place_of(header, seen_place_name(k)));
}

Box box_of(const Attributes& header, int n) {
    const std::vector<double> lo = exr::doubles_value(header, "glcast.boxLo", "v3d");
    const Box box{{lo[0], lo[1], lo[2]}, exr::double_value(header, "glcast.boxSize")};
    if (const char* why = why_no_box(box, n)) damaged(why);
    return box;
}

CaptureInfo info_of(const Attributes& header) {
    CaptureInfo info;
    info.n = exr::int_value(header, "glcast.n");
    info.box = box_of(header, info.n);
    info.eye_to_capture = matrix_of(header, "glcast.eyeToCapture");
    if (header.contains("glcast.fromCapture")) info.from_capture = matrix_of(header, "glcast.fromCapture");
    read_places(header, info);
    info.program = exr::string_value(header, "glcast.program");
    info.frame = exr::int_value(header, "glcast.frame");
    info.renderer = exr::string_value(header, "glcast.renderer");
    info.normals = exr::string_value(header, "glcast.normals");
    info.glcast_version = exr::string_value(header, "glcast.version");
    info.not_understood = counts_of(exr::strings_value(header, "glcast.notUnderstood"));
    read_layers(header, info);
    if (header.contains("glcast.backs")) {
        info.reversed_backs = exr::string_value(header, "glcast.backs") == backs_reversed;
        if (!info.reversed_backs) damaged("glcast.backs");
    }
    info.both_sides = exr::int_value(header, "glcast.format") >= format_of_both_sides;
    return info;
}

/// What the capture says of itself is said alike in all its parts, byte by byte.
void check_the_same(const Attributes& first, const Attributes& header) {
    constexpr std::string_view own[] = {"glcast.axis", "glcast.side", "glcast.layer", "glcast.covered",
                                        "glcast.withNormal"};
    const auto is_shared = [&](std::string_view name) {
        return name.starts_with("glcast.") && std::ranges::find(own, name) == std::end(own);
    };
    const auto count = [&](const Attributes& of) {
        return std::ranges::count_if(of, [&](const auto& a) { return is_shared(a.first); });
    };
    for (const auto& [name, attribute] : first) {
        if (!is_shared(name)) continue;
        const auto other = header.find(name);
        if (other == header.end() || other->second.type != attribute.type ||
            !std::ranges::equal(other->second.value, attribute.value))
            refuse("its parts differ in " + std::string(name));
    }
    if (count(first) != count(header)) refuse("its parts differ in their attributes");
}

PartHeader part_of(const Attributes& header, const CaptureInfo& info) {
    PartHeader part;
    part.view = view_of(header);
    part.compression = compression_of(header);
    part.half = channels_of(header, info.both_sides);
    part.covered = exr::int_value(header, "glcast.covered");
    part.with_normal = exr::int_value(header, "glcast.withNormal");
    check_standard(header, info.n, part.compression);
    return part;
}

std::vector<char> read_front(const InputFile& file) {
    if (file.size() < 8) refuse(file.size() == 0 ? "the file is empty" : "is no OpenEXR file");
    std::vector<char> front = file.read(0, std::min(file.size(), largest_header));
    if (exr::read_u32(front.data()) != exr::magic) refuse("is no OpenEXR file");
    if (exr::read_u32(front.data() + 4) != exr::version_multipart)
        refuse("is an OpenEXR file, but no capture of glcast");
    return front;
}

void check_size(const InputFile& file, int n, std::size_t parts) {
    if (n < min_resolution || n > max_resolution)
        refuse("its n is " + std::to_string(n) + ", not " + std::to_string(min_resolution) + " to " +
               std::to_string(max_resolution));
    if (std::uint64_t(n) * std::uint64_t(n) * parts * bytes_per_pixel / best_ratio > file.size())
        refuse("the file is truncated: too short for its n");
}

} // namespace

CaptureHeader read_capture_header(const InputFile& file) {
    const std::vector<char> front = read_front(file);
    CaptureHeader capture;
    std::size_t offset = 8;
    const std::vector<Attributes> headers = exr::read_headers(front, offset, most_parts);
    if (headers.empty()) refuse("has no parts");
    check_format(headers[0]);
    check_size(file, exr::int_value(headers[0], "glcast.n"), headers.size());
    capture.info = info_of(headers[0]);
    for (const Attributes& header : headers) {
        check_format(header);
        check_the_same(headers[0], header);
        capture.parts.push_back(part_of(header, capture.info));
    }
    capture.tables_at = offset;
    return capture;
}

} // namespace glcast
