// Random bodies: unions, differences and chains of spheres, tori, boxes, sheets, cylinders and cones.
#pragma once
#include <random>

#include "tests/reconstruct/bodies.h"

namespace glcast::test {

class Dice {
  public:
    explicit Dice(unsigned seed) : random(seed) {}
    double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }
    int up_to(int most) { return std::uniform_int_distribution<int>(0, most)(random); }
    glm::dvec3 point(double reach) {
        return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    }
    std::mt19937 random;
};

/// A cone cut off between `from` and `to`, with the radius that it has there; a cylinder when these are
/// equal.
BodyPtr frustum(glm::dvec3 from, glm::dvec3 to, double radius_from, double radius_to,
                glm::vec3 colour = {1, 1, 0});

/// In -1..1 or a little beyond.
BodyPtr random_body(Dice& dice);

} // namespace glcast::test
