// Outlines of levels, against those of bodies in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include "tests/texture/baked.h"
#include "tools/mesh/check.h"
#include "tools/mesh/intersections.h"
#include "tools/render/raster.h"
#include "tools/texture/outline.h"

namespace glcast::test {
namespace {

constexpr int directions = 24;

OrthoView view_number(int k) {
    const double z = 1 - (2 * k + 1.0) / directions, turn = k * 2.399963229728653; // Fibonacci's sphere
    OrthoView view;
    view.back = {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z};
    view.right = glm::normalize(glm::cross(glm::dvec3(0.3, 0.9, 0.1), view.back));
    view.up = glm::cross(view.back, view.right);
    view.width = view.height = 512;
    view.pixel = 2.2 / view.width;
    return view;
}

/// Pixels of a picture, on average, that the level or the body covers alone.
template <class Covered> double outline_error(const Mesh& mesh, const Covered& covered) {
    double differ = 0;
    for (int k = 0; k < directions; ++k) {
        const OrthoView view = view_number(k);
        const SeenImage image = rasterise(mesh, {}, view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                differ += bool(image.covered[std::size_t(y) * view.width + x]) !=
                          covered(k, (x + 0.5 - view.width / 2.0) * view.pixel,
                                  (view.height / 2.0 - y - 0.5) * view.pixel, x, y);
    }
    return differ / directions;
}

double rms_off_sphere(const Mesh& mesh, double radius) {
    double sum = 0, weight = 0;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const double area = glm::length(glm::cross(b - a, c - a));
        for (const glm::dvec3& p : {(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0})
            sum += area / 3 * std::pow(glm::length(p) - radius, 2);
        weight += area;
    }
    return std::sqrt(sum / weight);
}

TEST(Outline, OfASphereIsNearerToTheCircle) {
    const double radius = 0.8;
    const Source source = make_source(cast_body(*sphere({0, 0, 0}, radius), test_box, 96));
    for (const double triangles : {150.0, 600.0}) {
        Mesh mesh = coarse(source.full, triangles);
        const auto disc = [&](int, double x, double y, int, int) { return x * x + y * y < radius * radius; };
        const double before = outline_error(mesh, disc), surface = rms_off_sphere(mesh, radius);
        const Mesh was = mesh;
        fit_outlines(mesh, source.captured);
        EXPECT_LT(outline_error(mesh, disc), 0.9 * before) << triangles;
        EXPECT_LT(rms_off_sphere(mesh, radius), 1.3 * surface) << triangles;
        EXPECT_EQ(mesh.triangles, was.triangles);
        EXPECT_TRUE(check_mesh(mesh).closed_manifold());
    }
}

TEST(Outline, OfATorusIsNearerToTheFullSurfaces) {
    const Source source = make_source(cast_body(*torus({0, 0, 0}, {1, 2, 3}, 0.6, 0.25), test_box, 96));
    std::vector<SeenImage> wanted;
    for (int k = 0; k < directions; ++k) wanted.push_back(rasterise(source.full, {}, view_number(k)));
    const auto full = [&](int k, double, double, int x, int y) {
        return bool(wanted[k].covered[std::size_t(y) * wanted[k].width + x]);
    };
    Mesh mesh = coarse(source.full, 400);
    const double before = outline_error(mesh, full);
    fit_outlines(mesh, source.captured);
    EXPECT_LT(outline_error(mesh, full), 0.9 * before);
    EXPECT_EQ(count_self_intersections(mesh.positions, mesh.triangles), 0u);
}

/// What lies on the surface already stays there, on edges and at corners too.
TEST(Outline, LeavesABoxWhereItIs) {
    const Source source =
        make_source(cast_body(*box({0, 0, 0}, {0.6, 0.5, 0.4}, turned({1, 2, 3}, 12)), test_box, 96));
    Mesh mesh = coarse(source.full, 60);
    const Mesh was = mesh;
    fit_outlines(mesh, source.captured);
    double moved = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        moved =
            std::max(moved, glm::distance(mesh.positions[v], was.positions[v]) / source.captured.sample());
    EXPECT_LT(moved, 0.1);
}

/// The sides of a plate thinner than the moves do not pass through one another.
TEST(Outline, CrossesNothing) {
    const Source source =
        make_source(cast_body(*box({0, 0, 0.001}, {0.7, 0.7, 0.008}, turned({1, 0.3, 0}, 10)), test_box, 96));
    for (const double triangles : {40.0, 300.0}) {
        Mesh mesh = coarse(source.full, triangles);
        const std::size_t before = count_self_intersections(mesh.positions, mesh.triangles);
        fit_outlines(mesh, source.captured);
        EXPECT_LE(count_self_intersections(mesh.positions, mesh.triangles), before);
    }
}

TEST(Outline, TheSameOnAnyNumberOfThreads) {
    const Source source = make_source(cast_body(*sphere({0, 0, 0}, 0.8), test_box, 64));
    const Mesh level = coarse(source.full, 300);
    std::vector<Mesh> made;
    for (const std::size_t threads : {1, 2, 7}) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        made.push_back(level);
        fit_outlines(made.back(), source.captured);
    }
    EXPECT_TRUE(made[1].positions == made[0].positions);
    EXPECT_TRUE(made[2].positions == made[0].positions);
    EXPECT_FALSE(made[0].positions == level.positions);
}

TEST(Outline, LeavesWhatHasNoSurfaceNear) {
    const Source source = make_source(cast_body(*sphere({0, 0, 0}, 0.8), test_box, 64));
    Mesh mesh, empty;
    mesh.positions = {{0.1, 0.1, 0.1}, {0.1, -0.1, -0.1}, {-0.1, 0.1, -0.1}, {-0.1, -0.1, 0.1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    const Mesh was = mesh;
    fit_outlines(mesh, source.captured);
    EXPECT_TRUE(mesh.positions == was.positions);
    fit_outlines(mesh, {});
    EXPECT_TRUE(mesh.positions == was.positions);
    fit_outlines(empty, source.captured);
    EXPECT_TRUE(empty.positions.empty());
}

} // namespace
} // namespace glcast::test
