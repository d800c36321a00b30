#include "tools/view/pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <zlib.h>

namespace glcast::view {
namespace {

void add_word(Bytes& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(char(value >> shift));
}

void add_chunk(Bytes& png, const char* name, const Bytes& data) {
    add_word(png, std::uint32_t(data.size()));
    const Bytes body = name + data;
    png += body;
    add_word(png, std::uint32_t(crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()))));
}

/// PNG (ISO 15948), RGB or RGBA of 8 bits, each row as differences to the one above.
Bytes png(int columns, int row_count, int channels, const char* pixels) {
    Bytes head;
    add_word(head, std::uint32_t(columns));
    add_word(head, std::uint32_t(row_count));
    head += Bytes(channels == 4 ? "\x08\x06\0\0\0" : "\x08\x02\0\0\0", 5);
    const std::size_t width = std::size_t(columns) * std::size_t(channels);
    Bytes rows;
    rows.reserve((width + 1) * std::size_t(row_count));
    for (std::size_t y = 0; y < std::size_t(row_count); ++y) {
        rows.push_back(2);
        for (std::size_t x = 0; x < width; ++x)
            rows.push_back(char(pixels[y * width + x] - (y ? pixels[(y - 1) * width + x] : 0)));
    }
    Bytes out("\x89PNG\r\n\x1a\n", 8);
    add_chunk(out, "IHDR", head);
    add_chunk(out, "IDAT", deflated(rows));
    add_chunk(out, "IEND", "");
    return out;
}

/// What to show of a pixel, alpha 1 where there is something.
glm::vec4 shown(const ViewImage& image, std::size_t pixel, What what) {
    if (!image.covered(pixel)) return glm::vec4(0);
    if (what == What::colour) return {glm::vec3(image.colour[pixel]), 1};
    const glm::vec3 normal(image.normal[pixel]);
    const float length = glm::length(normal);
    if (image.normal[pixel].w == 0 || !(length > 0)) return {0.5f, 0.5f, 0.5f, 1};
    return {normal / length * 0.5f + 0.5f, 1};
}

/// Column or row of the image for place `at` of `n` along a direction that lies along its axis.
int along(int sign, int at, int n) { return sign > 0 ? at : n - 1 - at; }

/// Where pixel (x, y) of the picture, row 0 on top, lies in the image.
struct Turned {
    ImageAxes axes;
    glm::ivec3 right, down;
    int n;

    std::size_t pixel(int x, int y) const {
        const int i = right[axes.u] ? along(right[axes.u], x, n) : along(down[axes.u], y, n);
        const int j = right[axes.v] ? along(right[axes.v], x, n) : along(down[axes.v], y, n);
        return std::size_t(j) * n + i;
    }
};

} // namespace

Stance stance(const View& view) {
    Stance s;
    s.back[int(view.axis)] = view.side == Side::plus ? 1 : -1;
    s.up = view.axis == Axis::y ? glm::ivec3(0, 0, -s.back.y) : glm::ivec3(0, 1, 0);
    const glm::dvec3 right = glm::cross(glm::dvec3(s.up), glm::dvec3(s.back));
    s.right = glm::ivec3(right);
    return s;
}

Bytes view_png(const ViewImage& image, What what, int most_pixels) {
    const Stance s = stance(image.view);
    const Turned turned{image_axes(image.view.axis), s.right, -s.up, image.n};
    const int factor = (image.n + most_pixels - 1) / most_pixels, size = image.n / factor;
    Bytes rgba;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            glm::vec4 sum(0);
            for (int k = 0; k < factor * factor; ++k)
                sum += shown(image, turned.pixel(x * factor + k % factor, y * factor + k / factor), what);
            const glm::vec3 colour = sum.a > 0 ? glm::vec3(sum) / sum.a : glm::vec3(0);
            const glm::vec4 mean(colour, sum.a / float(factor * factor));
            for (int k = 0; k < 4; ++k)
                rgba.push_back(char(std::lround(std::clamp(mean[k], 0.0f, 1.0f) * 255)));
        }
    return png(size, size, 4, rgba.data());
}

Bytes picture_png(const Picture& picture) {
    return png(picture.width, picture.height, 3, reinterpret_cast<const char*>(picture.rgb.data()));
}

} // namespace glcast::view
