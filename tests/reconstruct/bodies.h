// Bodies in closed form and the six images of them, cast without GL: what the engine would capture.
#pragma once
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "capture/view_image.h"

namespace glcast::test {

/// Where a ray is inside a body: t0..t1, with the outward normal and colour at each end.
struct Stretch {
    double t0, t1;
    glm::dvec3 n0, n1;
    glm::vec3 c0, c1;
};

class Body {
  public:
    virtual ~Body() = default;
    /// All stretches of the ray p + t d (d unit), in order.
    virtual std::vector<Stretch> cut(const glm::dvec3& p, const glm::dvec3& d) const = 0;
    /// Signed distance to the surface, exact near it; negative inside.
    virtual double distance(const glm::dvec3& p) const = 0;
};
using BodyPtr = std::shared_ptr<const Body>;

BodyPtr sphere(glm::dvec3 centre, double radius, glm::vec3 colour = {1, 0, 0});
BodyPtr torus(glm::dvec3 centre, glm::dvec3 axis, double ring, double tube, glm::vec3 colour = {0, 1, 0});
/// `turn`: columns are the box's axes.
BodyPtr box(glm::dvec3 centre, glm::dvec3 half, glm::dmat3 turn = glm::dmat3(1),
            glm::vec3 colour = {0, 0, 1});
BodyPtr cylinder(glm::dvec3 centre, glm::dvec3 axis, double radius, double half,
                 glm::vec3 colour = {1, 1, 0});
BodyPtr unite(std::vector<BodyPtr> parts);
BodyPtr subtract(BodyPtr from, BodyPtr what);
glm::dmat3 turned(glm::dvec3 axis, double degrees);

/// What a view may do to the normals it captures.
using NormalEdit = std::function<glm::dvec3(const glm::dvec3& at, const glm::dvec3& normal)>;

/// All six views and the layers of surfaces between first and last hit, axis by axis.
std::vector<ViewImage> cast_layers(const Body& body, const Box& box, int n, const NormalEdit& edit = {});
/// All six views in the order -x +x -y +y -z +z. Depths are floats, like a depth buffer's.
std::vector<ViewImage> cast_body(const Body& body, const Box& box, int n, const NormalEdit& edit = {});
std::vector<ViewImage> noise_images(int n, std::mt19937& random, double coverage);

/// Points of the surface that a ray along an axis sees, for distances from the truth to a mesh.
std::vector<glm::dvec3> surface_points(const Body& body, const Box& box, int rays_per_axis);

/// Points of all surfaces along the rays that can be seen from far away in one of so many directions.
std::vector<glm::dvec3> visible_points(const Body& body, const Box& box, int rays_per_axis,
                                       int directions = 200);

} // namespace glcast::test
