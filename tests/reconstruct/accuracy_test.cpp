// How near the surface is to the truth, both ways, in samples.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/reconstruct/cast.h"

namespace glcast::test {
namespace {

const glm::dmat3 tilt = turned({1, 2, 3}, 37);

struct Errors {
    Distance there, back;
};

Errors errors(const Mesh& mesh, const Body& body, int n) {
    return {mesh_to_body(mesh, body, sample_size(n)),
            points_to_mesh(surface_points(body, test_box, 61), mesh, sample_size(n))};
}

BodyPtr eight_spheres() {
    std::vector<BodyPtr> balls;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 centre(unit(random), unit(random), unit(random));
        balls.push_back(sphere(centre, 0.3 + 0.1 * unit(random)));
    }
    return unite(balls);
}

TEST(Accuracy, Sphere) {
    const auto body = sphere({0, 0, 0}, 0.9);
    const Cast made = cast(*body, 96);
    EXPECT_EQ(topology(made.mesh).euler, 2);
    EXPECT_EQ(made.report.unsupported_crossings, 0u);
    const Errors e = errors(made.mesh, *body, 96);
    EXPECT_LT(e.there.mean, 0.004);
    EXPECT_LT(e.there.max, 0.02);
    EXPECT_LT(e.back.max, 0.02);
    const double volume = 4.0 / 3 * M_PI * std::pow(0.9, 3);
    EXPECT_NEAR(topology(made.mesh).volume, volume, 1e-3 * volume);
}

TEST(Accuracy, TorusWhoseHoleNoRayAcrossSees) {
    for (const glm::dvec3 axis : {glm::dvec3(0, 0, 1), glm::dvec3(1, 2, 3)}) {
        const auto body = torus({0, 0, 0}, axis, 0.6, 0.25);
        const Cast made = cast(*body, 96);
        EXPECT_EQ(topology(made.mesh).euler, 0);
        EXPECT_EQ(topology(made.mesh).components, 1u);
        const Errors e = errors(made.mesh, *body, 96);
        EXPECT_LT(e.there.mean, 0.01);
        EXPECT_LT(e.there.max, 0.35);
        EXPECT_LT(e.back.mean, 0.01);
    }
}

TEST(Accuracy, CubeAlongTheAxesHasSharpEdges) {
    const auto body = box({0.01, 0.02, -0.03}, {0.8, 0.7, 0.6});
    const Cast made = cast(*body, 96);
    const Errors e = errors(made.mesh, *body, 96);
    EXPECT_LT(e.there.max, 0.005);
    EXPECT_LT(e.back.max, 0.005);
}

TEST(Accuracy, CubeWithFacesOnSamples) {
    for (int n : {32, 33}) { // faces at samples and half-way between them
        const Box unit{glm::dvec3(-1), 2.0};
        const auto body = box({0, 0, 0}, {0.5, 0.5, 0.5});
        const Mesh mesh = reconstruct(cast_body(*body, unit, n), unit, {});
        EXPECT_EQ(topology(mesh).euler, 2);
        EXPECT_TRUE(topology(mesh).closed());
        EXPECT_LT(mesh_to_body(mesh, *body, 2.0 / n).max, 0.02);
    }
}

TEST(Accuracy, TurnedCubeHasFlatFacesAndSharpEdges) {
    for (double degrees : {3.0, 20.0, 37.0, 45.0}) {
        const auto body = box({0, 0, 0}, {0.55, 0.5, 0.45}, turned({1, 2, 3}, degrees));
        const Cast made = cast(*body, 128);
        const Errors e = errors(made.mesh, *body, 128);
        EXPECT_LT(e.there.mean, 1e-3) << degrees;
        EXPECT_LT(e.back.max, 0.05) << degrees;
        std::size_t off = 0;
        for (const glm::dvec3& p : made.mesh.positions)
            off += std::abs(body->distance(p)) > 0.05 * sample_size(128);
        EXPECT_LE(off, made.mesh.positions.size() / 5000) << degrees;
    }
}

TEST(Accuracy, SpheresAndCsg) {
    const int n = 96;
    const auto balls = eight_spheres();
    const Cast made = cast(*balls, n);
    EXPECT_LT(errors(made.mesh, *balls, n).back.mean, 0.01);
    const auto corner = subtract(box({0, 0, 0}, {0.6, 0.55, 0.5}, tilt),
                                 box({0.4, 0.4, 0.4}, {0.5, 0.5, 0.5}, turned({3, 1, 2}, 20)));
    const Cast cut = cast(*corner, n);
    EXPECT_EQ(topology(cut.mesh).euler, 2);
    EXPECT_LT(errors(cut.mesh, *corner, n).back.mean, 0.005);
}

TEST(Accuracy, WhatIsInsideDoesNotShow) {
    const auto shell = sphere({0, 0, 0}, 0.8);
    const auto body = unite({shell, box({0, 0, 0}, {0.3, 0.3, 0.3}, tilt)});
    const Cast made = cast(*body, 64);
    EXPECT_EQ(topology(made.mesh).components, 1u);
    EXPECT_LT(mesh_to_body(made.mesh, *shell, sample_size(64)).max, 0.02);
}

TEST(Accuracy, WrongNormalsDoNotMoveTheSurface) {
    const int n = 96;
    const auto body = box({0, 0, 0}, {0.55, 0.5, 0.45}, tilt);
    const std::vector<std::pair<const char*, NormalEdit>> edits = {
        {"inwards", [](auto&, const glm::dvec3& normal) { return -normal; }},
        {"round", [](const glm::dvec3& at, auto&) { return glm::normalize(at); }},
        {"one way", [](auto&, auto&) { return glm::dvec3(0.6, 0, 0.8); }},
        {"none", [](auto&, auto&) { return glm::dvec3(0); }},
    };
    for (const auto& [name, edit] : edits) {
        const Cast made = cast(*body, n, {}, edit);
        const Errors e = errors(made.mesh, *body, n);
        EXPECT_LT(e.there.mean, 0.003) << name;
        EXPECT_LT(e.back.max, 0.25) << name;
    }
}

TEST(Accuracy, CubesStayWithinASample) {
    const int n = 64;
    const auto body = sphere({0, 0, 0}, 0.9);
    ReconstructOptions options;
    options.method = SurfaceMethod::cubes;
    const Cast made = cast(*body, n, options);
    EXPECT_EQ(topology(made.mesh).euler, 2);
    EXPECT_LT(mesh_to_body(made.mesh, *body, sample_size(n)).max, 0.9);
    const double sample = sample_size(n), cube = sample * sample * sample;
    EXPECT_NEAR(topology(made.mesh).volume, double(made.report.filled_samples) * cube, 1e-8);
}

} // namespace
} // namespace glcast::test
