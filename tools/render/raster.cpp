#include "tools/render/raster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <stdexcept>

#include "tools/picture/sample.h"

namespace glcast {
namespace {

constexpr std::uint32_t nothing = UINT32_MAX;
constexpr glm::vec3 plain_colour{0.7F, 0.7F, 0.7F};

/// Which triangle a pixel sees, and where in it.
struct Fragment {
    std::uint32_t triangle = nothing;
    float b = 0, c = 0;                                       ///< weights of its second and third corner
    double height = -std::numeric_limits<double>::infinity(); ///< towards the camera
};

/// x to the right and y down in pixels, z towards the camera.
glm::dvec3 project(const OrthoView& view, const glm::dvec3& p) {
    const glm::dvec3 d = p - view.centre;
    return {dot(d, view.right) / view.pixel + 0.5 * view.width,
            0.5 * view.height - dot(d, view.up) / view.pixel, dot(d, view.back)};
}

/// First and last pixel whose centre lies in from..to.
struct Range {
    int first, last;
    Range(double from, double to, int size)
        : first(int(std::clamp(std::ceil(from - 0.5), 0.0, double(size)))),
          last(int(std::clamp(std::floor(to - 0.5), -1.0, double(size - 1)))) {}
};

void fill(std::vector<Fragment>& pixels, const OrthoView& view, std::uint32_t triangle, const glm::dvec3& a,
          const glm::dvec3& b, const glm::dvec3& c) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (!(std::abs(area) > 0)) return;
    const Range columns(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), view.width),
        rows(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), view.height);
    for (int y = rows.first; y <= rows.last; ++y)
        for (int x = columns.first; x <= columns.last; ++x) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            // Each edge's test is exactly the negative of its neighbour's, so no pixel falls between two
            // triangles.
            const auto side = [&](const glm::dvec3& from, const glm::dvec3& to) {
                const bool swapped = to.x < from.x || (to.x == from.x && to.y < from.y);
                const glm::dvec3 &s = swapped ? to : from, &e = swapped ? from : to;
                const double value = (e.x - s.x) * (p.y - s.y) - (e.y - s.y) * (p.x - s.x);
                return (swapped ? -value : value) / area;
            };
            const double wc = side(a, b), wa = side(b, c), wb = side(c, a);
            if (wa < 0 || wb < 0 || wc < 0) continue;
            Fragment& pixel = pixels[std::size_t(y) * std::size_t(view.width) + std::size_t(x)];
            const double height = wa * a.z + wb * b.z + wc * c.z;
            if (height > pixel.height) pixel = {triangle, float(wb), float(wc), height};
        }
}

template <class T> T mix(const std::array<T, 3>& corners, float b, float c) {
    return corners[0] * (1 - b - c) + corners[1] * b + corners[2] * c;
}

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0 ? v / length : glm::vec3(0);
}

bool is_whole(const Picture& picture) {
    return picture.rgb.empty() ||
           (picture.width > 0 && picture.height > 0 &&
            picture.rgb.size() == std::size_t(picture.width) * std::size_t(picture.height) * 3);
}

void check(const Mesh& mesh, const Texture& texture, const Wedges& wedges) {
    if (!fits(mesh, wedges)) throw std::runtime_error("cannot draw: the wedges are not those of this mesh");
    if (texture.empty()) return;
    if (texture.coordinates.size() != mesh.triangles.size() || !is_whole(texture.colour) ||
        !is_whole(texture.normal))
        throw std::runtime_error("cannot draw: the texture is not one of this mesh");
    if (!texture.normal.rgb.empty() &&
        (texture.tangents.size() != mesh.triangles.size() || !has_normals(mesh, wedges)))
        throw std::runtime_error("cannot draw: a normal map needs normals and tangents");
}

class Shader {
  public:
    Shader(const Mesh& mesh, const Texture& texture, const Wedges& wedges)
        : mesh(mesh), texture(texture), wedges(wedges) {}

    glm::vec3 colour(const Fragment& at) const {
        if (!texture.empty() && !texture.colour.rgb.empty()) return sample(texture.colour, coordinates(at));
        if (!has_colours(mesh, wedges)) return plain_colour;
        return mix(corner_colours(mesh, wedges, at.triangle), at.b, at.c);
    }

    glm::vec3 normal(const Fragment& at, const glm::dvec3& back) const {
        if (!has_normals(mesh, wedges))
            return glm::dot(glm::dvec3(face(at)), back) < 0 ? -face(at) : face(at);
        const std::array<glm::vec3, 3> normals = corner_normals(mesh, wedges, at.triangle);
        const glm::vec3 smooth = unit(mix(normals, at.b, at.c));
        if (texture.empty() || texture.normal.rgb.empty()) return smooth;
        // As glTF's sample viewer and three.js: tangent and bitangent of the corners, mixed, then unit again.
        const std::array<glm::vec4, 3>& own = texture.tangents[at.triangle];
        std::array<glm::vec3, 3> tangents, bitangents;
        for (std::size_t k = 0; k < 3; ++k) {
            tangents[k] = glm::vec3(own[k]);
            bitangents[k] = glm::cross(normals[k], tangents[k]) * own[k].w;
        }
        const glm::vec3 along = unit(mix(tangents, at.b, at.c)), across = unit(mix(bitangents, at.b, at.c)),
                        bent = sample(texture.normal, coordinates(at)) * 2.0f - 1.0f;
        return unit(along * bent.x + across * bent.y + smooth * bent.z);
    }

  private:
    glm::vec2 coordinates(const Fragment& at) const {
        return mix(texture.coordinates[at.triangle], at.b, at.c);
    }
    glm::vec3 face(const Fragment& at) const {
        const Triangle& t = mesh.triangles[at.triangle];
        const glm::dvec3& a = mesh.positions[t[0]];
        const glm::dvec3 cross = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        const double length = glm::length(cross);
        return length > 0 ? glm::vec3(cross / length) : glm::vec3(0);
    }

    const Mesh& mesh;
    const Texture& texture;
    const Wedges& wedges;
};

} // namespace

SeenImage rasterise(const Mesh& mesh, const Texture& texture, const Wedges& wedges, const OrthoView& view) {
    check(mesh, texture, wedges);
    const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
    std::vector<glm::dvec3> projected;
    projected.reserve(mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) projected.push_back(project(view, p));
    std::vector<Fragment> pixels(count);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corner = mesh.triangles[t];
        fill(pixels, view, t, projected.at(corner[0]), projected.at(corner[1]), projected.at(corner[2]));
    }
    SeenImage image{view.width, view.height, std::vector<char>(count), std::vector<glm::vec3>(count),
                    std::vector<glm::vec3>(count)};
    const Shader shader(mesh, texture, wedges);
    for (std::size_t p = 0; p < count; ++p) {
        if (pixels[p].triangle == nothing) continue;
        image.covered[p] = 1;
        image.colour[p] = shader.colour(pixels[p]);
        image.normal[p] = shader.normal(pixels[p], view.back);
    }
    return image;
}

} // namespace glcast
