#include "tools/io/capture_reader.h"

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <utility>

#include "tools/io/capture_layout.h"

namespace glcast {
namespace {

constexpr std::size_t parts_in_memory = 2; // 36 bytes a pixel

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

template <class AttributeType> const auto& value(const Imf::Header& header, const char* name) {
    const auto* attribute = header.findTypedAttribute<AttributeType>(name);
    if (!attribute) refuse(std::string("the header is damaged: no ") + name);
    return attribute->value();
}

/// "12 glFancy" -> {"glFancy", 12}
std::map<std::string, long> read_counts(const std::vector<std::string>& lines) {
    std::map<std::string, long> counts;
    for (const std::string& line : lines) {
        const std::size_t space = line.find(' ');
        if (space == 0 || space > 18 || line.find_first_not_of("0123456789") != space)
            refuse("the header is damaged: glcast.notUnderstood");
        counts[line.substr(space + 1)] = std::stol(line.substr(0, space));
    }
    return counts;
}

template <class Kind>
Kind named(const std::string& name, const char* (*name_of)(Kind), const char* attribute) {
    for (int k = 0; k < 3; ++k)
        if (name == name_of(static_cast<Kind>(k))) return static_cast<Kind>(k);
    refuse(std::string("the header is damaged: ") + attribute);
}

/// Format 1 has no layers but the first.
void read_layers(const Imf::Header& header, CaptureInfo& info) {
    if (value<Imf::IntAttribute>(header, "glcast.format") < 2) return;
    info.layers = named(value<Imf::StringAttribute>(header, "glcast.layers"), layers_name, "glcast.layers");
    info.layer_method = named(value<Imf::StringAttribute>(header, "glcast.layerMethod"), layer_method_name,
                              "glcast.layerMethod");
    const Imath::V3i& count = value<Imf::V3iAttribute>(header, "glcast.layerCount");
    info.layer_count = {count.x, count.y, count.z};
    const bool looked = info.layer_method != LayerMethod::none;
    if (looked != (info.layers != Layers::outer)) refuse("the header is damaged: glcast.layers");
}

glm::dmat4 matrix(const Imath::M44d& rows) {
    glm::dmat4 m;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = rows[r][c];
    return m;
}

bool is_finite(const glm::dmat4& m) {
    for (int k = 0; k < 16; ++k)
        if (!std::isfinite(m[k / 4][k % 4])) return false;
    return true;
}

CaptureInfo read_info(const Imf::Header& header) {
    CaptureInfo info;
    info.n = value<Imf::IntAttribute>(header, "glcast.n");
    const Imath::V3d& lo = value<Imf::V3dAttribute>(header, "glcast.boxLo");
    info.box = {{lo.x, lo.y, lo.z}, value<Imf::DoubleAttribute>(header, "glcast.boxSize")};
    info.eye_to_capture = matrix(value<Imf::M44dAttribute>(header, "glcast.eyeToCapture"));
    bool finite = is_finite(info.eye_to_capture);
    if (header.findTypedAttribute<Imf::M44dAttribute>("glcast.fromCapture")) {
        info.from_capture = matrix(value<Imf::M44dAttribute>(header, "glcast.fromCapture"));
        finite &= is_finite(*info.from_capture);
    }
    for (int k = 0; k < 3; ++k) finite &= std::isfinite(info.box.lo[k]);
    if (!finite || !std::isfinite(info.box.size) || !(info.box.size > 0))
        refuse("the header is damaged: box or frame");
    info.program = value<Imf::StringAttribute>(header, "glcast.program");
    info.frame = value<Imf::IntAttribute>(header, "glcast.frame");
    info.renderer = value<Imf::StringAttribute>(header, "glcast.renderer");
    info.normals = value<Imf::StringAttribute>(header, "glcast.normals");
    info.glcast_version = value<Imf::StringAttribute>(header, "glcast.version");
    info.not_understood = read_counts(value<Imf::StringVectorAttribute>(header, "glcast.notUnderstood"));
    read_layers(header, info);
    return info;
}

View read_view(const Imf::Header& header) {
    const std::string& axis = value<Imf::StringAttribute>(header, "glcast.axis");
    const std::string& side = value<Imf::StringAttribute>(header, "glcast.side");
    const std::size_t index = axis.size() == 1 ? std::string("xyz").find(axis) : std::string::npos;
    if (index == std::string::npos || (side != "-" && side != "+")) refuse("the header is damaged: view");
    const View view{static_cast<Axis>(index), side == "-" ? Side::minus : Side::plus,
                    value<Imf::IntAttribute>(header, "glcast.layer")};
    if (view.layer < 0 || view.layer >= max_layers || header.name() != part_name(view))
        refuse("the header is damaged: view");
    return view;
}

struct ChannelTarget {
    const char* name;
    float* first;       ///< of the channel in the image
    std::size_t stride; ///< floats from pixel to pixel
};

void read_pixels(Imf::MultiPartInputFile& file, int part, ViewImage& image) {
    const std::size_t pixels = static_cast<std::size_t>(image.n) * image.n;
    image.depth.resize(pixels);
    image.colour.resize(pixels);
    image.normal.resize(pixels);
    float *colour = &image.colour[0].x, *normal = &image.normal[0].x;
    const ChannelTarget targets[] = {
        {"R", colour, 4},       {"G", colour + 1, 4},   {"B", colour + 2, 4},
        {"A", colour + 3, 4},   {"N.X", normal, 4},     {"N.Y", normal + 1, 4},
        {"N.Z", normal + 2, 4}, {"N.V", normal + 3, 4}, {"Z", image.depth.data(), 1}};
    Imf::InputPart input(file, part);
    Imf::FrameBuffer buffer;
    for (const ChannelTarget& target : targets) {
        const Imf::Channel* channel = input.header().channels().findChannel(target.name);
        if (!channel || channel->type == Imf::UINT || channel->xSampling != 1 || channel->ySampling != 1)
            refuse(std::string("the header is damaged: no channel ") + target.name);
        const std::size_t step = target.stride * sizeof(float);
        buffer.insert(target.name,
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(target.first), step, step * image.n));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(0, image.n - 1);
}

/// OpenEXR's line 0 is on top, ours at the bottom.
template <class T> void flip(std::vector<T>& pixels, int n) {
    for (int j = 0; j < n / 2; ++j)
        std::swap_ranges(pixels.begin() + long(j) * n, pixels.begin() + long(j + 1) * n,
                         pixels.begin() + long(n - 1 - j) * n);
}

/// The rules of docs/capture-format.md, and the counts of the header.
void check_pixels(const ViewImage& image, int covered, int with_normal) {
    const auto unit = [](float x) { return x >= 0 && x <= 1; }; // false for NaN
    const auto flag = [](float x) { return x == 0 || x == 1; };
    int covered_here = 0, with_normal_here = 0;
    for (std::size_t p = 0; p < image.depth.size(); ++p) {
        const glm::vec4 c = image.colour[p], n = image.normal[p];
        const bool ok = flag(c.a) && flag(n.w) && n.w <= c.a && unit(c.r) && unit(c.g) && unit(c.b) &&
                        unit(image.depth[p]) && std::isfinite(n.x) && std::isfinite(n.y) &&
                        std::isfinite(n.z) &&
                        (c.a == 1 || image.depth[p] == ViewImage::background(image.view.side));
        if (!ok) refuse("part " + part_name(image.view) + " holds values that no capture has");
        covered_here += c.a == 1;
        with_normal_here += n.w == 1;
    }
    if (covered_here != covered || with_normal_here != with_normal)
        refuse("part " + part_name(image.view) + " does not have the pixels that its header counts");
}

/// As the file has it; check_part() comes next.
ViewImage read_part(Imf::MultiPartInputFile& file, int part, const CaptureInfo& info) {
    const Imf::Header& header = file.header(part);
    const CaptureInfo same = read_info(header);
    if (same.n != info.n || same.box.lo != info.box.lo || same.box.size != info.box.size ||
        same.eye_to_capture != info.eye_to_capture || same.from_capture != info.from_capture || same.layers != info.layers ||
        same.layer_method != info.layer_method || same.layer_count != info.layer_count)
        refuse("its parts differ in box, frame or layers");
    ViewImage image;
    image.view = read_view(header);
    image.n = info.n;
    read_pixels(file, part, image);
    return image;
}

void check_part(const Imf::Header& header, ViewImage& image) {
    flip(image.depth, image.n);
    flip(image.colour, image.n);
    flip(image.normal, image.n);
    check_pixels(image, value<Imf::IntAttribute>(header, "glcast.covered"),
                 value<Imf::IntAttribute>(header, "glcast.withNormal"));
}

/// The part of each view: views[axis][0] is +a.0, views[axis][1 + k] is -a.k.
using PartIndex = std::array<std::vector<int>, 3>;

std::size_t slot_of(const View& view) { return view.side == Side::plus ? 0 : 1 + std::size_t(view.layer); }

PartIndex index_parts(Imf::MultiPartInputFile& file, const CaptureInfo& info) {
    PartIndex index;
    for (int axis = 0; axis < 3; ++axis) {
        const int count = info.layer_count[axis];
        if (count < 1 || count > max_layers) refuse("the header is damaged: glcast.layerCount");
        index[axis].assign(1 + std::size_t(count), -1);
    }
    for (int part = 0; part < file.parts(); ++part) {
        if (!file.partComplete(part)) refuse("the file is truncated");
        const View view = read_view(file.header(part));
        std::vector<int>& parts = index[static_cast<int>(view.axis)];
        const std::size_t slot = slot_of(view);
        if (slot >= parts.size() || (view.side == Side::plus && view.layer > 0))
            refuse("view " + part_name(view) + " is not among the layers of the header");
        if (parts[slot] >= 0) refuse("view " + part_name(view) + " is there twice");
        parts[slot] = part;
    }
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t slot = 0; slot < index[axis].size(); ++slot) {
            const View view = slot == 0 ? View{Axis(axis), Side::plus, 0}
                                        : View{Axis(axis), Side::minus, static_cast<int>(slot) - 1};
            if (index[axis][slot] < 0) refuse("view " + part_name(view) + " is missing");
        }
    return index;
}

/// Layers of a pixel come in growing depth, strictly between its first hit and its last, none left out.
class LayerOrder {
  public:
    explicit LayerOrder(bool has_layers) : has_layers(has_layers) {}

