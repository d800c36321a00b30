#include "tests/capture/scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glcast::test {

void draw_sphere(const GlTable& gl, glm::dvec3 centre, double radius, int parallels) {
    const auto vertex = [&](int i, int j) {
        const double theta = std::numbers::pi * i / parallels, phi = std::numbers::pi * j / parallels;
        const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        const glm::dvec3 p = centre + radius * n;
        gl.Normal3d(n.x, n.y, n.z);
        gl.Vertex3d(p.x, p.y, p.z);
    };
    for (int i = 0; i < parallels; ++i) {
        gl.Begin(GL_QUAD_STRIP);
        for (int j = 0; j <= 2 * parallels; ++j) vertex(i, j), vertex(i + 1, j);
        gl.End();
    }
}

void draw_box(const GlTable& gl, glm::dvec3 lo, glm::dvec3 hi, const std::vector<glm::vec3>& colours) {
    gl.Begin(GL_QUADS);
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
        const bool far = face % 2;
        glm::dvec3 normal(0);
        normal[axis] = far ? 1 : -1;
        gl.Normal3d(normal.x, normal.y, normal.z);
        if (!colours.empty()) {
            const glm::vec3 c = colours[face % colours.size()];
            gl.Color3f(c.r, c.g, c.b);
        }
        for (int corner = 0; corner < 4; ++corner) { // counter-clockwise from outside
            const int turn = far ? corner : 3 - corner;
            glm::dvec3 p;
            p[axis] = far ? hi[axis] : lo[axis];
            p[a] = turn == 1 || turn == 2 ? hi[a] : lo[a];
            p[b] = turn >= 2 ? hi[b] : lo[b];
            gl.TexCoord2d((p[a] - lo[a]) / (hi[a] - lo[a]), (p[b] - lo[b]) / (hi[b] - lo[b]));
            gl.Vertex3d(p.x, p.y, p.z);
        }
    }
    gl.End();
}

void draw_box(const GlTable& gl, glm::dvec3 lo, glm::dvec3 hi) { draw_box(gl, lo, hi, {}); }

void set_lit(const GlTable& gl) {
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_LIGHTING);
    gl.Enable(GL_LIGHT0);
    gl.Enable(GL_NORMALIZE);
}

void set_diffuse(const GlTable& gl, glm::vec3 colour, GLenum name, GLenum face) {
    const GLfloat values[] = {colour.r, colour.g, colour.b, 1};
    gl.Materialfv(face, name, values);
}

const ViewImage& Cast::view(Axis axis, Side side) const { return *find({axis, side, 0}); }

const ViewImage* Cast::find(const View& view) const {
    for (const ViewImage& image : images)
        if (image.view == view) return &image;
    return nullptr;
}

Cast capture(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options) {
    Cast cast;
    cast.report = run_capture(gl, draw, options, [&](ViewImage&& image) {
        cast.images.push_back(std::move(image));
        return true;
    });
    return cast;
}

EngineOptions small_options(int n) {
    EngineOptions options;
    options.n = n;
    options.most_layers = 1;
    return options;
}

std::size_t pixel_of(const Box& box, int n, Axis axis, glm::dvec3 point) {
    const ImageAxes axes = image_axes(axis);
    const glm::dvec3 at = (point - box.lo) / box.size * double(n);
    const auto index = [n](double x) { return std::size_t(std::clamp(int(std::floor(x)), 0, n - 1)); };
    return index(at[axes.v]) * n + index(at[axes.u]);
}

double angle_between(glm::dvec3 a, glm::dvec3 b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

Difference difference(const Cast& a, const Cast& b) {
    Difference d;
    if (a.images.size() != b.images.size()) d.coverage = -1;
    for (std::size_t k = 0; k < std::min(a.images.size(), b.images.size()); ++k) {
        const ViewImage &x = a.images[k], &y = b.images[k];
        for (std::size_t i = 0; i < x.depth.size(); ++i) {
            d.coverage += x.covered(i) != y.covered(i) || x.normal[i].w != y.normal[i].w;
            d.depth = std::max(d.depth, double(std::abs(x.depth[i] - y.depth[i])));
            d.colour = std::max(d.colour, double(glm::distance(x.colour[i], y.colour[i])));
            d.normal = std::max(d.normal, double(glm::distance(x.normal[i], y.normal[i])));
        }
    }
    return d;
}

} // namespace glcast::test
