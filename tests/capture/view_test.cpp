// The lattice: pixels of all views are samples of one grid.
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "capture/view.h"

namespace glcast {
namespace {

const Box box{glm::dvec3(-1, 2, -3), 4};
constexpr Axis all_axes[] = {Axis::x, Axis::y, Axis::z};

glm::dvec3 window(Axis axis, glm::dvec3 point) {
    const glm::dvec4 clip = lattice_projection(box, axis) * glm::dvec4(point, 1);
    return (glm::dvec3(clip) / clip.w + 1.0) / 2.0;
}

TEST(View, PixelCentresAreLatticePoints) {
    constexpr int n = 16;
    for (Axis axis : all_axes) {
        const glm::dvec3 at = window(axis, lattice_point(box, n, axis, 3, 12, 0.375));
        EXPECT_NEAR(at.x * n, 3.5, 1e-12);
        EXPECT_NEAR(at.y * n, 12.5, 1e-12);
        EXPECT_NEAR(at.z, 0.375, 1e-12);
    }
}

TEST(View, DepthRunsAlongTheAxis) {
    for (Axis axis : all_axes) {
        glm::dvec3 far = box.lo;
        far[static_cast<int>(axis)] += box.size;
        EXPECT_NEAR(window(axis, box.lo).z, 0, 1e-12);
        EXPECT_NEAR(window(axis, far).z, 1, 1e-12);
    }
}

TEST(View, RaysOfTheThreeAxesMeetInLatticePoints) {
    constexpr int n = 8;
    const double d = 5.5 / n; // sample 5 of the third axis
    const glm::dvec3 by_z = lattice_point(box, n, Axis::z, 2, 6, d);
    EXPECT_LT(glm::distance(by_z, lattice_point(box, n, Axis::x, 6, 5, 2.5 / n)), 1e-12);
    EXPECT_LT(glm::distance(by_z, lattice_point(box, n, Axis::y, 2, 5, 6.5 / n)), 1e-12);
}

} // namespace
} // namespace glcast
