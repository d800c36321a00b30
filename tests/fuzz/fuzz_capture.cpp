// Captures. What is accepted is given to OpenEXR too, which must see the same header and the same pixels:
// then nobody can be shown another picture than we saw.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <stdexcept>
#include <zlib.h>

#include "tests/file/exr_edit.h"
#include "tests/fuzz/input.h"
#include "tools/io/capture_reader.h"

using namespace glcast;
using samples::RawAttribute;
using samples::RawCapture;

namespace {

void require(bool same) {
    if (!same) std::abort();
}

/// A channel as OpenEXR reads it, top line first.
std::vector<float> read_channel(Imf::InputPart& part, const char* name, int n) {
    std::vector<float> pixels(std::size_t(n) * std::size_t(n));
    Imf::FrameBuffer buffer;
    buffer.insert(name,
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), 4, 4 * std::size_t(n)));
    part.setFrameBuffer(buffer);
    part.readPixels(0, n - 1);
    return pixels;
}

void compare_channel(Imf::InputPart& part, const char* name, const ViewImage& image, auto&& value) {
    const std::vector<float> theirs = read_channel(part, name, image.n);
    const std::size_t n = std::size_t(image.n);
    for (std::size_t p = 0; p < theirs.size(); ++p) {
        const std::size_t row = n - 1 - p / n; // line 0 is on top
        require(std::bit_cast<std::uint32_t>(theirs[p]) ==
                std::bit_cast<std::uint32_t>(float(value(image, row * n + p % n))));
    }
}

void compare_with_openexr(const std::string& path, const Capture& capture) {
    try {
        Imf::MultiPartInputFile file(path.c_str(), 0, false);
        require(file.parts() == int(capture.images.size()));
        for (const ViewImage& image : capture.images) {
            int part = 0;
            while (part < file.parts() && file.header(part).name() != part_name(image.view)) ++part;
            require(part < file.parts());
            const Imath::Box2i window = file.header(part).dataWindow();
            require(window == Imath::Box2i({0, 0}, {image.n - 1, image.n - 1}));
            require(file.header(part).displayWindow() == window);
            Imf::InputPart input(file, part);
            compare_channel(input, "Z", image, [](const auto& i, std::size_t p) { return i.depth[p]; });
            compare_channel(input, "A", image, [](const auto& i, std::size_t p) { return i.colour[p].a; });
            compare_channel(input, "R", image, [](const auto& i, std::size_t p) { return i.colour[p].r; });
            compare_channel(input, "N.X", image, [](const auto& i, std::size_t p) { return i.normal[p].x; });
            compare_channel(input, "N.V", image, [](const auto& i, std::size_t p) { return i.normal[p].w; });
        }
    } catch (const std::exception&) {
        // It may refuse what we accept (a pixel aspect of 0): nobody is shown anything then.
    }
}

void change_attribute(RawCapture& capture, fuzz::Dice& dice) {
    auto& part = capture.parts[dice() % capture.parts.size()];
    if (part.empty()) return;
    const std::size_t k = dice() % part.size();
    RawAttribute& attribute = part[k];
    static const char* types[] = {"int",      "float",       "double",       "v2f",       "v3i",
                                  "v3d",      "m44d",        "box2i",        "string",    "preview",
                                  "tiledesc", "chlist",      "stringvector", "zz",        "chromaticities",
                                  "timecode", "floatvector", "compression",  "lineOrder", "idmanifest"};
    static const char* names[] = {"tiles",      "preview", "dataWindow", "type",
                                  "chunkCount", "version", "zz",         "view"};
    switch (dice() % 9) {
    case 0:
        attribute.stated = dice() % 2 ? dice() : std::uint32_t(attribute.value.size() + dice() % 9 - 4);
        break;
    case 1:
        fuzz::mutate(attribute.value, attribute.value.size() + 64);
        attribute.stated = std::uint32_t(attribute.value.size());
        break;
    case 2:
        fuzz::mutate(attribute.value, attribute.value.size());
        break;
    case 3:
        attribute.type = types[dice() % std::size(types)];
        break;
    case 4:
        attribute.name = names[dice() % std::size(names)];
        break;
    case 5:
        part.push_back(RawAttribute(attribute));
        break;
    case 6:
        part.erase(part.begin() + long(k));
        break;
    case 7:
        std::swap(attribute, part[dice() % part.size()]);
        break;
    default: { // the same change in all parts
        fuzz::mutate(attribute.value, attribute.value.size());
        const RawAttribute changed = attribute;
        for (auto& other : capture.parts)
            for (RawAttribute& a : other)
                if (a.name == changed.name) a.value = changed.value, a.stated = std::uint32_t(a.value.size());
    }
    }
}

/// The pixels behind the compression change, so that damage comes past zlib's own checksum.
void change_chunk(RawCapture& capture, fuzz::Dice& dice) {
    const std::size_t k = dice() % capture.offsets.size();
    const std::string packed = capture.chunk(k);
    std::string bytes(1 << 16, 0);
    uLongf size = bytes.size();
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                   reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK) {
        std::string raw = packed;
        fuzz::mutate(raw, raw.size() + 16);
        return capture.replace_chunk(k, raw);
    }
    bytes.resize(size);
    fuzz::mutate(bytes, bytes.size() + dice() % 2);
    std::string again(compressBound(bytes.size()), 0);
    uLongf made = again.size();
    compress2(reinterpret_cast<Bytef*>(again.data()), &made, reinterpret_cast<const Bytef*>(bytes.data()),
              bytes.size(), 1);
    again.resize(made);
    capture.replace_chunk(k, again);
    if (capture.chunks.size() > (1u << 17)) capture.chunks.resize(1u << 17);
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    fuzz::Dice dice(seed);
    if (dice() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
    try {
        RawCapture capture(std::string(reinterpret_cast<const char*>(data), size));
        if (capture.parts.empty() || capture.offsets.empty()) return LLVMFuzzerMutate(data, size, max_size);
        for (unsigned changes = 1 + dice() % 3; changes > 0; --changes)
            dice() % 3 ? change_attribute(capture, dice) : change_chunk(capture, dice);
        return fuzz::give(capture.bytes(), data, size, max_size);
    } catch (const std::exception&) {
        return LLVMFuzzerMutate(data, size, max_size);
    }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static fuzz::InputAsFile file(".exr");
    fuzz::on_one_thread();
    const std::string& path = file.put(data, size);
    Capture capture;
    try {
        capture = read_capture(path);
    } catch (const std::runtime_error& e) {
        require(std::string_view(e.what()).find('\n') == std::string_view::npos);
        return 0;
    }
    compare_with_openexr(path, capture);
    return 0;
}