    void check(const ViewImage& image) {
        if (!has_layers) return;
        if (image.view.layer > 0) return follow(image);
        std::vector<float>& depth = image.view.side == Side::minus ? previous : last;
        depth = image.depth;
        for (std::size_t p = 0; p < depth.size(); ++p)
            if (!image.covered(p)) depth[p] = image.view.side == Side::minus ? none : -none;
    }

  private:
    static constexpr float none = 2;

    void follow(const ViewImage& image) {
        for (std::size_t p = 0; p < previous.size(); ++p) {
            if (!image.covered(p))
                previous[p] = none;
            else if (image.depth[p] > previous[p] && image.depth[p] < last[p])
                previous[p] = image.depth[p];
            else
                refuse("part " + part_name(image.view) + " does not lie between the layers around it");
        }
    }

    bool has_layers;
    std::vector<float> previous, last;
};

/// OpenEXR's own, of which there are none unless somebody asks.
int unpacking_threads() {
    const int threads = tbb::this_task_arena::max_concurrency();
    if (threads < 2) return 0;
    if (Imf::globalThreadCount() < threads) Imf::setGlobalThreadCount(threads);
    return threads;
}

struct OpenCapture {
    CaptureLayout layout; ///< checked first, before OpenEXR sees the file
    Imf::MultiPartInputFile file;
    CaptureInfo info;
    PartIndex parts;

