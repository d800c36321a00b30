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
    info.eye = glm::dvec3(-0.5, -0.25, 10);
    info.seen_places = {glm::dvec3(1, 2, 3), glm::dvec3(0, -1e9, 0.125)};
    info.program = "sphere";
    info.frame = 7;
    info.renderer = "none (made by a test)";
    info.normals = "signed";
    info.glcast_version = GLCAST_VERSION;
    info.not_understood = {{"glFancy", 3}, {"glOther, with a comma", 12}};
    return info;
}

/// A sphere of that radius (of the box) in the box's centre, with colours that change from pixel to pixel as
/// textures do.
inline ViewImage sphere_view(int n, Axis axis, Side side, double radius = 0.4) {
    ViewImage image = blank_image({axis, side, 0}, n);
    const ImageAxes axes = image_axes(axis);
    const double sign = side == Side::minus ? -1 : 1;
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

/// The hits of a ray with three spheres one in the other, layer k of `minus`: 1 and 2 enter, 3 and 4 leave.
inline ViewImage inner_view(int n, Axis axis, int layer) {
    const bool enters = layer <= 2;
    ViewImage image =
        sphere_view(n, axis, enters ? Side::minus : Side::plus, layer == 1 || layer == 4 ? 0.3 : 0.2);
    const ViewImage outer = sphere_view(n, axis, Side::minus, 0.3),
                    inner = sphere_view(n, axis, Side::minus, 0.2);
    image.view = {axis, Side::minus, layer};
    for (std::size_t p = 0; p < image.depth.size(); ++p) {
        // Beside the innermost sphere the second inner hit is the way out of the middle one.
        if (layer == 2 && !inner.covered(p) && outer.covered(p)) {
            const ViewImage& way_out = outer;
            image.depth[p] = 1 - way_out.depth[p];
            image.colour[p] = way_out.colour[p];
            image.normal[p] = glm::vec4(0);
        }
        if (layer == 4 && !inner.covered(p)) image.colour[p] = glm::vec4(0);
        if (image.colour[p].a == 0) image.depth[p] = 1, image.colour[p] = image.normal[p] = glm::vec4(0);
    }
    return image;
}

/// Writes all six views and four layers of three nested spheres; the error as below.
inline std::string write_nested(const std::string& path, int n) {
    CaptureWriter writer(path, sphere_info(n), 6 + 3 * 31);
    for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
        for (Side side : {Side::minus, Side::plus})
            if (!writer.add(sphere_view(n, axis, side))) return writer.error();
        for (int layer = 1; layer <= 4; ++layer)
            if (!writer.add(inner_view(n, axis, layer))) return writer.error();
    }
    writer.finish(Layers::complete, LayerMethod::peel);
    return writer.error();
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
