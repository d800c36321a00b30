#include "tools/render/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace glcast {
namespace {

float light_on(const glm::vec3& normal, const OrthoView& view) {
    if (normal == glm::vec3(0)) return 1;
    const glm::dvec3 n(normal);
    const glm::vec3 eye(dot(n, view.right), dot(n, view.up), dot(n, view.back));
    return ambient_light + diffuse_light * std::max(0.0f, glm::dot(eye, glm::normalize(towards_light)));
}

/// Pixel of the image along one of its axes; -1 outside.
int along(const Box& box, int n, int axis, const glm::dvec3& p) {
    const double at = std::floor((p[axis] - box.lo[axis]) / box.size * n);
    return at >= 0 && at < n ? int(at) : -1;
}

} // namespace

OrthoView square_view(const glm::dvec3& direction, const glm::dvec3& centre, double half, int pixels) {
    OrthoView view;
    const glm::dvec3 way = glm::normalize(direction);
    const glm::dvec3 up =
        std::abs(way.y) > 0.999 ? glm::dvec3(0, 0, way.y < 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
    view.back = -way;
    view.right = glm::normalize(glm::cross(way, up));
    view.up = glm::cross(view.right, way);
    view.centre = centre;
    view.pixel = 2 * half / pixels;
    view.width = view.height = pixels;
    return view;
}

std::vector<std::uint8_t> lit_rgba(const SeenImage& seen, const OrthoView& view) {
    std::vector<std::uint8_t> rgba(seen.covered.size() * 4, std::uint8_t(std::lround(tile_grey * 255)));
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const std::size_t from = std::size_t(y) * std::size_t(seen.width) + std::size_t(x),
                              to =
                                  std::size_t(seen.height - 1 - y) * std::size_t(seen.width) + std::size_t(x);
            if (!seen.covered[from]) continue;
            const float light = light_on(seen.normal[from], view);
            for (int k = 0; k < 3; ++k)
                rgba[to * 4 + std::size_t(k)] =
                    std::uint8_t(std::lround(std::clamp(seen.colour[from][k] * light, 0.0f, 1.0f) * 255));
        }
    return rgba;
}

SeenImage resampled(const ViewImage& image, const Box& box, const OrthoView& view) {
    const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
    SeenImage seen{view.width, view.height, std::vector<char>(count), std::vector<glm::vec3>(count),
                   std::vector<glm::vec3>(count)};
    const ImageAxes axes = image_axes(image.view.axis);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 p = view.centre + view.right * ((x + 0.5 - 0.5 * view.width) * view.pixel) +
                                 view.up * ((0.5 * view.height - y - 0.5) * view.pixel);
            const int i = along(box, image.n, axes.u, p), j = along(box, image.n, axes.v, p);
            if (i < 0 || j < 0) continue;
            const std::size_t from = std::size_t(j) * std::size_t(image.n) + std::size_t(i),
                              to = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
            if (!image.covered(from)) continue;
            seen.covered[to] = 1;
            seen.colour[to] = glm::vec3(image.colour[from]);
            const glm::vec3 normal(image.normal[from]);
            if (image.normal[from].w > 0 && glm::length(normal) > 0) seen.normal[to] = glm::normalize(normal);
        }
    return seen;
}

} // namespace glcast
