#include "tools/io/capture_pixels.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <tbb/parallel_for.h>

#include "tools/io/exr_decompress.h"

namespace glcast {
namespace {

/// Where a channel goes: its first float in the image, and floats from pixel to pixel.
struct ChannelTarget {
    float* first;
    std::size_t stride;
};

/// In the order of PartHeader::half.
std::vector<ChannelTarget> targets_in(ViewImage& image) {
    std::vector<ChannelTarget> targets;
    targets.push_back({&image.colour[0].w, 4}); // A
    const auto add = [&](std::vector<glm::vec4>& colours, std::vector<glm::vec4>& normals) {
        float *colour = &colours[0].x, *normal = &normals[0].x;
        targets.push_back({colour + 2, 4}); // B
        targets.push_back({colour + 1, 4}); // G
        targets.push_back({normal + 3, 4}); // N.V
        targets.push_back({normal, 4});     // N.X
        targets.push_back({normal + 1, 4}); // N.Y
        targets.push_back({normal + 2, 4}); // N.Z
        targets.push_back({colour, 4});     // R
    };
    add(image.colour, image.normal);
    if (!image.other_colour.empty()) add(image.other_colour, image.other_normal);
    targets.push_back({image.depth.data(), 1});
    return targets;
}

void put_halves(const char* from, int count, float* to, std::size_t stride) {
    for (int i = 0; i < count; ++i, to += stride) {
        std::uint16_t bits;
        std::memcpy(&bits, from + 2 * i, sizeof bits);
        *to = imath_half_to_float(bits);
    }
}

void put_floats(const char* from, int count, float* to, std::size_t stride) {
    for (int i = 0; i < count; ++i, to += stride) std::memcpy(to, from + 4 * i, sizeof *to);
}

std::size_t bytes_per_line(const PartHeader& part, int n) {
    std::size_t bytes = 0;
    for (bool half : part.half) bytes += std::size_t(n) * (half ? 2 : 4);
    return bytes;
}

/// OpenEXR's line 0 is on top, our row 0 at the bottom.
void read_chunk(const InputFile& file, const PartHeader& part, const ChunkPlace& chunk, int first_line,
                int lines, int n, const std::vector<ChannelTarget>& targets) {
    const std::vector<char> packed = file.read(chunk.at, chunk.bytes);
    const std::vector<char> bytes =
        exr::decompress(packed, part.compression, bytes_per_line(part, n) * std::size_t(lines));
    const char* from = bytes.data();
    for (int line = first_line; line < first_line + lines; ++line)
        for (std::size_t c = 0; c < targets.size(); ++c) {
            const ChannelTarget& target = targets[c];
            float* to = target.first + std::size_t(n - 1 - line) * std::size_t(n) * target.stride;
            (part.half[c] ? put_halves : put_floats)(from, n, to, target.stride);
            from += n * (part.half[c] ? 2 : 4);
        }
}

/// The other side is covered where the one is. The same rules hold.
void check_other_side(ViewImage& image) {
    const auto unit = [](float x) { return x >= 0 && x <= 1; };
    for (std::size_t p = 0; p < image.other_colour.size(); ++p) {
        glm::vec4& c = image.other_colour[p];
        const glm::vec4 n = image.other_normal[p];
        c.a = image.colour[p].a;
        const bool ok = (n.w == 0 || n.w == 1) && n.w <= c.a && unit(c.r) && unit(c.g) && unit(c.b) &&
                        std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z);
        if (!ok)
            throw std::runtime_error("part " + part_name(image.view) + " holds values that no capture has");
    }
}

/// The rules of docs/reference/capture-format.md, and the counts of the header.
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
        if (!ok)
            throw std::runtime_error("part " + part_name(image.view) + " holds values that no capture has");
        covered_here += c.a == 1;
        with_normal_here += n.w == 1;
    }
    if (covered_here != covered || with_normal_here != with_normal)
        throw std::runtime_error("part " + part_name(image.view) +
                                 " does not have the pixels that its header counts");
}

} // namespace

ViewImage read_part(const InputFile& file, int n, const PartHeader& part,
                    const std::vector<ChunkPlace>& chunks) {
    ViewImage image;
    image.view = part.view;
    image.n = n;
    const std::size_t pixels = std::size_t(n) * std::size_t(n);
    image.depth.resize(pixels);
    image.colour.resize(pixels);
    image.normal.resize(pixels);
    if (part.half.size() == both_channel_count)
        image.other_colour.resize(pixels), image.other_normal.resize(pixels);
    const auto targets = targets_in(image);
    const int lines = exr::lines_per_chunk(part.compression);
    tbb::parallel_for(std::size_t(0), chunks.size(), [&](std::size_t c) {
        const int first = int(c) * lines;
        read_chunk(file, part, chunks[c], first, std::min(lines, n - first), n, targets);
    });
    check_pixels(image, part.covered, part.with_normal);
    check_other_side(image);
    return image;
}

} // namespace glcast
