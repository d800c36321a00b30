// What the tests of textures share: bodies painted by place, and the texture as a viewer sees it.
#pragma once
#include <functional>
#include <glm/vec2.hpp>

#include "tests/reconstruct/bodies.h"
#include "tools/mesh/level.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast::test {

inline const Box test_box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};

using Paint = std::function<glm::vec3(const glm::dvec3& at, const glm::vec3& normal)>;

/// Colours every hit of the images by its place and normal.
void paint(std::vector<ViewImage>& images, const Box& box, const Paint& colour);

/// A full surface and what was captured of it.
struct Source {
    Mesh full;
    CapturedSurface captured;
};
Source make_source(const std::vector<ViewImage>& images, bool layers = false);

/// Down to so many triangles.
Mesh coarse(const Mesh& full, double triangles);

/// At a point of a triangle, as glTF says: bilinear, tangent frame of unit vectors.
struct Shown {
    glm::vec3 colour, normal;
};
Shown shown_at(const Mesh& mesh, const Texture& texture, std::size_t triangle, const glm::vec3& weights);

/// Charts as the coordinates alone have them: triangles joined where an edge has the same coordinates on both
/// sides.
std::vector<std::uint32_t> charts_of(const Mesh& mesh, const Texture& texture);

/// By texel: the chart whose triangle covers its centre (or none = ~0u); and how many centres lie strictly
/// inside two triangles.
struct Coverage {
    std::vector<std::uint32_t> chart;
    std::size_t twice = 0;
};
Coverage coverage(const Mesh& mesh, const Texture& texture, const std::vector<std::uint32_t>& charts);

double degrees_between(const glm::vec3& a, const glm::vec3& b);

} // namespace glcast::test
