// What counts as outside when all depth layers are known: cavities that no axis sees, the hidden, the sealed.
#include <map>
#include <tbb/global_control.h>

#include "tests/reconstruct/cast.h"
#include "tests/reconstruct/hollow_bodies.h"

namespace glcast::test {
namespace {

constexpr int n = 96;

BodyPtr hollow_body(const std::string& name) {
    for (const HollowBody& each : hollow_bodies())
        if (each.name == name) return each.body;
    throw std::logic_error(name);
}

struct Errors {
    Distance there, back;
};

/// Back: from what somebody outside can see.
Errors errors(const Mesh& mesh, const Body& body) {
    return {mesh_to_body(mesh, body, sample_size(n)),
            points_to_mesh(visible_points(body, test_box, 41), mesh, sample_size(n))};
}

struct Bar {
    const char* body;
    double mean;
    long euler;
};

class CavitiesThatNoAxisSees : public testing::TestWithParam<Bar> {};

TEST_P(CavitiesThatNoAxisSees, ComeOutExact) {
    const BodyPtr body = hollow_body(GetParam().body);
    const Cast made = cast_deep(*body, n);
    EXPECT_EQ(made.report.exterior, ExteriorRule::layers);
    const Errors e = errors(made.mesh, *body);
    EXPECT_LT(e.there.mean, GetParam().mean);
    EXPECT_LT(e.back.mean, GetParam().mean);
    EXPECT_LT(made.report.unsupported_area_share, 0.01);
    EXPECT_EQ(topology(made.mesh).euler, GetParam().euler);
    const Cast shallow = cast(*body, n);
    EXPECT_EQ(shallow.report.exterior, ExteriorRule::axes);
}

INSTANTIATE_TEST_SUITE_P(Exterior, CavitiesThatNoAxisSees,
                         testing::Values(Bar{"cup", .01, 2}, Bar{"bent_tube", .01, 0},
                                         Bar{"bracket", .01, -2}, Bar{"fins", .01, 2}),
                         [](const auto& info) { return std::string(info.param.body); });

TEST(Exterior, WhatAClosedShellHidesGoes) {
    const Cast made = cast_deep(*hollow_body("sphere_in_box"), n);
    EXPECT_EQ(topology(made.mesh).components, 1u);
    EXPECT_EQ(topology(made.mesh).euler, 2);
    const double cube = std::pow(1.2, 3);
    EXPECT_NEAR(topology(made.mesh).volume, cube, 1e-4 * cube);
}

TEST(Exterior, AHollowBehindASmallOpeningStaysFilled) {
    const BodyPtr bottle = hollow_body("bottle");
    const Cast made = cast_deep(*bottle, n);
    EXPECT_GT(made.report.hidden_samples, 10000u);
    EXPECT_EQ(topology(made.mesh).components, 1u);
    EXPECT_LT(errors(made.mesh, *bottle).there.mean, 0.02);
    EXPECT_LT(made.report.unsupported_area_share, 0.01);
    // What is filled is the bottle's belly.
    EXPECT_GT(topology(made.mesh).volume, 0.95 * M_PI * 0.5 * 0.5 * 1.0);
}

TEST(Exterior, OpenWindowsShowTheInsideAndSlitsDoNot) {
    const BodyPtr car = hollow_body("car");
    const Cast made = cast_deep(*car, n);
    const Errors e = errors(made.mesh, *car);
    EXPECT_LT(e.there.mean, 0.01);
    EXPECT_LT(e.back.mean, 0.1); // but for the engine, which some rays reach through the slit
    // Shell and seat; the engine behind the slit of one sample is not there.
    EXPECT_EQ(topology(made.mesh).components, 2u);
    const auto inside_engine_bay = [](const glm::dvec3& p) {
        return p.x > 0.5 && p.x < 0.83 && std::abs(p.y) < 0.3 && p.z > -0.38 && p.z < -0.05;
    };
    for (const glm::dvec3& p : made.mesh.positions) EXPECT_FALSE(inside_engine_bay(p));
}

TEST(Exterior, PassagesAreSealedByTheirWidth) {
    // A hollow cube with a slot of so many samples right through one wall.
    const double sample = sample_size(n);
    std::map<double, bool> open;
    for (double width : {1.2, 2.0, 5.0, 9.0}) {
        const BodyPtr wall = subtract(box({0, 0, 0}, glm::dvec3(0.6)), box({0, 0, 0}, glm::dvec3(0.4)));
        const BodyPtr slotted = subtract(wall, box({0.5, 0.003, 0}, {0.3, width / 2 * sample, 0.41}));
        const Cast made = cast_deep(*slotted, n);
        // Sealed flush, or open right through the wall.
        open[width] = topology(made.mesh).volume < 0.97 * 1.2 * 1.2 * 1.2;
        if (width <= 2) {
            EXPECT_NEAR(topology(made.mesh).volume, 1.2 * 1.2 * 1.2, 0.002) << width;
        }
    }
    EXPECT_FALSE(open[1.2]);
    EXPECT_FALSE(open[2.0]);
    EXPECT_TRUE(open[9.0]);
}

TEST(Exterior, ASlitInSolidMatterWiderThanTheRadiusStaysOpen) {
    const double sample = sample_size(n);
    for (double width : {2.0, 5.0}) {
        const BodyPtr block =
            subtract(box({0, 0, 0}, glm::dvec3(0.6)), box({0, 0.004, 0.4}, {2, width / 2 * sample, 0.4}));
        const double volume = topology(cast_deep(*block, n).mesh).volume, whole = 1.2 * 1.2 * 1.2;
        const double slit = 1.2 * width * sample * 0.6;
        EXPECT_NEAR(volume, width < 3 ? whole : whole - slit, 0.1 * slit) << width; // the mouths are rounded
        ReconstructOptions keep;
        keep.close_gaps = 0;
        EXPECT_NEAR(topology(cast_deep(*block, n, keep).mesh).volume, whole - slit, 0.05 * slit) << width;
    }
}

TEST(Exterior, SolidBodiesAreAsFromSixViews) {
    const BodyPtr bodies[] = {sphere({0, 0, 0}, 0.9), torus({0, 0, 0}, {1, 2, 3}, 0.6, 0.25),
                              box({0, 0, 0}, {0.55, 0.5, 0.45}, turned({1, 2, 3}, 37))};
    for (const BodyPtr& body : bodies) {
        const Cast deep = cast_deep(*body, n), shallow = cast(*body, n);
        EXPECT_EQ(deep.report.thin_samples, 0u);
        EXPECT_LT(errors(deep.mesh, *body).there.mean, errors(shallow.mesh, *body).there.mean + 1e-3);
        EXPECT_LT(deep.report.unsupported_area_share, 0.001);
    }
}

TEST(Exterior, AWallOfNoSampleIsThereFromBothSides) {
    // A cup whose wall is a fifth of a sample thick: a sheet, as thin GL models are.
    const double sample = sample_size(n);
    const glm::dvec3 up = turned({1, 0.3, 0.2}, 40)[2];
    const BodyPtr cup = subtract(cylinder({0, 0, 0}, up, 0.6, 0.6),
                                 cylinder(up * (0.2 * sample), up, 0.6 - 0.2 * sample, 0.6, {1, 0, 0}));
    const Cast made = cast_deep(*cup, n);
    EXPECT_GT(made.report.thin_samples, 1000u);
    const Errors e = errors(made.mesh, *cup);
    EXPECT_LT(e.there.mean, 0.06);
    EXPECT_LT(e.back.mean, 0.06);
    EXPECT_LT(topology(made.mesh).volume, 0.2);
}

TEST(Exterior, TheSameBytesForAnyNumberOfThreads) {
    const auto images = cast_layers(*hollow_body("bottle"), test_box, 64);
    ReconstructOptions how;
    how.complete_layers = true;
    const Mesh first = reconstruct(images, test_box, how);
    for (int threads : {1, 3}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const Mesh again = reconstruct(images, test_box, how);
        EXPECT_EQ(again.positions, first.positions);
        EXPECT_EQ(again.triangles, first.triangles);
        EXPECT_EQ(again.colours, first.colours);
    }
}

} // namespace
} // namespace glcast::test
