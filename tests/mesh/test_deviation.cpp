// Distances that are known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <tbb/global_control.h>

#include "tests/mesh/bodies.h"
#include "tools/deviation/deviation.h"

namespace glcast::test {
namespace {

Mesh square(double size, const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v) {
    Mesh mesh;
    for (const auto& [i, j] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        mesh.positions.push_back(centre + size / 2 * (double(i) * u + double(j) * v));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh shifted(Mesh mesh, const glm::dvec3& by) {
    for (glm::dvec3& p : mesh.positions) p += by;
    return mesh;
}

void expect_all(const DistanceStats& stats, double distance, double tolerance) {
    EXPECT_NEAR(stats.mean, distance, tolerance);
    EXPECT_NEAR(stats.rms, distance, tolerance);
    EXPECT_NEAR(stats.p999, distance, tolerance);
    EXPECT_NEAR(stats.max, distance, tolerance);
}

DeviationOptions few(std::size_t samples = 20'000, bool visible_only = true) {
    DeviationOptions options;
    options.samples = samples;
    options.visible_only = visible_only;
    return options;
}

TEST(Deviation, IdenticalMeshesAreAtZero) {
    for (const NamedBody& body : bodies()) {
        const Deviation d = deviation(body.mesh, body.mesh, few(5'000));
        const double rounding = 1e-12 * d.diagonal_a + 1e-15 * 3000; // one body is 3000 off the origin
        for (const DistanceStats& stats : {d.a_to_b, d.b_to_a}) {
            expect_all(stats, 0, rounding);
            EXPECT_GT(stats.points, 1000U) << body.name;
        }
    }
}

TEST(Deviation, BetweenConcentricSpheres) {
    const Mesh inner = sphere(1, 5),
               outer = sphere(1.25, 5); // triangles similar to one another: 0.25 at the vertices
    const Deviation d = deviation(inner, outer, few());
    expect_all(d.a_to_b, 0.25, 0.002);
    expect_all(d.b_to_a, 0.25, 0.002);
    EXPECT_EQ(d.a_to_b.points + d.a_to_b.hidden, 20'000 + inner.triangles.size() + inner.positions.size());
    EXPECT_EQ(d.a_to_b.hidden, 0U);
    EXPECT_LT(d.a_to_b.normal_mean_degrees, 0.5);
    EXPECT_NEAR(d.diagonal_a, 2 * std::sqrt(3.0), 0.01);
}

TEST(Deviation, OfAPlaneThatIsOffset) {
    const Mesh a = square(2, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
               b = square(2, {0, 0, 0.125}, {1, 0, 0}, {0, 1, 0});
    const Deviation d = deviation(a, b, few());
    expect_all(d.a_to_b, 0.125, 1e-15);
    expect_all(d.b_to_a, 0.125, 1e-15);
    EXPECT_EQ(d.a_to_b.hidden, 0U);
    EXPECT_NEAR(d.a_to_b.normal_mean_degrees, 0, 1e-9);
}

TEST(Deviation, OfTwoSquaresAtAnAngle) {
    const double angle = 0.3;
    const Mesh a = square(1, {0.5, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Mesh b =
        square(2, {std::cos(angle), 0, std::sin(angle)}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0});
    const DistanceStats d = deviation(a, b, few(200'000)).a_to_b; // distance x sin(angle), x evenly in 0..1
    EXPECT_NEAR(d.mean, 0.5 * std::sin(angle), 1e-4);
    EXPECT_NEAR(d.rms, std::sqrt(1.0 / 3) * std::sin(angle), 1e-4);
    EXPECT_NEAR(d.p999, 0.999 * std::sin(angle), 1e-4);
    EXPECT_NEAR(d.max, std::sin(angle), 1e-12);
    EXPECT_NEAR(d.normal_mean_degrees, angle * 180 / std::numbers::pi, 1e-9);
}

TEST(Deviation, OfACubeThatIsShifted) {
    // Shifted by s along x: two sides are s away, of the four others a strip s wide, s/2 in the mean, sticks
    // out.
    const double s = 0.1;
    const Mesh a = cube(1, 1), b = shifted(cube(1, 1), {s, 0, 0});
    const DistanceStats d = deviation(a, b, few(200'000, false)).a_to_b;
    // The far side (x = +½) lies inside b, whose own sides are near its rim: distance min(s, distance to the
    // rim).
    const double rim =
        s - 2 * s * s + 4.0 / 3 * s * s * s; // mean of min(s, distance to the rim) over a unit square
    EXPECT_NEAR(d.mean, (s + rim + 4 * s * s / 2) / 6, 1e-4);
    EXPECT_NEAR(d.max, s, 1e-12);
}

TEST(Deviation, LeavesOutAHiddenSphere) {
    const Mesh shell = sphere(1, 4), both = joined(sphere(1, 4), sphere(0.5, 4));
    const Deviation seen = deviation(both, shell, few());
    expect_all(seen.a_to_b, 0, 1e-9);
    // A fifth of the samples, by area, and half of the vertices and face centres.
    EXPECT_NEAR(double(seen.a_to_b.hidden), 4'000 + 5120 + 2562, 20);
    const Deviation all = deviation(both, shell, few(20'000, false));
    EXPECT_EQ(all.a_to_b.hidden, 0U);
    EXPECT_NEAR(all.a_to_b.max, 0.5, 0.01);
}

TEST(Deviation, SeesWhatALargeHoleShows) {
    // The inner sphere shows through the missing half of the outer.
    Mesh both = sphere(1, 4);
    std::erase_if(both.triangles, [&](const Triangle& t) { return both.positions[t[0]].z > 0; });
    both = joined(std::move(both), sphere(0.25, 4));
    const std::size_t hidden = deviation(both, both, few()).a_to_b.hidden;
    EXPECT_GT(hidden, 0U); // its underside is in a bowl: some of it sees nothing free
    const std::vector<SurfacePoint> poles = {{{0, 0, 0.25}, {0, 0, 1}}, {{0, 0, -0.25}, {0, 0, -1}}};
    const std::vector<char> seen = visible_points(both, poles);
    EXPECT_TRUE(seen[0]);
    EXPECT_FALSE(seen[1]);
}

TEST(Deviation, InterpenetratingPartsHideTheirInsides) {
    const glm::dvec3 centres[] = {{0, 0, 0}, {1, 0, 0}};
    const Mesh two = joined(sphere(1, 5, centres[0]), sphere(1, 5, centres[1]));
    const std::vector<SurfacePoint> points = sample_by_area(two, 50'000); // in the order of the triangles
    const std::vector<char> seen = visible_points(two, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double to_other = glm::distance(points[i].position, centres[i < points.size() / 2]);
        if (std::abs(to_other - 1) < 0.01) continue; // at the seam
        EXPECT_EQ(bool(seen[i]), to_other > 1) << i;
    }
}

TEST(Deviation, ThinSheetsAreSeenFromBothSides) {
    for (const double thickness : {1e-3, 1e-4}) { // relative to the size 1
        Mesh sheet = cube(1, 4);
        for (glm::dvec3& p : sheet.positions) p.z *= thickness;
        EXPECT_EQ(deviation(sheet, sheet, few()).a_to_b.hidden, 0U) << thickness;
    }
    const Mesh single = square(1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(deviation(single, single, few()).a_to_b.hidden, 0U);
    EXPECT_EQ(deviation(joined(single, single), single, few()).a_to_b.hidden, 0U); // drawn twice
}

TEST(Deviation, FacingDoesNotMatter) {
    Mesh soup = sphere(1, 4);
    for (std::size_t i = 0; i < soup.triangles.size(); i += 2)
        std::swap(soup.triangles[i][0], soup.triangles[i][1]);
    const Deviation d = deviation(soup, sphere(1, 4), few());
    EXPECT_EQ(d.a_to_b.hidden, 0U);
    EXPECT_NEAR(d.a_to_b.normal_mean_degrees, 0, 1e-6);
}

TEST(Deviation, CreasesAreSeenAtTheirBottom) {
    const Mesh body =
        blocks(12, 4, 12, [](int x, int y, int) { return y < 2 || x % 4 < 2; }); // grooves, 2 by 2
    EXPECT_EQ(deviation(body, body, few()).a_to_b.hidden, 0U);
}

TEST(Deviation, DistancesOfGivenPoints) {
    const glm::dvec3 points[] = {{0, 0, 2}, {0, 0, 0}, {3, 0, 4}, {0.5, 0.5, 0.5}, {1, 1, 1}};
    const std::vector<double> d = distances_to(cube(1, 3), points);
    const double expected[] = {1.5, 0.5, std::hypot(2.5, 3.5), 0, std::sqrt(0.75)};
    ASSERT_EQ(d.size(), std::size(expected));
    for (std::size_t i = 0; i < d.size(); ++i) EXPECT_NEAR(d[i], expected[i], 1e-12) << i;
}

TEST(Deviation, IsExactFarFromTheOriginAndAgainstBruteForce) {
    const Mesh mesh = shifted(sphere(1e-3, 3), {1000, 2000, -500});
    std::vector<glm::dvec3> points;
    for (const SurfacePoint& p : sample_by_area(sphere(1, 1), 200))
        points.push_back(glm::dvec3(1000, 2000, -500) + 1.5e-3 * p.position);
    const std::vector<double> d = distances_to(mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) { // spheres: the nearest vertex and the radius bracket it
        double vertex = 1e9;
        for (const glm::dvec3& p : mesh.positions) vertex = std::min(vertex, glm::distance(points[i], p));
        EXPECT_LE(d[i], vertex);
        EXPECT_GE(d[i], glm::distance(points[i], glm::dvec3(1000, 2000, -500)) - 1e-3 - 1e-12);
    }
}

TEST(Deviation, SamplesAreEvenByArea) {
    Mesh uneven = cube(1, 1);
    uneven =
        joined(std::move(uneven), shifted(cube(1, 30), {5, 0, 0})); // the same area, 900 times the triangles
    const std::vector<SurfacePoint> points = sample_by_area(uneven, 12'000);
    ASSERT_EQ(points.size(), 12'000U);
    std::size_t left = 0, top_quarter = 0;
    for (const SurfacePoint& p : points) {
        left += p.position.x < 2;
        top_quarter += p.position.z == 0.5 && std::abs(p.position.x) < 0.25 && std::abs(p.position.y) < 0.25;
    }
    EXPECT_NEAR(double(left), 6'000, 1);
    EXPECT_NEAR(double(top_quarter), 250, 15);
}

TEST(Deviation, IsTheSameOnAnyNumberOfThreads) {
    const Mesh a = torus(2, 0.6, 60, 30), b = torus(2, 0.6, 31, 17);
    std::vector<Deviation> results;
    for (const std::size_t threads : {1, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(deviation(a, b, few()));
    }
    EXPECT_EQ(results[0].a_to_b.mean, results[1].a_to_b.mean);
    EXPECT_EQ(results[0].b_to_a.rms, results[1].b_to_a.rms);
    EXPECT_EQ(results[0].a_to_b.normal_mean_degrees, results[1].a_to_b.normal_mean_degrees);
    EXPECT_EQ(results[0].b_to_a.p999, results[1].b_to_a.p999);
}

TEST(Deviation, RefusesAnEmptyMesh) {
    EXPECT_THROW(deviation(Mesh{}, cube(1, 1)), std::runtime_error);
    EXPECT_THROW(deviation(cube(1, 1), Mesh{}), std::runtime_error);
}

} // namespace
} // namespace glcast::test
