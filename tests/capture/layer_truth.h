// All hits of a ray with bodies in closed form, and how a capture with layers compares.
#pragma once
#include "tests/capture/scenes.h"
#include "tests/reconstruct/bodies.h"

namespace glcast::test {

struct Hit {
    double depth; ///< 0..1 through the box
    glm::dvec3 normal;
    glm::vec3 colour;
};

/// Of bodies that are drawn each with its own surface, one inside another too; in order.
std::vector<Hit> true_hits(const std::vector<BodyPtr>& bodies, const Box& box, int n, Axis axis,
                           std::size_t pixel);

/// What a capture holds of a ray, first to last; a single hit once.
std::vector<Hit> cast_hits(const Cast& cast, Axis axis, std::size_t pixel);

struct LayerErrors {
    long rays = 0, hits = 0;              ///< of the truth
    long wrong_count = 0;                 ///< rays with more hits or fewer
    double depth_mean = 0, depth_max = 0; ///< samples, of rays with the right number
    double normal_max = 0;                ///< degrees
    double colour_max = 0;
};
LayerErrors layer_errors(const Cast& cast, const std::vector<BodyPtr>& bodies);

/// Largest difference of two captures with layers, rays with another number of hits counted.
struct LayerDifference {
    long rays = 0, wrong_count = 0;
    double depth = 0, colour = 0, normal = 0; ///< samples, 0..1, length
};
LayerDifference layer_difference(const Cast& a, const Cast& b);

/// A cylinder with caps, standing along z; 96 quads around.
BodyPtr cylinder(glm::dvec3 foot, double radius, double height, glm::vec3 colour);
void draw_cylinder(const GlTable& gl, glm::dvec3 foot, double radius, double height);

} // namespace glcast::test
