// What is seen from within: the free space in which an eye stands is outside, also where walls close it off.
#include "tests/reconstruct/cast.h"
#include "tests/reconstruct/hollow_bodies.h"
#include "tests/reconstruct/mesh_layers.h"

namespace glcast::test {
namespace {

constexpr int n = 96;

ReconstructOptions seen_from(std::vector<glm::dvec3> eyes) {
    ReconstructOptions how;
    how.eyes = std::move(eyes);
    return how;
}

double volume(const Body& body, const ReconstructOptions& how) {
    return topology(cast_deep(body, n, how).mesh).volume;
}

BodyPtr turned_box(const glm::dvec3& centre, const glm::dvec3& half) {
    const glm::dmat3 turn = turned({1, 2, 3}, 20);
    return box(turn * centre, half, turn);
}

/// Walls as thick as told, a cupboard at one and a ball on the floor.
struct Room {
    double thickness;
    glm::dvec3 half{0.6, 0.5, 0.55};
    double ball = 0.12;
    glm::dvec3 cupboard{0.1, 0.2, 0.15};

    BodyPtr body() const {
        const BodyPtr walls = subtract(turned_box({0, 0, 0}, half), turned_box({0, 0, 0}, half - thickness));
        const glm::dvec3 corner = -(half - thickness) + cupboard;
        const glm::dvec3 on_floor = turned({1, 2, 3}, 20) * glm::dvec3(0.2, 0.1, -half.z + thickness + ball);
        return unite({walls, turned_box(corner, cupboard), sphere(on_floor, ball)});
    }
    static double of_box(const glm::dvec3& h) { return 8 * h.x * h.y * h.z; }
    double whole() const { return of_box(half); }
    double matter() const {
        return whole() - of_box(half - thickness) + of_box(cupboard) + 4.0 / 3 * M_PI * std::pow(ball, 3);
    }
};

TEST(Inside, ARoomWithTheEyeInItIsARoom) {
    for (const double thickness : {0.03, 0.1}) {
        const Room room{thickness};
        const BodyPtr body = room.body();
        EXPECT_NEAR(volume(*body, {}), room.whole(), 0.01 * room.whole());
        const Cast made = cast_deep(*body, n, seen_from({{-0.1, 0.1, 0.1}}));
        EXPECT_TRUE(topology(made.mesh).closed());
        EXPECT_NEAR(topology(made.mesh).volume, room.matter(), 0.02 * room.matter()) << thickness;
        EXPECT_LT(mesh_to_body(made.mesh, *body, sample_size(n)).mean, 0.01) << thickness;
    }
}

TEST(Inside, AnEyeAtAWallStandsInItsRoom) {
    const Room room{0.1};
    const glm::dvec3 at =
        turned({1, 2, 3}, 20) * glm::dvec3(room.half.x - room.thickness - 1.5 * sample_size(n), 0, 0.2);
    EXPECT_NEAR(volume(*room.body(), seen_from({at})), room.matter(), 0.02 * room.matter());
}

TEST(Inside, CavernsAreOpenAsFarAsTheyHangTogether) {
    const glm::dvec3 along(0.6, 0.64, 0.48);
    const BodyPtr rock = box({0, 0, 0}, glm::dvec3(0.9));
    const auto ball = [](const glm::dvec3& at, double r) { return sphere(at, r); };
    const BodyPtr joined =
        unite({ball(along * -0.45, 0.3), ball(along * 0.45, 0.25), cylinder({0, 0, 0}, along, 0.1, 0.4)});
    const BodyPtr alone = ball({0.5, -0.5, 0}, 0.2);
    const BodyPtr body = subtract(rock, unite({joined, alone}));
    const double whole = std::pow(1.8, 3);
    EXPECT_NEAR(volume(*body, {}), whole, 1e-3);
    const Cast made = cast_deep(*body, n, seen_from({along * -0.5}));
    // Two balls, and the pipe without what of it lies in them, by its shell of caps.
    const double balls = 4.0 / 3 * M_PI * (std::pow(0.3, 3) + std::pow(0.25, 3));
    const auto reach = [](double r) { return 0.45 - std::sqrt(r * r - 0.01); };
    const auto cap = [](double r) {
        const double h = r - std::sqrt(r * r - 0.01);
        return M_PI * h * h * (3 * r - h) / 3;
    };
    const double pipe = M_PI * 0.01 * (reach(0.3) + reach(0.25)) - cap(0.3) - cap(0.25);
    EXPECT_NEAR(topology(made.mesh).volume, whole - balls - pipe, 2e-3);
    EXPECT_LT(mesh_to_body(made.mesh, *body, sample_size(n)).mean, 0.01);
    EXPECT_NEAR(volume(*body, seen_from({{0.5, -0.5, 0}})), whole - 4.0 / 3 * M_PI * 0.008, 1e-3);
}

TEST(Inside, WallsOfNoThicknessAreSheets) {
    Mesh walls;
    for (int c = 0; c < 8; ++c) {
        const glm::dvec3 corner(c & 1 ? .5 : -.5, c & 2 ? .6 : -.6, c & 4 ? .4 : -.4);
        walls.positions.push_back(turned({1, 2, 3}, 37) * corner);
    }
    walls.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const Box around = box_around(walls, n);
    ReconstructOptions how = seen_from({{0.1, 0.1, -0.1}});
    how.complete_layers = true;
    const Topology found = topology(reconstruct(cast_mesh(walls, around, n), around, how));
    const double area = 2 * (1 * 1.2 + 1.2 * 0.8 + 0.8 * 1), sample = around.size / n;
    EXPECT_TRUE(found.closed());
    EXPECT_EQ(found.components, 2u); // the outer and the inner side
    EXPECT_EQ(found.euler, 4);
    EXPECT_NEAR(found.volume / area / sample, how.sheet_thickness, 0.25 * how.sheet_thickness);
}

TEST(Inside, AHiddenChamberOpensForTheEyeInIt) {
    for (const HollowBody& each : hollow_bodies()) {
        if (each.name != "bottle") continue;
        const double filled = volume(*each.body, {});
        const Cast made = cast_deep(*each.body, n, seen_from({{0, 0, 0}}));
        EXPECT_EQ(made.report.hidden_samples, 0u);
        EXPECT_LT(topology(made.mesh).volume, 0.6 * filled);
        EXPECT_LT(mesh_to_body(made.mesh, *each.body, sample_size(n)).mean, 0.02);
    }
}

TEST(Inside, AnEyeThatIsOutsideChangesNothing) {
    for (const HollowBody& each : hollow_bodies()) {
        if (each.name != "bottle" && each.name != "cup" && each.name != "sphere_in_box") continue;
        const auto images = cast_layers(*each.body, test_box, 64);
        ReconstructOptions how;
        how.complete_layers = true;
        const Mesh plain = reconstruct(images, test_box, how);
        how.eyes = {{7, 8, 90}, {1e300, 0, -1e300}, {-0.95, -0.95, -0.95}, {0.95, -0.9, 0.9}};
        const Mesh seen = reconstruct(images, test_box, how);
        EXPECT_EQ(seen.positions, plain.positions) << each.name;
        EXPECT_EQ(seen.triangles, plain.triangles) << each.name;
        EXPECT_EQ(seen.colours, plain.colours) << each.name;
    }
}

} // namespace
} // namespace glcast::test
