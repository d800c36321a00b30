// Slits between parts and sheets between samples.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/reconstruct/cast.h"

namespace glcast::test {
namespace {

constexpr int n = 80;

BodyPtr slit(double width_samples) {
    return subtract(box({0, 0, 0}, {0.8, 0.8, 0.8}),
                    box({0.101, 0, 0.5}, {0.5 * width_samples * sample_size(n), 2, 0.5}));
}

double depth_of_slit(const Mesh& mesh) {
    double deepest = 0.8;
    for (const glm::dvec3& p : mesh.positions)
        if (std::abs(p.x - 0.101) < 3 * sample_size(n) && std::abs(p.y) < 0.7 && p.z > -0.5)
            deepest = std::min(deepest, p.z);
    return 0.8 - deepest;
}

TEST(Gaps, ANarrowSlitIsClosedAndAWideOneStaysOpen) {
    // Seen along the slit, the disc cannot close the last pixels under its open top.
    EXPECT_LT(depth_of_slit(cast(*slit(1.8), n).mesh), 2 * sample_size(n));
    EXPECT_NEAR(depth_of_slit(cast(*slit(4.2), n).mesh), 0.8, sample_size(n));
    ReconstructOptions wide;
    wide.close_gaps = 3;
    EXPECT_LT(depth_of_slit(cast(*slit(4.2), n, wide).mesh), 4 * sample_size(n));
    ReconstructOptions none;
    none.close_gaps = 0;
    EXPECT_NEAR(depth_of_slit(cast(*slit(1.8), n, none).mesh), 0.8, sample_size(n));
}

TEST(Gaps, ASlitIntoAThinShellIsNoOutside) {
    const auto shell = subtract(box({0, 0, 0}, {0.8, 0.8, 0.8}), box({0, 0, 0}, {0.798, 0.798, 0.798}));
    const auto body = subtract(shell, box({0.101, 0, 0.8}, {2.5 * sample_size(n), 0.5, 0.1}));
    EXPECT_LT(depth_of_slit(cast(*body, n).mesh), 2 * sample_size(n));
    ReconstructOptions none;
    none.close_gaps = 0;
    EXPECT_GT(depth_of_slit(cast(*body, n, none).mesh), 1);
}

TEST(Gaps, ClosingLeavesWholeBodiesAlone) {
    ReconstructOptions none;
    none.close_gaps = 0;
    for (const auto& body : {sphere({0, 0, 0}, 0.9), torus({0, 0, 0}, {0, 0, 1}, 0.6, 0.25),
                             box({0, 0, 0}, {0.55, 0.5, 0.45}, turned({1, 2, 3}, 37))}) {
        const auto images = cast_body(*body, test_box, n);
        EXPECT_TRUE(cast(images).mesh.positions == cast(images, none).mesh.positions);
    }
}

TEST(Sheets, BothSidesOfASheetAreThere) {
    for (double degrees : {0.0, 25.0, 45.0}) {
        const auto sheet = box({0, 0, 0.113}, {0.7, 0.6, 1e-9}, turned({1, 2, 0.5}, degrees));
        const Cast made = cast(*sheet, n);
        EXPECT_GT(made.report.thin_samples, 0u) << degrees;
        const double sample = sample_size(n);
        EXPECT_LT(mesh_to_body(made.mesh, *sheet, sample).mean, 0.08) << degrees;
        EXPECT_LT(points_to_mesh(surface_points(*sheet, test_box, 61), made.mesh, sample).mean, 0.08)
            << degrees;
        const double area = check_mesh(made.mesh).area, wanted = 2 * 1.4 * 1.2;
        EXPECT_NEAR(area, wanted, 0.1 * wanted) << degrees;
        EXPECT_GT(topology(made.mesh).volume, 0) << degrees;
    }
}

TEST(Sheets, EachSideKeepsItsOwnNormals) {
    const Cast made = cast(*box({0, 0, 0.113}, {0.7, 0.6, 1e-9}), n);
    std::size_t up = 0, down = 0;
    for (const glm::vec3& normal : made.mesh.normals) {
        up += normal.z > 0.9f;
        down += normal.z < -0.9f;
    }
    EXPECT_GT(up, made.mesh.normals.size() * 2 / 5);
    EXPECT_GT(down, made.mesh.normals.size() * 2 / 5);
}

TEST(Sheets, ASheetOnASolidBodyHoldsOn) {
    const auto body = unite({box({0, 0, -0.4}, {0.5, 0.5, 0.3}), box({0.01, 0, 0.2}, {1e-9, 0.4, 0.45})});
    const Cast made = cast(*body, n);
    EXPECT_EQ(topology(made.mesh).components, 1u);
    EXPECT_LT(points_to_mesh(surface_points(*body, test_box, 61), made.mesh, sample_size(n)).mean, 0.08);
}

TEST(Sheets, AThickBodyHasNone) {
    EXPECT_EQ(cast(*sphere({0, 0, 0}, 0.9), n).report.thin_samples, 0u);
    EXPECT_EQ(cast(*box({0, 0, 0}, {0.55, 0.5, 0.45}, turned({1, 2, 3}, 37)), n).report.thin_samples, 0u);
}

} // namespace
} // namespace glcast::test
