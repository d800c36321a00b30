// What the engine would see of a sphere, made without drawing: for tests of the capture file.
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "capture/capture_file.h"

namespace glcast::samples {

inline CaptureInfo sphere_info(int n) {
    CaptureInfo info;
    info.n = n;
    info.box = {glm::dvec3(-1.5, -0.5, 2), 3.0};
    info.eye_to_capture = glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0.25, -10, 1);
    info.program = "sphere";
    info.frame = 7;
    info.renderer = "none (made by a test)";
    info.normals = "signed";
    info.glcast_version = GLCAST_VERSION;
    info.not_understood = {{"glFancy", 3}, {"glOther, with a comma", 12}};
    return info;
}

/// A sphere of radius 0.4 of the box in its centre, with colours that change from pixel to pixel as textures
/// do.
inline ViewImage sphere_view(int n, Axis axis, Side side) {
    ViewImage image;
    image.view = {axis, side, 0};
    image.n = n;
    const std::size_t pixels = static_cast<std::size_t>(n) * n;
    image.depth.assign(pixels, ViewImage::background(side));
    image.colour.assign(pixels, glm::vec4(0));
    image.normal.assign(pixels, glm::vec4(0));
    const ImageAxes axes = image_axes(axis);
    const double sign = side == Side::minus ? -1 : 1, radius = 0.4;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double u = (i + 0.5) / n - 0.5, v = (j + 0.5) / n - 0.5,
                         rest = radius * radius - u * u - v * v;
            if (rest <= 0) continue;
            const std::size_t p = static_cast<std::size_t>(j) * n + i;
            const double w = sign * std::sqrt(rest);
            image.depth[p] = static_cast<float>(0.5 + w);
            image.colour[p] = {float(i % 256) / 255, float(j % 256) / 255,
                               0.5f + 0.25f * std::sin(40.0f * float(u * v)), 1};
            glm::vec4 normal(0, 0, 0, 1);
            normal[axes.u] = static_cast<float>(u / radius);
            normal[axes.v] = static_cast<float>(v / radius);
            normal[axes.depth] = static_cast<float>(w / radius);
            image.normal[p] = normal;
        }
    return image;
}

inline const std::vector<View>& six_views() {
    static const std::vector<View> views = {{Axis::x, Side::minus}, {Axis::x, Side::plus},
                                            {Axis::y, Side::minus}, {Axis::y, Side::plus},
                                            {Axis::z, Side::minus}, {Axis::z, Side::plus}};
    return views;
}

/// Writes all six views; the writer's error, empty when all went well.
inline std::string write_sphere(const std::string& path, int n) {
    CaptureWriter writer(path, sphere_info(n), 6);
    for (const View& view : six_views())
        if (!writer.add(sphere_view(n, view.axis, view.side))) return writer.error();
    writer.finish();
    return writer.error();
}

} // namespace glcast::samples
