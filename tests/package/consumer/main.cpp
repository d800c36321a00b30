// Six images of a ball, made without GL, to a closed mesh of the right volume and colour.
#include <cmath>
#include <cstdio>
#include <glcast/check.h>
#include <glcast/reconstruct.h>

namespace {

constexpr int n = 48;
constexpr float radius = 0.4f; // of the box

glcast::ViewImage ball(glcast::Axis axis, glcast::Side side) {
    glcast::ViewImage image;
    image.view = {axis, side, 0};
    image.n = n;
    image.depth.assign(n * n, glcast::ViewImage::background(side));
    image.colour.assign(n * n, glm::vec4(0));
    image.normal.assign(n * n, glm::vec4(0));
    const glcast::ImageAxes axes = glcast::image_axes(axis);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const float u = (i + 0.5f) / n - 0.5f, v = (j + 0.5f) / n - 0.5f;
            const float rest = radius * radius - u * u - v * v;
            if (rest <= 0) continue;
            const float w = (side == glcast::Side::minus ? -1 : 1) * std::sqrt(rest);
            glm::vec4 normal(0, 0, 0, 1);
            normal[axes.u] = u / radius, normal[axes.v] = v / radius, normal[axes.depth] = w / radius;
            image.depth[j * n + i] = 0.5f + w;
            image.colour[j * n + i] = {1, 0.5f, 0, 1};
            image.normal[j * n + i] = normal;
        }
    return image;
}

} // namespace

int main() {
    glcast::HitBuilder hits;
    for (auto axis : {glcast::Axis::x, glcast::Axis::y, glcast::Axis::z})
        for (auto side : {glcast::Side::minus, glcast::Side::plus}) hits.add(ball(axis, side));
    const glcast::Box box{glm::dvec3(0), 1};
    const glcast::Mesh mesh = glcast::reconstruct(std::move(hits), box, {});
    const glcast::MeshCheck check = glcast::check_mesh(mesh);
    const double wanted = 4.0 / 3 * 3.14159265 * radius * radius * radius;
    const bool at_its_place = glcast::lattice_point(box, n, glcast::Axis::z, 0, 0, 0.5).z == 0.5;
    std::printf("%zu triangles, volume %.4f, wanted %.4f\n", mesh.triangles.size(), check.volume, wanted);
    const bool right = check.closed_manifold() && std::abs(check.volume - wanted) < 0.01 * wanted &&
                       std::abs(mesh.colours.at(0).g - 0.5f) < 0.01f && at_its_place;
    return right ? 0 : 1;
}
