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
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "tools/io/capture_layout.h"

namespace glcast {
namespace {

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

CaptureInfo read_info(const Imf::Header& header) {
    CaptureInfo info;
    info.n = value<Imf::IntAttribute>(header, "glcast.n");
    const Imath::V3d& lo = value<Imf::V3dAttribute>(header, "glcast.boxLo");
    info.box = {{lo.x, lo.y, lo.z}, value<Imf::DoubleAttribute>(header, "glcast.boxSize")};
    const Imath::M44d& rows = value<Imf::M44dAttribute>(header, "glcast.eyeToCapture");
    bool finite = true;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) {
            info.eye_to_capture[c][r] = rows[r][c];
            finite &= std::isfinite(rows[r][c]);
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
    return info;
}

View read_view(const Imf::Header& header) {
    const std::string& axis = value<Imf::StringAttribute>(header, "glcast.axis");
    const std::string& side = value<Imf::StringAttribute>(header, "glcast.side");
    const std::size_t index = axis.size() == 1 ? std::string("xyz").find(axis) : std::string::npos;
    if (index == std::string::npos || (side != "-" && side != "+")) refuse("the header is damaged: view");
    const View view{static_cast<Axis>(index), side == "-" ? Side::minus : Side::plus,
                    value<Imf::IntAttribute>(header, "glcast.layer")};
    if (view.layer < 0 || header.name() != part_name(view)) refuse("the header is damaged: view");
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

ViewImage read_part(Imf::MultiPartInputFile& file, int part, const CaptureInfo& info) {
    const Imf::Header& header = file.header(part);
    const CaptureInfo same = read_info(header);
    if (same.n != info.n || same.box.lo != info.box.lo || same.box.size != info.box.size ||
        same.eye_to_capture != info.eye_to_capture)
        refuse("its parts differ in box or frame");
    ViewImage image;
    image.view = read_view(header);
    image.n = info.n;
    read_pixels(file, part, image);
    flip(image.depth, image.n);
    flip(image.colour, image.n);
    flip(image.normal, image.n);
    check_pixels(image, value<Imf::IntAttribute>(header, "glcast.covered"),
                 value<Imf::IntAttribute>(header, "glcast.withNormal"));
    return image;
}

void check_views(const std::vector<ViewImage>& images) {
    for (Axis axis : {Axis::x, Axis::y, Axis::z})
        for (Side side : {Side::minus, Side::plus}) {
            const View wanted{axis, side, 0};
            const auto is = [&](const ViewImage& image) { return image.view == wanted; };
            if (std::none_of(images.begin(), images.end(), is))
                refuse("view " + part_name(wanted) + " is missing");
        }
}

Capture read(const std::filesystem::path& path) {
    const CaptureLayout layout = check_capture_layout(path);
    Imf::MultiPartInputFile file(path.c_str(), 0, false); // no threads, and no guessing of lost chunk tables
    Capture capture;
    capture.file_bytes = layout.file_bytes;
    capture.info = read_info(file.header(0));
    for (int part = 0; part < file.parts(); ++part) {
        if (!file.partComplete(part)) refuse("the file is truncated");
        capture.images.push_back(read_part(file, part, capture.info));
        for (std::size_t other = 0; other + 1 < capture.images.size(); ++other)
            if (capture.images[other].view == capture.images.back().view)
                refuse("view " + part_name(capture.images[other].view) + " is there twice");
    }
    check_views(capture.images);
    return capture;
}

/// What a library says, on one line.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

} // namespace

Capture read_capture(const std::filesystem::path& path) {
    try {
        return read(path);
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot read capture '" + path.string() + "': " + one_line(e.what()));
    }
}

bool looks_like_exr(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const char magic[] = {0x76, 0x2f, 0x31, 0x01};
    char start[4] = {};
    return file.read(start, 4) && std::equal(start, start + 4, magic);
}

} // namespace glcast
