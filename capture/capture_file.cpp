#include "capture/capture_file.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <set>
#include <span>

#include "capture/band_writer.h"
#include "capture/exr_header.h"
#include "capture/output_file.h"

namespace glcast {
namespace {

using exr::Bytes;

constexpr exr::Compression compression = exr::Compression::zip; // why: docs/reference/capture-format.md

// Alphabetical, as OpenEXR stores them. Half normals would be off by 0.02 degrees, float ones are not (docs).
const exr::Channel channel_table[] = {{"A", true},    {"B", true},    {"G", true},
                                      {"N.V", true},  {"N.X", false}, {"N.Y", false},
                                      {"N.Z", false}, {"R", true},    {"Z", false}};
constexpr int channel_count = std::size(channel_table);

// Of captures of both sides: T is what a viewer on the other side sees.
const exr::Channel both_channel_table[] = {
    {"A", true},      {"B", true},      {"G", true},   {"N.V", true}, {"N.X", false},  {"N.Y", false},
    {"N.Z", false},   {"R", true},      {"T.B", true}, {"T.G", true}, {"T.N.V", true}, {"T.N.X", false},
    {"T.N.Y", false}, {"T.N.Z", false}, {"T.R", true}, {"Z", false}};
constexpr int both_channel_count = std::size(both_channel_table);

std::span<const exr::Channel> channels_of(const CaptureInfo& info) {
    if (info.both_sides) return both_channel_table;
    return channel_table;
}

constexpr int format_of_one_side = 2;

struct Part {
    View view;
    int covered = 0, with_normal = 0; ///< pixels
};

int chunks_per_part(int n) {
    const int lines = exr::lines_per_chunk(compression);
    return (n + lines - 1) / lines;
}

void add_channels(Bytes& to, const CaptureInfo& info) {
    Bytes list;
    for (const exr::Channel& channel : channels_of(info)) {
        list.text(channel.name);
        list.u32(channel.half ? 1 : 2);
        list.u32(0); // linear flag and padding
        list.u32(1); // sampling
        list.u32(1);
    }
    list.data.push_back(0);
    to.text("channels");
    to.text("chlist");
    to.u32(static_cast<std::uint32_t>(list.data.size()));
    to.raw(list.data.data(), list.data.size());
}

void add_standard(Bytes& to, const CaptureInfo& info, const std::string& name) {
    add_channels(to, info);
    exr::add_int(to, "chunkCount", chunks_per_part(info.n));
    exr::add_byte(to, "compression", "compression", static_cast<unsigned char>(compression));
    exr::add_box2i(to, "dataWindow", 0, 0, info.n - 1, info.n - 1);
    exr::add_box2i(to, "displayWindow", 0, 0, info.n - 1, info.n - 1);
    exr::add_byte(to, "lineOrder", "lineOrder", 0);
    exr::add_string(to, "name", name);
    exr::add_float(to, "pixelAspectRatio", 1);
    exr::add_v2f(to, "screenWindowCenter", 0, 0);
    exr::add_float(to, "screenWindowWidth", 1);
    exr::add_string(to, "type", "scanlineimage");
}

void add_matrix(Bytes& to, const char* name, const glm::dmat4& matrix) {
    double rows[16]; // glm keeps columns
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) rows[r * 4 + c] = matrix[c][r];
    exr::add_m44d(to, name, rows);
}

void add_capture(Bytes& to, const CaptureInfo& info) {
    exr::add_int(to, "glcast.format", info.both_sides ? capture_format_version : format_of_one_side);
    exr::add_int(to, "glcast.n", info.n);
    exr::add_v3d(to, "glcast.boxLo", &info.box.lo.x);
    exr::add_double(to, "glcast.boxSize", info.box.size);
    add_matrix(to, "glcast.eyeToCapture", info.eye_to_capture);
    if (info.from_capture) add_matrix(to, "glcast.fromCapture", *info.from_capture);
    if (info.eye) exr::add_v3d(to, "glcast.eye", &info.eye->x);
    for (std::size_t k = 0; k < info.seen_places.size(); ++k)
        exr::add_v3d(to, seen_place_name(k).c_str(), &info.seen_places[k].x);
    exr::add_string(to, "glcast.program", info.program);
    exr::add_int(to, "glcast.frame", static_cast<int>(std::min<long>(info.frame, INT32_MAX)));
    exr::add_string(to, "glcast.renderer", info.renderer);
    exr::add_string(to, "glcast.normals", info.normals);
    exr::add_string(to, "glcast.version", info.glcast_version);
    std::vector<std::string> counts;
    for (const auto& [what, count] : info.not_understood)
        counts.push_back(std::to_string(count) + " " + what);
    exr::add_strings(to, "glcast.notUnderstood", counts);
    if (info.reversed_backs && !info.both_sides) exr::add_string(to, "glcast.backs", backs_reversed);
    exr::add_string(to, "glcast.layers", layers_name(info.layers));
    exr::add_string(to, "glcast.layerMethod", layer_method_name(info.layer_method));
    exr::add_v3i(to, "glcast.layerCount", info.layer_count.data());
}

void add_part(Bytes& to, const CaptureInfo& info, const Part& part, const std::string& name) {
    add_standard(to, info, name);
    add_capture(to, info);
    exr::add_string(to, "glcast.axis", std::string(1, "xyz"[static_cast<int>(part.view.axis)]));
    exr::add_string(to, "glcast.side", part.view.side == Side::minus ? "-" : "+");
    exr::add_int(to, "glcast.layer", part.view.layer);
    exr::add_int(to, "glcast.covered", part.covered);
    exr::add_int(to, "glcast.withNormal", part.with_normal);
    to.data.push_back(0);
}

Bytes all_headers(const CaptureInfo& info, const std::vector<Part>& parts) {
    Bytes bytes;
    bytes.u32(exr::magic);
    bytes.u32(exr::version_multipart);
    for (const Part& part : parts) add_part(bytes, info, part, part_name(part.view));
    bytes.data.push_back(0);
    return bytes;
}

/// Room for the headers of any views and layers: only the digits of the layer and what is said of all layers
/// differ.
std::size_t room_for_headers(CaptureInfo info, int parts) {
    Part longest;
    longest.view.layer = max_layers;
    info.layers = Layers::incomplete;
    info.layer_method = LayerMethod::slab;
    return all_headers(info, std::vector<Part>(parts, longest)).data.size();
}

float tame(float value, float lo, float hi) { return std::isnan(value) ? 0.0f : std::clamp(value, lo, hi); }

bool is_finite(const glm::vec4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// What channels T of a pixel hold, into `planes` from the first of them on. Alike from both sides where the
/// image says nothing.
void put_other_side(const ViewImage& image, std::size_t from, std::size_t to, bool covered,
                    std::vector<std::vector<float>>& planes) {
    const bool is_known = !image.other_colour.empty() && !image.other_normal.empty();
    const glm::vec4 colour = covered ? (is_known ? image.other_colour : image.colour)[from] : glm::vec4(0);
    const glm::vec4 normal = (is_known ? image.other_normal : image.normal)[from];
    const bool valid = covered && normal.w > 0 && is_finite(normal);
    const float values[] = {tame(colour.b, 0, 1),
                            tame(colour.g, 0, 1),
                            valid ? 1.0f : 0.0f,
                            valid ? exr::without_noise(normal.x) : 0.0f,
                            valid ? exr::without_noise(normal.y) : 0.0f,
                            valid ? exr::without_noise(normal.z) : 0.0f,
                            tame(colour.r, 0, 1)};
    for (std::size_t c = 0; c < std::size(values); ++c) planes[channel_count - 1 + c][to] = values[c];
}

/// The channels of image row `row`, in the order of channel_table; what GL may leave odd is made plain here:
/// nothing that is not a number, colours and depths in 0..1, nothing but background where nothing was drawn.
void put_row(const ViewImage& image, int row, int line, std::vector<std::vector<float>>& planes, Part& part) {
    const int n = image.n;
    for (int column = 0; column < n; ++column) {
        const std::size_t from = static_cast<std::size_t>(row) * n + column,
                          to = static_cast<std::size_t>(line) * n + column;
        const bool covered = image.covered(from) && std::isfinite(image.depth[from]);
        const glm::vec4 colour = covered ? image.colour[from] : glm::vec4(0), normal = image.normal[from];
        const bool valid = covered && normal.w > 0 && is_finite(normal);
        const float values[channel_count] = {covered ? 1.0f : 0.0f,
                                             tame(colour.b, 0, 1),
                                             tame(colour.g, 0, 1),
                                             valid ? 1.0f : 0.0f,
                                             valid ? exr::without_noise(normal.x) : 0.0f,
                                             valid ? exr::without_noise(normal.y) : 0.0f,
                                             valid ? exr::without_noise(normal.z) : 0.0f,
                                             tame(colour.r, 0, 1),
                                             covered ? std::clamp(image.depth[from], 0.0f, 1.0f)
                                                     : ViewImage::background(image.view.side)};
        for (int c = 0; c < channel_count - 1; ++c) planes[c][to] = values[c];
        planes.back()[to] = values[channel_count - 1];
        if (std::ssize(planes) == both_channel_count) put_other_side(image, from, to, covered, planes);
        part.covered += covered;
        part.with_normal += valid;
    }
}

} // namespace

const char* why_no_box(const Box& box, int n) {
    constexpr double smallest = 1e-18, largest = 1e18, doubles = 0x1p-40; // 52 bits less 12
    double far = 0;
    for (int k = 0; k < 3; ++k)
        for (double end : {box.lo[k], box.lo[k] + box.size}) {
            if (!std::isfinite(end)) return "the box is not finite";
            far = std::max(far, std::abs(end));
        }
    if (!(box.size > 0)) return "the box is empty";
    if (box.size < smallest || far > largest) return "the box is too small or too large";
    if (box.size / n < far * doubles) return "the box is too far from the origin for its size";
    return nullptr;
}

std::string seen_place_name(std::size_t number) { return "glcast.seenPlace." + std::to_string(number); }

std::string part_name(const View& view) {
    return std::string(view.side == Side::minus ? "-" : "+") + "xyz"[static_cast<int>(view.axis)] + "." +
           std::to_string(view.layer);
}

const char* layers_name(Layers layers) {
    constexpr const char* names[] = {"outer", "incomplete", "complete"};
    return names[static_cast<int>(layers)];
}

const char* layer_method_name(LayerMethod method) {
    constexpr const char* names[] = {"none", "peel", "slab"};
    return names[static_cast<int>(method)];
}

struct CaptureWriter::Impl {
    CaptureInfo info;
    std::size_t most;
    OutputFile file;
    std::vector<Part> parts;
    std::size_t header_room = 0;
    std::optional<BandWriter> bands;
    std::set<std::pair<Side, int>> blanks_given; ///< by the number of lines
    std::string error;

