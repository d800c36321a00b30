#include "shim/preload/feedback_probe.h"

#include <algorithm>
#include <cmath>

namespace glcast::preload {
namespace {

constexpr std::size_t room = 1 << 16;        // floats
constexpr std::ptrdiff_t vertex_floats = 12; // GL_4D_COLOR_TEXTURE with RGBA

FeedbackProbe::Vertex vertex_at(const GLfloat* v, const GLdouble range[2]) {
    const double size = range[1] - range[0];
    const double depth = size != 0 ? (2 * v[2] - range[0] - range[1]) / size : 0;
    return {v[0], v[1], depth * v[3], v[3], v[8], v[9]};
}

/// Twice the area of a polygon, positive where it turns counter-clockwise.
template <class X, class Y> double area(const FeedbackProbe::Polygon& polygon, const X& x, const Y& y) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += x(a) * y(b) - x(b) * y(a);
    }
    return sum;
}

} // namespace

void FeedbackProbe::begin() {
    values.assign(room, 0);
    gl.FeedbackBuffer(static_cast<GLsizei>(values.size()), GL_4D_COLOR_TEXTURE, values.data());
    gl.RenderMode(GL_FEEDBACK);
    open = true;
}

std::vector<FeedbackProbe::Polygon> FeedbackProbe::end() {
    GLdouble range[2] = {0, 1};
    gl.GetDoublev(GL_DEPTH_RANGE, range);
    const GLint used = gl.RenderMode(GL_RENDER);
    open = false;
    std::vector<Polygon> polygons;
    const GLfloat *at = values.data(), *stop = at + (used >= 0 ? std::size_t(used) : values.size());
    while (stop - at > 1) {
        const auto token = static_cast<GLenum>(*at++);
        std::ptrdiff_t vertices = 1;
        if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) vertices = 2;
        if (token == GL_POLYGON_TOKEN) vertices = static_cast<std::ptrdiff_t>(*at++);
        if (token == GL_PASS_THROUGH_TOKEN) {
            ++at;
            continue;
        }
        if (vertices <= 0 || stop - at < vertices * vertex_floats) break;
        if (token == GL_POLYGON_TOKEN) {
            Polygon& polygon = polygons.emplace_back();
            for (std::ptrdiff_t i = 0; i < vertices; ++i)
                polygon.push_back(vertex_at(at + i * vertex_floats, range));
        }
        at += vertices * vertex_floats;
    }
    return polygons;
}

bool shows_mirrored(const std::vector<FeedbackProbe::Polygon>& polygons) {
    double product = 0;
    for (const auto& polygon : polygons)
        product += area(
                       polygon, [](const auto& v) { return v.x; }, [](const auto& v) { return v.y; }) *
                   area(
                       polygon, [](const auto& v) { return v.s; }, [](const auto& v) { return v.t; });
    return product < 0;
}

} // namespace glcast::preload
