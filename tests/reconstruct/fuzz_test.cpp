// Random bodies and images without meaning: whatever the images say, a closed two-manifold that does not pass
// through itself, or a clear refusal.
#include <stdexcept>

#include "tests/mesh/independent_check/cgal.h"
#include "tests/reconstruct/cast.h"
#include "tests/reconstruct/random_bodies.h"

namespace glcast::test {
namespace {

/// True when there was a mesh; cast() has checked it. `ask_cgal`: and CGAL as well.
bool makes_a_mesh(const std::vector<ViewImage>& images, SurfaceMethod method, double close_gaps,
                  bool ask_cgal) {
    try {
        const Cast made = cast(images, {.method = method, .close_gaps = close_gaps});
        for (const glm::dvec3& p : made.mesh.positions) {
            const glm::dvec3 away = (p - test_box.lo) / test_box.size;
            EXPECT_TRUE(away.x > -0.2 && away.x < 1.2 && away.y > -0.2 && away.y < 1.2 && away.z > -0.2 &&
                        away.z < 1.2);
        }
        if (ask_cgal) {
            EXPECT_EQ(cgal_self_intersections(made.mesh).size(), 0u);
        }
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

/// Bodies with the numbers from..to - 1, every fifth of them by both methods; CGAL is asked of every tenth
/// mesh.
void try_bodies(unsigned from, unsigned to) {
    unsigned made = 0;
    for (unsigned trial = from; trial < to; ++trial) {
        SCOPED_TRACE(trial);
        Dice dice(20061 + trial);
        const BodyPtr body = random_body(dice);
        const int n = 14 + dice.up_to(16);
        const auto images = cast_body(*body, test_box, n);
        const double close_gaps = dice.up_to(2);
        made += makes_a_mesh(images, SurfaceMethod::contour, close_gaps, trial % 10 == 0);
        if (trial % 5 == 0) makes_a_mesh(images, SurfaceMethod::cubes, close_gaps, trial % 10 == 5);
        if (::testing::Test::HasFailure()) break;
    }
    EXPECT_GT(made, (to - from) * 9 / 10);
}

TEST(Fuzz, RandomBodiesTo250) { try_bodies(0, 250); }
TEST(Fuzz, RandomBodiesTo500) { try_bodies(250, 500); }
TEST(Fuzz, RandomBodiesTo750) { try_bodies(500, 750); }
TEST(Fuzz, RandomBodiesTo1000) { try_bodies(750, 1000); }

TEST(Fuzz, Noise) {
    Dice dice(7);
    int made = 0;
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(trial);
        const double coverage = trial % 3 == 0 ? 1 : dice.between(0.05, 1);
        const auto images = noise_images(10 + dice.up_to(14), dice.random, coverage);
        for (SurfaceMethod method : {SurfaceMethod::contour, SurfaceMethod::cubes})
            made += makes_a_mesh(images, method, dice.up_to(2), trial % 8 == 0);
        if (HasFailure()) break;
    }
    EXPECT_GT(made, 70);
}

} // namespace
} // namespace glcast::test
