#include "tests/texture/baked.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <numeric>

#include "tools/picture/sample.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/simplify/simplify.h"

namespace glcast::test {

void paint(std::vector<ViewImage>& images, const Box& box, const Paint& colour) {
    for (ViewImage& image : images)
        for (int j = 0; j < image.n; ++j)
            for (int i = 0; i < image.n; ++i) {
                const std::size_t p = std::size_t(j) * image.n + i;
                if (!image.covered(p)) continue;
                const glm::dvec3 at = lattice_point(box, image.n, image.view.axis, i, j, image.depth[p]);
                image.colour[p] = glm::vec4(colour(at, glm::vec3(image.normal[p])), 1);
            }
}

Source make_source(const std::vector<ViewImage>& images, bool layers) {
    Source source;
    ReconstructOptions options;
    options.complete_layers = layers;
    source.full = reconstruct(images, test_box, options, nullptr, &source.captured);
    return source;
}

Mesh coarse(const Mesh& full, double triangles) {
    return simplify(full, {SimplifyTarget::Unit::triangles, triangles});
}

Shown shown_at(const Mesh& mesh, const Texture& texture, std::size_t triangle, const glm::vec3& w) {
    const Triangle& t = mesh.triangles[triangle];
    glm::vec3 normal(0), tangent(0), bitangent(0);
    glm::vec2 where(0);
    for (int k = 0; k < 3; ++k) {
        const glm::vec4& own = texture.tangents[triangle][k];
        normal += w[k] * mesh.normals[t[k]];
        tangent += w[k] * glm::vec3(own);
        bitangent += w[k] * own.w * glm::cross(mesh.normals[t[k]], glm::vec3(own));
        where += w[k] * texture.coordinates[triangle][k];
    }
    const glm::vec3 stored = sample(texture.normal, where) * 2.0f - 1.0f;
    return {sample(texture.colour, where),
            glm::normalize(stored.x * glm::normalize(tangent) + stored.y * glm::normalize(bitangent) +
                           stored.z * glm::normalize(normal))};
}

std::vector<std::uint32_t> charts_of(const Mesh& mesh, const Texture& texture) {
    using End = std::array<float, 3>; // vertex, x, y
    std::map<std::pair<End, End>, std::uint32_t> edges;
    const auto end = [&](std::size_t t, int k) {
        return End{float(mesh.triangles[t][k]), texture.coordinates[t][k].x, texture.coordinates[t][k].y};
    };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) edges[{end(t, k), end(t, (k + 1) % 3)}] = t;
    std::vector<std::uint32_t> chart(mesh.triangles.size(), ~0u), stack;
    std::uint32_t count = 0;
    for (std::uint32_t seed = 0; seed < chart.size(); ++seed) {
        if (chart[seed] != ~0u) continue;
        chart[seed] = count;
        for (stack = {seed}; !stack.empty();) {
            const std::uint32_t t = stack.back();
            stack.pop_back();
            for (int k = 0; k < 3; ++k)
                if (const auto other = edges.find({end(t, (k + 1) % 3), end(t, k)});
                    other != edges.end() && chart[other->second] == ~0u) {
                    chart[other->second] = count;
                    stack.push_back(other->second);
                }
        }
        ++count;
    }
    return chart;
}

Coverage coverage(const Mesh& mesh, const Texture& texture, const std::vector<std::uint32_t>& charts) {
    const int size = texture.colour.width;
    Coverage out;
    out.chart.assign(std::size_t(size) * size, ~0u);
    std::vector<std::uint8_t> inside(out.chart.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        glm::dvec2 p[3];
        for (int k = 0; k < 3; ++k) p[k] = glm::dvec2(texture.coordinates[t][k]) * double(size);
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
        const double area = cross(p[1] - p[0], p[2] - p[0]);
        if (area == 0) continue;
        const int x0 = int(std::min({p[0].x, p[1].x, p[2].x})), x1 = int(std::max({p[0].x, p[1].x, p[2].x}));
        const int y0 = int(std::min({p[0].y, p[1].y, p[2].y})), y1 = int(std::max({p[0].y, p[1].y, p[2].y}));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const glm::dvec2 c(x + 0.5, y + 0.5);
                double least = 1;
                for (int k = 0; k < 3; ++k)
                    least = std::min(least, cross(p[(k + 1) % 3] - p[k], c - p[k]) / area);
                if (least < 0) continue;
                out.chart[std::size_t(y) * size + x] = charts[t];
                // coordinates are single-precision: what lies on a common side is covered once
                if (least > 1e-3) out.twice += inside[std::size_t(y) * size + x]++ == 1;
            }
    }
    return out;
}

double degrees_between(const glm::vec3& a, const glm::vec3& b) {
    return glm::degrees(
        std::acos(std::clamp(double(glm::dot(glm::normalize(a), glm::normalize(b))), -1.0, 1.0)));
}

} // namespace glcast::test