    explicit OpenCapture(const std::filesystem::path& path)
        : layout(check_capture_layout(path)),
          file(path.c_str(), unpacking_threads(), false), // no guessing of lost chunk tables
          info(read_info(file.header(0))), parts(index_parts(file, info)) {}
};

/// A part on its way from the file to who wants it.
struct Moving {
    int part;
    bool first_of_axis, has_layers;
    ViewImage image;
};

std::vector<Moving> in_order(const PartIndex& index) {
    std::vector<Moving> all;
    for (const std::vector<int>& parts : index)
        for (std::size_t k = 0; k < parts.size(); ++k)
            all.push_back({parts[k < 2 ? 1 - k : k], k == 0, parts.size() > 2, {}}); // -a.0 before +a.0
    return all;
}

/// One part is unpacked while those before it are checked and handed on.
void read_parts(OpenCapture& capture, const PartSink& sink) {
    std::vector<Moving> parts = in_order(capture.parts);
    LayerOrder order(false);
    std::size_t next = 0;
    tbb::parallel_pipeline(
        parts_in_memory,
        tbb::make_filter<void, Moving*>(tbb::filter_mode::serial_in_order,
                                        [&](tbb::flow_control& control) -> Moving* {
                                            if (next == parts.size()) {
                                                control.stop();
                                                return nullptr;
                                            }
                                            Moving& at = parts[next++];
                                            at.image = read_part(capture.file, at.part, capture.info);
                                            return &at;
                                        }) &
            tbb::make_filter<Moving*, Moving*>(tbb::filter_mode::parallel,
                                               [&](Moving* at) {
                                                   check_part(capture.file.header(at->part), at->image);
                                                   return at;
                                               }) &
            tbb::make_filter<Moving*, void>(tbb::filter_mode::serial_in_order, [&](Moving* at) {
                if (at->first_of_axis) order = LayerOrder(at->has_layers);
                order.check(at->image);
                sink(std::exchange(at->image, {}));
            }));
}

/// What a library says, on one line.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

template <class Read> auto with_file_name(const std::filesystem::path& path, Read&& read) {
    try {
        return read();
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot read capture '" + path.string() + "': " + one_line(e.what()));
    }
}

} // namespace

CaptureInfo read_capture_info(const std::filesystem::path& path) {
    return with_file_name(path, [&] { return OpenCapture(path).info; });
}

CaptureInfo read_capture(const std::filesystem::path& path, const PartSink& sink) {
    return with_file_name(path, [&] {
        OpenCapture capture(path);
        read_parts(capture, sink);
        return capture.info;
    });
}

Capture read_capture(const std::filesystem::path& path) {
    return with_file_name(path, [&] {
        OpenCapture file(path);
        Capture capture;
        capture.info = file.info;
        capture.file_bytes = file.layout.file_bytes;
        read_parts(file, [&](ViewImage&& image) { capture.images.push_back(std::move(image)); });
        return capture;
    });
}

bool looks_like_exr(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const char magic[] = {0x76, 0x2f, 0x31, 0x01};
    char start[4] = {};
    return file.read(start, 4) && std::equal(start, start + 4, magic);
}

} // namespace glcast
