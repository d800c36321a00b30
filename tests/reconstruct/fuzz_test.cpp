// Random bodies and images without meaning: whatever the images say, a closed two-manifold or a clear
// refusal.
#include <stdexcept>

#include "tests/reconstruct/cast.h"

namespace glcast::test {
namespace {

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

BodyPtr random_part(Dice& dice) {
    const glm::vec3 colour(dice.point(1));
    const glm::dmat3 turn = turned(dice.point(1) + glm::dvec3(0, 0, 1.5), dice.between(0, 90));
    switch (dice.up_to(3)) {
    case 0:
        return sphere(dice.point(0.5), dice.between(0.02, 0.5), colour);
    case 1:
        return torus(dice.point(0.4), dice.point(1), dice.between(0.1, 0.5), dice.between(0.02, 0.1), colour);
    case 2:
        return box(dice.point(0.5), {dice.between(0.05, 0.5), dice.between(0.05, 0.5), 1e-9}, turn, colour);
    default:
        return box(dice.point(0.5),
                   {dice.between(0.02, 0.5), dice.between(0.02, 0.5), dice.between(0.02, 0.5)}, turn, colour);
    }
}

BodyPtr random_body(Dice& dice) {
    std::vector<BodyPtr> parts;
    for (int k = dice.up_to(5) + 1; k > 0; --k) parts.push_back(random_part(dice));
    BodyPtr body = unite(parts);
    return dice.up_to(2) == 0 ? subtract(body, random_part(dice)) : body;
}

/// Both methods; true when there was a mesh.
bool makes_a_mesh(const std::vector<ViewImage>& images, double close_gaps) {
    for (SurfaceMethod method : {SurfaceMethod::contour, SurfaceMethod::cubes}) {
        try {
            const Cast made = cast(images, {method, close_gaps, false});
            for (const glm::dvec3& p : made.mesh.positions) {
                const glm::dvec3 away = (p - test_box.lo) / test_box.size;
                EXPECT_TRUE(away.x > -0.2 && away.x < 1.2 && away.y > -0.2 && away.y < 1.2 && away.z > -0.2 &&
                            away.z < 1.2);
            }
        } catch (const std::runtime_error&) {
            return false;
        }
    }
    return true;
}

TEST(Fuzz, RandomBodies) {
    Dice dice(20061);
    int made = 0;
    for (int trial = 0; trial < 200; ++trial) {
        SCOPED_TRACE(trial);
        const BodyPtr body = random_body(dice);
        made += makes_a_mesh(cast_body(*body, test_box, 24 + dice.up_to(16)), dice.up_to(2));
        if (HasFailure()) break;
    }
    EXPECT_GT(made, 180);
}

TEST(Fuzz, Noise) {
    Dice dice(7);
    int made = 0;
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        const double coverage = trial % 3 == 0 ? 1 : dice.between(0.05, 1);
        made += makes_a_mesh(noise_images(10 + dice.up_to(14), dice.random, coverage), dice.up_to(2));
        if (HasFailure()) break;
    }
    EXPECT_GT(made, 50);
}

} // namespace
} // namespace glcast::test
