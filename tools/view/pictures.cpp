#include "tools/view/pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/picture/png.h"

namespace glcast::view {
namespace {

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
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            glm::vec4 sum(0);
            for (int k = 0; k < factor * factor; ++k)
                sum += shown(image, turned.pixel(x * factor + k % factor, y * factor + k / factor), what);
            const glm::vec3 colour = sum.a > 0 ? glm::vec3(sum) / sum.a : glm::vec3(0);
            const glm::vec4 mean(colour, sum.a / float(factor * factor));
            for (int k = 0; k < 4; ++k)
                rgba.push_back(std::uint8_t(std::lround(std::clamp(mean[k], 0.0f, 1.0f) * 255)));
        }
    return png_bytes(size, size, 4, rgba);
}

Bytes picture_png(const Picture& picture) {
    return png_bytes(picture);
}

} // namespace glcast::view
