#include "tests/reconstruct/mesh_layers.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace glcast::test {
namespace {

struct Hit {
    double depth; ///< 0..1
    glm::vec3 normal, colour;
};
using Rays = std::vector<std::vector<Hit>>;

double side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

void cast_triangle(const Mesh& mesh, const Triangle& t, const Box& box, int n, Axis axis, Rays& rays) {
    const ImageAxes axes = image_axes(axis);
    glm::dvec2 p[3];
    double depth[3];
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 at = (mesh.positions[t[k]] - box.lo) / box.size;
        p[k] = glm::dvec2(at[axes.u], at[axes.v]) * double(n) - 0.5;
        depth[k] = at[axes.depth];
    }
    const double area = side_of(p[0], p[1], p[2]);
    if (std::abs(area) < 1e-14) return;
    const glm::dvec2 lo = glm::min(p[0], glm::min(p[1], p[2])), hi = glm::max(p[0], glm::max(p[1], p[2]));
    for (int v = std::max(0, int(std::ceil(lo.y))); v <= std::min(n - 1, int(std::floor(hi.y))); ++v)
        for (int u = std::max(0, int(std::ceil(lo.x))); u <= std::min(n - 1, int(std::floor(hi.x))); ++u) {
            const glm::dvec2 at(u, v);
            const double w[3] = {side_of(p[1], p[2], at) / area, side_of(p[2], p[0], at) / area,
                                 side_of(p[0], p[1], at) / area};
            if (w[0] < -1e-9 || w[1] < -1e-9 || w[2] < -1e-9) continue;
            Hit hit{0, glm::vec3(0), glm::vec3(0)};
            for (int k = 0; k < 3; ++k) {
                hit.depth += w[k] * depth[k];
                if (!mesh.normals.empty()) hit.normal += float(w[k]) * mesh.normals[t[k]];
                hit.colour += mesh.colours.empty() ? glm::vec3(1.0f / 6) : float(w[k]) * mesh.colours[t[k]];
            }
            rays[std::size_t(v) * n + u].push_back(hit);
        }
}

void put(ViewImage& image, std::size_t pixel, const Hit& hit) {
    image.depth[pixel] = float(hit.depth);
    image.colour[pixel] = glm::vec4(hit.colour, 1);
    if (hit.normal != glm::vec3(0)) image.normal[pixel] = glm::vec4(hit.normal, 1);
}

} // namespace

std::vector<ViewImage> cast_mesh(const Mesh& mesh, const Box& box, int n) {
    std::vector<ViewImage> images;
    for (int a = 0; a < 3; ++a) {
        Rays rays(std::size_t(n) * n);
        for (const Triangle& t : mesh.triangles) cast_triangle(mesh, t, box, n, Axis(a), rays);
        std::vector<ViewImage> layers{blank_image({Axis(a), Side::minus, 0}, n),
                                      blank_image({Axis(a), Side::plus, 0}, n)};
        for (std::size_t p = 0; p < rays.size(); ++p) {
            auto& ray = rays[p];
            std::sort(ray.begin(), ray.end(), [](auto& x, auto& y) { return x.depth < y.depth; });
            const double same = 1e-3 / n;
            ray.erase(std::unique(ray.begin(), ray.end(),
                                  [&](auto& x, auto& y) { return y.depth - x.depth < same; }),
                      ray.end());
            if (ray.empty()) continue;
            put(layers[0], p, ray.front());
            put(layers[1], p, ray.back());
            for (std::size_t k = 1; k + 1 < ray.size(); ++k) {
                while (layers.size() <= k + 1)
                    layers.push_back(blank_image({Axis(a), Side::minus, int(layers.size()) - 1}, n));
                put(layers[k + 1], p, ray[k]);
            }
        }
        for (ViewImage& image : layers) images.push_back(std::move(image));
    }
    return images;
}

Box box_around(const Mesh& mesh, int n) {
    glm::dvec3 lo(1e300), hi(-1e300);
    for (const glm::dvec3& p : mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    const glm::dvec3 size = hi - lo;
    Box box;
    box.size = std::max({size.x, size.y, size.z}) * n / (n - 4.0);
    box.lo = 0.5 * (lo + hi) - 0.5 * box.size;
    return box;
}

} // namespace glcast::test
