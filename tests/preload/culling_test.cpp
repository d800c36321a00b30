// Culling is part of the picture: hulls of which only the far side is drawn are no solids, and rooms are seen
// from within (programs/rooms.c). Volumes and colours of the surface, in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/preload/program_run.h"
#include "tools/mesh/check.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast::test {
namespace {

constexpr int n = 96;
constexpr double thickness = 0.1; ///< of sheets, samples
constexpr const char* told = "as an outline: ";

struct Cast : CastRun {
    double sample = 0, volume = 0, red = 0, other = 0; ///< areas by colour
    bool is_closed = false;
    bool says(const std::string& text) const { return outcome.err.find(text) != std::string::npos; }
};

void measure(Cast& cast) {
    const Capture& capture = *cast.capture;
    cast.sample = capture.info.box.size / n;
    ReconstructOptions how;
    how.complete_layers = capture.info.layers == Layers::complete;
    how.sheet_thickness = thickness;
    how.eyes = capture.info.seen_places;
    if (capture.info.eye) how.eyes.push_back(*capture.info.eye);
    const Mesh mesh = reconstruct(capture.images, capture.info.box, how);
    const MeshCheck check = check_mesh(mesh);
    cast.is_closed = check.closed_manifold();
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        const glm::vec3 colour = mesh.colours[t[0]] + mesh.colours[t[1]] + mesh.colours[t[2]];
        (colour.r > colour.g + colour.b ? cast.red : cast.other) += area;
        cast.volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
}

Cast cast(const std::string& kind, const std::string& way, Environment environment = {}) {
    Cast run{cast_program({ROOMS, kind, way}, n, std::move(environment))};
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    if (!run.capture) return run;
    measure(run);
    EXPECT_TRUE(run.is_closed);
    return run;
}

constexpr double cube_volume = 8, cube_area = 24;

class Outlines : public testing::TestWithParam<const char*> {};

TEST_P(Outlines, AreNoSolids) {
    const Cast run = cast("outline", GetParam());
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_NEAR(run.volume, cube_volume, 0.02 * cube_volume);
    EXPECT_NEAR(run.red, cube_area, 0.02 * cube_area);
    EXPECT_EQ(run.other, 0);
}
INSTANTIATE_TEST_SUITE_P(Culling, Outlines,
                         testing::Values("far_faces", "drawn_first", "other_way_round", "halo",
                                         "halo_without_depth", "lines", "same_faces", "nothing_shown"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Culling, OutlinesAreNamedAndKeptWhenAskedFor) {
    const Cast run = cast("outline", "far_faces");
    EXPECT_TRUE(run.says(told)) << run.outcome.err;
    EXPECT_TRUE(run.says("--backdrop keep")) << run.outcome.err;
    const Cast kept = cast("outline", "far_faces", {{"GLCAST_BACKDROP", "keep"}});
    EXPECT_FALSE(kept.says(told)) << kept.outcome.err;
    // A room about the box then.
    const double hull = 6 * 2.2 * 2.2;
    EXPECT_NEAR(kept.other, 2 * hull, 0.02 * 2 * hull);
    EXPECT_NEAR(kept.red, cube_area, 0.02 * cube_area);
}

TEST(Culling, ARoundOutlineIsNoSolid) {
    const Cast run = cast("outline", "round");
    ASSERT_TRUE(run.capture) << run.outcome.err;
    EXPECT_TRUE(run.says(told)) << run.outcome.err;
    const double ball = 4.0 / 3 * M_PI;
    EXPECT_NEAR(run.volume, ball, 0.03 * ball); // of strips: 2 % less
    EXPECT_EQ(run.other, 0);
}

TEST(Culling, SolidsStayAsTheyAre) {
    const Cast run = cast("outline", "solid");
    EXPECT_NEAR(run.volume, cube_volume, 0.01 * cube_volume);
    EXPECT_FALSE(run.says(told)) << run.outcome.err;
    EXPECT_TRUE(run.capture->info.seen_places.empty());
    const Cast floor = cast("outline", "solid_on_floor");
    EXPECT_NEAR(floor.volume, cube_volume + 64 * 0.2, 0.3);
    EXPECT_TRUE(floor.capture->info.seen_places.empty());
}

/// From below, where the floor of walls that cull their fronts is not drawn, the bottom of the furniture is
/// seen: red too. Walls have two sides; what stands on them covers as much of the inner one as it adds at its
/// top.
struct Inside {
    const char* way;
    double walls, furniture, red; ///< area of one side, volume, area
};
class Rooms : public testing::TestWithParam<Inside> {};

TEST_P(Rooms, AreSeenFromWithin) {
    const auto& [way, walls, furniture, red] = GetParam();
    const Cast run = cast("room", way);
    ASSERT_TRUE(run.capture) << run.outcome.err;
    const double sheets = walls * thickness * run.sample;
    EXPECT_NEAR(run.volume, furniture + sheets, 0.02 * furniture + 0.25 * sheets);
    EXPECT_NEAR(run.red, red, 0.05 * red);
    EXPECT_NEAR(run.red + run.other, 2 * walls + red - furniture, 0.03 * 2 * walls);
    EXPECT_FALSE(run.says("left out")) << run.outcome.err;
}
/// Of the trapezoids that rooms.c makes a ball of.
double ball_area(double radius) {
    constexpr int strips = 16, sectors = 32;
    double area = 0;
    for (int j = 0; j < strips; ++j) {
        const double low = M_PI * (double(j) / strips - 0.5), high = low + M_PI / strips,
                     half = M_PI / sectors;
        const double up = std::sin(high) - std::sin(low),
                     in = (std::cos(high) - std::cos(low)) * std::cos(half);
        area += sectors * (std::cos(low) + std::cos(high)) * std::sin(half) * std::hypot(up, in);
    }
    return area * radius * radius;
}

constexpr double four_walls = 2 * (4 * 3 + 4 * 3 + 4 * 4);
INSTANTIATE_TEST_SUITE_P(Culling, Rooms,
                         testing::Values(Inside{"culled_from_outside", four_walls, 1, 6},
                                         Inside{"clockwise_from_outside", four_walls, 1, 5},
                                         Inside{"eye_in_it", four_walls, 1, 5},
                                         Inside{"culled_room", four_walls, 1, 6},
                                         Inside{"two_rooms", 2 * four_walls - 12 - 2, 2, 10},
                                         Inside{"cavern", ball_area(2.8), 1, 6}),
                         [](const auto& info) { return std::string(info.param.way); });

} // namespace
} // namespace glcast::test