    Impl(std::string path, const CaptureInfo& capture, int part_count)
        : info(capture), most(static_cast<std::size_t>(std::max(part_count, 0))), file(std::move(path)) {}

    bool fail(std::string why) {
        if (error.empty()) error = std::move(why);
        return false;
    }
    bool file_failed() { return fail(file.error()); }
    bool bands_failed() {
        bands->drain();
        return fail(bands->error());
    }

    bool start();
    bool has(const View& view) const {
        return std::any_of(parts.begin(), parts.end(), [&](const Part& part) { return part.view == view; });
    }
    bool check(const ViewImage& image);
    bool check_layer(const View& view);
    bool add(const ViewImage& image);
    bool add_lines(const ViewImage& image, int line, int lines, Part& part);
    bool count_layers(Layers layers, LayerMethod method);
    bool finish(Layers layers, LayerMethod method);
};

bool CaptureWriter::Impl::start() {
    if (!file.error().empty()) return file_failed();
    if (info.n < min_resolution || info.n > max_resolution)
        return fail("n must be from 8 to 8192, not " + std::to_string(info.n));
    if (const char* why = why_no_box(info.box, info.n)) return fail(why);
    if (most < 6) return fail("a capture needs six views");
    if (most > 3 * (max_layers + 1)) return fail("too many layers");
    header_room = room_for_headers(info, static_cast<int>(most));
    const std::size_t tables = most * static_cast<std::size_t>(chunks_per_part(info.n)) * 8;
    if (!file.skip_to(header_room + tables)) return file_failed();
    const auto channels = channels_of(info);
    const BandFormat format{info.n, {channels.begin(), channels.end()}, compression};
    bands.emplace(file, format, chunks_per_part(info.n));
    return true;
}

bool CaptureWriter::Impl::check_layer(const View& view) {
    const std::string name = part_name(view);
    if (has(view)) return fail("view " + name + " comes twice");
    if (view.layer == 0) return true;
    if (view.layer < 0 || view.layer >= max_layers || view.side != Side::minus)
        return fail("there is no layer " + name);
    const View before{view.axis, view.side, view.layer - 1};
    return has(before) || fail("layer " + name + " comes before " + part_name(before));
}

bool CaptureWriter::Impl::check(const ViewImage& image) {
    const std::size_t pixels = static_cast<std::size_t>(info.n) * static_cast<std::size_t>(info.n);
    const std::string name = part_name(image.view);
    if (image.n != info.n || image.depth.size() != pixels || image.colour.size() != pixels ||
        image.normal.size() != pixels)
        return fail("view " + name + " has the wrong size");
    if (parts.size() == most) return fail("more views than announced");
    return check_layer(image.view);
}

/// Line 0 of the file is on top, row 0 of the image below.
bool shows_nothing(const ViewImage& image, int line, int lines) {
    const auto end = image.colour.end() - std::ptrdiff_t(line) * image.n;
    return std::none_of(end - std::ptrdiff_t(lines) * image.n, end,
                        [](const glm::vec4& c) { return c.a > 0; });
}

bool CaptureWriter::Impl::add_lines(const ViewImage& image, int line, int lines, Part& part) {
    Band band = bands->next();
    band.part = static_cast<int>(parts.size());
    band.first_line = line;
    band.lines = lines;
    band.blank.reset();
    if (shows_nothing(image, line, lines)) band.blank = image.view.side;
    const bool known = band.blank && !blanks_given.insert({image.view.side, lines}).second;
    for (int k = 0; k < lines && !known; ++k) put_row(image, info.n - 1 - (line + k), k, band.planes, part);
    return bands->put(std::move(band)) || bands_failed();
}

bool CaptureWriter::Impl::add(const ViewImage& image) {
    if (!error.empty() || !check(image)) return false;
    const int n = info.n, most_lines = exr::lines_per_chunk(compression);
    Part part;
    part.view = image.view;
    for (int line = 0; line < n; line += most_lines)
        if (!add_lines(image, line, std::min(most_lines, n - line), part)) return false;
    parts.push_back(part);
    return true;
}

bool CaptureWriter::Impl::count_layers(Layers layers, LayerMethod method) {
    info.layer_count = {};
    for (const Part& part : parts)
        if (part.view.side == Side::minus) ++info.layer_count[static_cast<int>(part.view.axis)];
    info.layers = layers;
    info.layer_method = method;
    const bool looked = method != LayerMethod::none, deeper = parts.size() > 6;
    return (looked == (layers != Layers::outer) && (looked || !deeper)) ||
           fail("what is said of the layers does not go with them");
}

bool CaptureWriter::Impl::finish(Layers layers, LayerMethod method) {
    if (!error.empty()) return false;
    if (!bands->drain()) return bands_failed();
    for (Axis axis : {Axis::x, Axis::y, Axis::z})
        for (Side side : {Side::minus, Side::plus}) {
            const View view{axis, side, 0};
            if (!has(view)) return fail("view " + part_name(view) + " is missing");
        }
    if (!count_layers(layers, method)) return false;
    Bytes front = all_headers(info, parts);
    if (front.data.size() > header_room) return fail("the headers are longer than the room kept for them");
    for (int part = 0; part < static_cast<int>(parts.size()); ++part)
        for (std::uint64_t at : bands->chunks_of(part)) front.u64(at);
    // What is left before the first chunk stays a gap of zeros; readers follow the offset tables.
    return (file.write_at(0, front.data.data(), front.data.size()) && file.commit()) || file_failed();
}

namespace {

/// Nothing leaves a writer as an exception: it works inside somebody else's program.
template <class F> bool guarded(std::string* error, F&& body) {
    try {
        return body();
    } catch (const std::exception& e) {
        if (error && error->empty()) *error = e.what(); // short strings: no allocation
    }
    return false;
}

} // namespace

CaptureWriter::CaptureWriter(std::string path, const CaptureInfo& info, int most_parts) {
    guarded(nullptr, [&] {
        impl = std::make_unique<Impl>(std::move(path), info, most_parts);
        return true;
    });
    if (impl) guarded(&impl->error, [&] { return impl->start(); });
}

CaptureWriter::~CaptureWriter() = default;

bool CaptureWriter::add(const ViewImage& image) {
    return impl && guarded(&impl->error, [&] { return impl->add(image); });
}

bool CaptureWriter::finish(Layers layers, LayerMethod method) {
    return impl && guarded(&impl->error, [&] { return impl->finish(layers, method); });
}

const std::string& CaptureWriter::error() const {
    static const std::string no_memory = "out of memory";
    return impl ? impl->error : no_memory;
}

} // namespace glcast
