// Simplification as a whole: its log, threads, colours, and bodies that nobody made by hand.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "tests/mesh/bodies.h"
#include "tests/mesh/independent_check/oracle.h"
#include "tests/reconstruct/bodies.h"
#include "tests/reconstruct/random_bodies.h"
#include "tools/deviation/deviation.h"
#include "tools/mesh/check.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/simplify/simplify.h"

namespace glcast::test {
namespace {

using Unit = SimplifyTarget::Unit;

template <typename T> bool equal(const std::vector<T>& x, const std::vector<T>& y) {
    return x.size() == y.size() && (x.empty() || !std::memcmp(x.data(), y.data(), x.size() * sizeof(T)));
}
bool same(const Mesh& a, const Mesh& b) {
    return equal(a.positions, b.positions) && equal(a.normals, b.normals) && equal(a.colours, b.colours) &&
           equal(a.triangles, b.triangles);
}

/// In stripes of two colours.
Mesh striped_torus(int around, int across) {
    Mesh made = torus(2, 0.7, around, across);
    paint(made, [](const glm::dvec3& p) {
        return std::sin(7 * std::atan2(p.y, p.x)) > 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    });
    return made;
}

/// Large enough to be cut into tiles: 300,000 triangles.
const Mesh& large_torus() {
    static const Mesh mesh = striped_torus(548, 274);
    return mesh;
}

void expect_log_leads_to_levels(const Mesh& mesh, std::vector<SimplifyTarget> targets,
                                bool boundaries = false) {
    CollapseLog log;
    const SimplifyOptions options{.allow_boundaries = boundaries, .refit = false};
    const std::vector<Mesh> levels = simplify_levels(mesh, targets, options, &log);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        // Every collapse takes one vertex. A level keeps vertices without triangles too.
        const std::size_t count = mesh.positions.size() - levels[k].positions.size();
        ASSERT_LE(count, log.size());
        EXPECT_TRUE(same(levels[k], collapsed(mesh, log, count))) << k;
        if (count == 0) continue;
        const MeshCheck before = check_mesh(collapsed(mesh, log, count - 1)), after = check_mesh(levels[k]);
        const double value = targets[k].value;
        const bool edges = targets[k].unit == Unit::edges;
        EXPECT_GT(double(edges ? before.edges : before.triangles), value) << "not the first that meets it";
        EXPECT_LE(double(edges ? after.edges : after.triangles), value);
    }
}

TEST(SimplifyLog, LeadsToEveryLevelBitForBit) {
    for (const NamedBody& body : bodies()) {
        SCOPED_TRACE(body.name);
        const double all = double(body.mesh.triangles.size());
        expect_log_leads_to_levels(body.mesh,
                                   {{Unit::triangles, std::floor(all / 2)}, {Unit::triangles, all / 5}});
    }
}

TEST(SimplifyLog, LeadsToLevelsThatARoundOfTilesPassesBy) {
    expect_log_leads_to_levels(large_torus(), {{Unit::triangles, 280'000},
                                               {Unit::edges, 400'000},
                                               {Unit::triangles, 100'001},
                                               {Unit::triangles, 1000}});
}

TEST(SimplifyLog, OfASurfaceWithBoundaries) {
    Mesh open = sphere(1, 4);
    open.triangles.resize(open.triangles.size() / 2);
    std::vector<std::uint32_t> number(open.positions.size(), UINT32_MAX);
    Mesh part;
    for (Triangle t : open.triangles) {
        for (std::uint32_t& v : t) {
            if (number[v] == UINT32_MAX)
                number[v] = std::uint32_t(part.positions.size()), part.positions.push_back(open.positions[v]);
            v = number[v];
        }
        part.triangles.push_back(t);
    }
    expect_log_leads_to_levels(part, {{Unit::edges, 1000}, {Unit::triangles, 100}}, true);
}

TEST(SimplifyLog, IsTheSameWhateverTheTargets) {
    CollapseLog some, all;
    const SimplifyTarget coarse[] = {{Unit::triangles, 2000}},
                         more[] = {{Unit::triangles, 260'000}, {Unit::triangles, 2000}};
    const SimplifyOptions options{.refit = false};
    const std::vector<Mesh> alone = simplify_levels(large_torus(), coarse, options, &some),
                            together = simplify_levels(large_torus(), more, options, &all);
    EXPECT_TRUE(same(alone[0], together[1]));
    ASSERT_EQ(some.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        ASSERT_TRUE(some[k].kept == all[k].kept && some[k].removed == all[k].removed &&
                    some[k].position == all[k].position)
            << k;
}

TEST(SimplifyTiles, AreTheSameOnAnyNumberOfThreads) {
    const SimplifyTarget targets[] = {{Unit::triangles, 200'000}, {Unit::triangles, 3000}};
    std::vector<Mesh> one, four;
    {
        const tbb::global_control cores(tbb::global_control::max_allowed_parallelism, 1);
        one = simplify_levels(large_torus(), targets);
    }
    {
        const tbb::global_control cores(tbb::global_control::max_allowed_parallelism, 4);
        four = simplify_levels(large_torus(), targets);
    }
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_TRUE(same(one[k], four[k])) << k;
}

double distance_to_torus(const glm::dvec3& p) {
    return std::abs(std::hypot(std::hypot(p.x, p.y) - 2, p.z) - 0.7);
}

// So many triangles that the first round only thins them.
TEST(SimplifyTiles, OfADenseSurfaceAreTheSameWhateverIsAskedAndNearTheTruth) {
    const Mesh mesh = striped_torus(1270, 635); // 1.6 million
    const SimplifyTarget coarse[] = {{Unit::triangles, 40'000}},
                         both[] = {{Unit::triangles, 1'300'000}, {Unit::triangles, 40'000}};
    CollapseLog log;
    std::vector<Mesh> levels, alone;
    {
        const tbb::global_control cores(tbb::global_control::max_allowed_parallelism, 1);
        levels = simplify_levels(mesh, both, {.refit = false}, &log);
    }
    {
        const tbb::global_control cores(tbb::global_control::max_allowed_parallelism, 4);
        alone = simplify_levels(mesh, coarse, {.refit = false});
    }
    EXPECT_TRUE(same(alone[0], levels[1]));
    for (const Mesh& level : levels)
        EXPECT_TRUE(same(level, collapsed(mesh, log, mesh.positions.size() - level.positions.size())));
    const double most[] = {2e-5, 7e-4};
    for (std::size_t k = 0; k < levels.size(); ++k) {
        EXPECT_TRUE(check_mesh(levels[k]).closed_manifold());
        EXPECT_EQ(levels[k].triangles.size(), both[k].value);
        for (const glm::dvec3& p : levels[k].positions) ASSERT_LT(distance_to_torus(p), most[k]);
        EXPECT_NEAR(check_mesh(levels[k]).volume, check_mesh(mesh).volume, 2e-5 * check_mesh(mesh).volume);
    }
}

TEST(SimplifyTiles, LeaveTheNormalsAloneInTheLastStretch) {
    Mesh mesh = large_torus();
    for (const glm::dvec3& p : mesh.positions)
        mesh.normals.push_back(glm::vec3(glm::normalize(p - 2.0 * glm::normalize(glm::dvec3(p.x, p.y, 0)))));
    const std::size_t all = mesh.triangles.size();
    const std::vector<std::vector<SimplifyTarget>> asked = {
        {},                                                                            // nothing to do
        {{Unit::triangles, double(all)}},                                              // nothing to collapse
        {{Unit::ratio, 1}, {Unit::ratio, 0.9}},                                        // rounds alone
        {{Unit::triangles, 2000}, {Unit::triangles, double(all)}, {Unit::ratio, 0.9}}, // both
    };
    for (const auto& targets : asked) {
        const std::vector<Mesh> alone = simplify_levels(mesh, targets);
        Mesh changed = mesh;
        int called = 0;
        const std::vector<Mesh> beside = simplify_levels(changed, targets, {.last_stretch = [&] {
                                                             ++called;
                                                             for (glm::vec3& n : changed.normals) n = -n;
                                                         }});
        EXPECT_EQ(called, 1);
        ASSERT_EQ(beside.size(), alone.size());
        for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_TRUE(same(beside[k], alone[k])) << k;
    }
}

TEST(SimplifyTiles, AreManifoldAndNearTheTruthAtEveryLevel) {
    const SimplifyTarget targets[] = {
        {Unit::triangles, 260'000}, {Unit::triangles, 100'000}, {Unit::triangles, 4000}};
    for (const Mesh& level : simplify_levels(large_torus(), targets)) {
        const MeshCheck check = check_mesh(level);
        EXPECT_TRUE(check.closed_manifold());
        EXPECT_EQ(check.euler, 0);
        EXPECT_EQ(ask_oracle(level).fault, "");
        // The best mesh of N triangles is off by some constant over N; how far is a vertex from the torus
        // itself?
        double most = 0;
        for (const glm::dvec3& p : level.positions)
            most = std::max(most, std::abs(std::hypot(std::hypot(p.x, p.y) - 2, p.z) - 0.7));
        EXPECT_LT(most, 60 / double(level.triangles.size()) + 2e-4) << level.triangles.size();
    }
}

TEST(SimplifyTiles, TurnNoTriangleOver) {
    const Mesh level = simplify(large_torus(), {Unit::triangles, 20'000}, {.refit = false});
    for (const Triangle& t : level.triangles) {
        const glm::dvec3 &a = level.positions[t[0]], &b = level.positions[t[1]], &c = level.positions[t[2]];
        const glm::dvec3 at = (a + b + c) / 3.0,
                         ring = glm::dvec3(at.x, at.y, 0) * (2 / std::hypot(at.x, at.y));
        EXPECT_GT(dot(normalize(cross(b - a, c - a)), normalize(at - ring)), 0.5);
    }
}

/// Share of the surface of `level` whose colour, by the nearest corner, is not the truth's.
double wrong_share(const Mesh& level, const std::function<glm::vec3(const glm::dvec3&)>& truth) {
    double wrong = 0, all = 0;
    for (const Triangle& t : level.triangles) {
        const glm::dvec3 &a = level.positions[t[0]], &b = level.positions[t[1]], &c = level.positions[t[2]];
        const double area = length(cross(b - a, c - a));
        constexpr int n = 12;
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                const double u = (i + 1 / 3.0) / n, v = (j + 1 / 3.0) / n;
                const glm::vec3 shown = level.colours[t[0]] * float(1 - u - v) +
                                        level.colours[t[1]] * float(u) + level.colours[t[2]] * float(v);
                const double off = length(shown - truth(a + u * (b - a) + v * (c - a)));
                wrong += area * std::min(1.0, off), all += area;
            }
    }
    return wrong / all;
}

TEST(SimplifyColours, BoundariesAcrossAPlaneStayCrisp) {
    // A cube with a diagonal stripe on its flat sides: nothing but colour says where the triangles should be.
    const auto colour = [](const glm::dvec3& p) {
        return std::abs(p.x + 0.6 * p.y + 0.2 * p.z) < 0.35 ? glm::vec3(1, 1, 0) : glm::vec3(0, 0, 0.5F);
    };
    Mesh mesh = cube(2, 100);
    paint(mesh, colour);
    const SimplifyTarget target{Unit::triangles, 1200};
    const Mesh with = simplify(mesh, target), without = simplify(mesh, target, {.colour_weight = 0});
    EXPECT_LT(wrong_share(with, colour), 0.5 * wrong_share(without, colour)); // measured: 0.30
    EXPECT_NEAR(check_mesh(with).volume, 8, 1e-5); // colours pull at the cube's edges, but hardly
    EXPECT_NEAR(check_mesh(with).area, 24, 2e-5);
    for (const glm::vec3& c : with.colours)
        EXPECT_TRUE(c == glm::vec3(1, 1, 0) || c == glm::vec3(0, 0, 0.5F));
}

TEST(SimplifyColours, OneColourChangesNothing) {
    Mesh plain = sphere(1, 5), painted = plain;
    paint(painted, [](const glm::dvec3&) { return glm::vec3(0.3F, 0.6F, 0.9F); });
    const SimplifyOptions options{.refit = false};
    const Mesh a = simplify(plain, {Unit::triangles, 700}, options),
               b = simplify(painted, {Unit::triangles, 700}, options);
    EXPECT_TRUE(equal(a.positions, b.positions));
    EXPECT_TRUE(equal(a.triangles, b.triangles));
}

TEST(SimplifyFuzz, RandomCastsAreManifoldAtEveryLevelAndTheLogLeadsThere) {
    const Box box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};
    for (unsigned seed = 1; seed <= 8; ++seed) {
        Dice dice(seed);
        ReconstructOptions how;
        how.complete_layers = true;
        Mesh mesh;
        try {
            mesh = reconstruct(cast_layers(*random_body(dice), box, 32), box, how);
        } catch (const std::runtime_error&) {
            continue; // nothing was hit
        }
        const double all = double(mesh.triangles.size());
        const SimplifyTarget targets[] = {{Unit::ratio, 0.5}, {Unit::ratio, 0.1}, {Unit::triangles, 0}};
        CollapseLog log;
        const std::vector<Mesh> levels = simplify_levels(mesh, targets, {.refit = seed % 2 == 0}, &log);
        const MeshCheck before = check_mesh(mesh);
        for (const Mesh& level : levels) {
            const MeshCheck check = check_mesh(level);
            EXPECT_TRUE(check.closed_manifold()) << seed;
            EXPECT_EQ(check.euler, before.euler) << seed;
            EXPECT_EQ(check.components, before.components) << seed;
            EXPECT_EQ(ask_oracle(level).fault, "") << seed;
            const Mesh replayed = collapsed(mesh, log, mesh.positions.size() - level.positions.size());
            EXPECT_TRUE(check_mesh(replayed).closed_manifold()) << seed;
            EXPECT_EQ(replayed.triangles.size(), level.triangles.size()) << seed;
        }
        EXPECT_LE(double(levels[0].triangles.size()), all / 2);
    }
}

} // namespace
} // namespace glcast::test
