// Normals and colours by corner, on bodies known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <tbb/global_control.h>

#include "tests/texture/baked.h"
#include "tools/mesh/check.h"
#include "tools/render/raster.h"
#include "tools/texture/views.h"
#include "tools/texture/wedge_fit.h"

namespace glcast::test {
namespace {

constexpr int n = 96;
const glm::dvec3 half(0.6, 0.5, 0.4);
const glm::dmat3 turn = turned({1, 2, 3}, 12);

Level level_of(Mesh mesh, const Source& source) {
    Level level;
    level.mesh = std::move(mesh);
    level.mesh.normals.assign(level.mesh.positions.size(), glm::vec3(0, 0, 1));
    level.mesh.colours.assign(level.mesh.positions.size(), glm::vec3(0.5f));
    level.sample = source.captured.sample();
    return level;
}

/// A quad of the box's side: its corners counter-clockwise from outside.
void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
}

/// The box from x = -1 to `middle` to 1 in its own axes: 12 vertices, 20 triangles.
Mesh box_in_two(double middle) {
    Mesh mesh;
    for (const double x : {-1.0, middle, 1.0})
        for (const auto& [y, z] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
            mesh.positions.push_back(turn * (half * glm::dvec3(x, y, z)));
    add_quad(mesh, 0, 3, 2, 1);
    add_quad(mesh, 8, 9, 10, 11);
    for (std::uint32_t slab : {0u, 4u})
        for (std::uint32_t k = 0; k < 4; ++k)
            add_quad(mesh, slab + k, slab + (k + 1) % 4, slab + 4 + (k + 1) % 4, slab + 4 + k);
    return mesh;
}

Mesh plain_box() {
    Mesh mesh = box_in_two(0), out;
    for (std::uint32_t v : {0, 1, 2, 3, 8, 9, 10, 11}) out.positions.push_back(mesh.positions[v]);
    add_quad(out, 0, 3, 2, 1);
    add_quad(out, 4, 5, 6, 7);
    for (std::uint32_t k = 0; k < 4; ++k) add_quad(out, k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k);
    return out;
}

glm::vec3 side_colour(const glm::vec3& normal) {
    const glm::vec3 own = glm::transpose(glm::mat3(turn)) * normal;
    return {own.x > 0.5f ? 1 : own.x < -0.5f ? 0 : 0.5f, own.y > 0.5f ? 1 : own.y < -0.5f ? 0 : 0.5f,
            own.z > 0.5f ? 1 : own.z < -0.5f ? 0 : 0.5f};
}

Source painted_box(const Paint& colour, const NormalEdit& edit = {}) {
    auto images = cast_body(*box({0, 0, 0}, half, turn), test_box, n, edit);
    paint(images, test_box, colour);
    return make_source(images);
}

float largest_difference(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 off = glm::abs(a - b);
    return std::max({off.x, off.y, off.z});
}

bool same(const Wedges& a, const Wedges& b) {
    return a.corners == b.corners && a.normals == b.normals && a.colours == b.colours;
}

TEST(Wedges, ACubeHasTwentyFour) {
    const Source source = painted_box([](const glm::dvec3&, const glm::vec3& normal) { return side_colour(normal); });
    Level level = level_of(plain_box(), source);
    const Mesh before = level.mesh;
    fit_wedges(level, source.captured);
    EXPECT_EQ(level.mesh.positions, before.positions);
    EXPECT_EQ(level.mesh.triangles, before.triangles);
    ASSERT_TRUE(fits(level.mesh, level.wedges));
    EXPECT_EQ(level.wedges.normals.size(), 24u);
    const auto normals = triangle_normals(level.mesh);
    for (std::size_t t = 0; t < normals.size(); ++t) {
        for (const glm::vec3& normal : corner_normals(level.mesh, level.wedges, t))
            EXPECT_LT(degrees_between(normal, normals[t]), 0.5) << t;
        for (const glm::vec3& colour : corner_colours(level.mesh, level.wedges, t))
            EXPECT_LT(largest_difference(colour, side_colour(normals[t])), 0.02f) << t;
    }
}

TEST(Wedges, ACylinderIsSmoothButForItsRims) {
    constexpr int sides = 24;
    constexpr double radius = 0.6, height = 0.5;
    const Source source = make_source(cast_body(*cylinder({0, 0, 0}, {0, 0, 1}, radius, height), test_box, n));
    Mesh mesh;
    for (const double z : {-height, height})
        for (int k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
        }
    mesh.positions.push_back({0, 0, -height});
    mesh.positions.push_back({0, 0, height});
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t next = (k + 1) % sides;
        add_quad(mesh, k, next, sides + next, sides + k);
        mesh.triangles.push_back({next, k, 2 * sides});
        mesh.triangles.push_back({sides + k, sides + next, 2 * sides + 1});
    }
    Level level = level_of(std::move(mesh), source);
    fit_wedges(level, source.captured);
    EXPECT_EQ(level.wedges.normals.size(), 2u * 2 * sides + 2);
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
        const auto normals = corner_normals(level.mesh, level.wedges, t);
        const auto faces = triangle_normals(level.mesh);
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 at(level.mesh.positions[level.mesh.triangles[t][k]]);
            const glm::vec3 wanted = std::abs(faces[t].z) > 0.9f ? faces[t] : glm::vec3(at.x, at.y, 0);
            EXPECT_LT(degrees_between(normals[k], wanted), 2) << t;
        }
    }
}

TEST(Wedges, ASphereHasNone) {
    const Source source = make_source(cast_body(*sphere({0, 0, 0}, 0.8), test_box, n));
    for (const double triangles : {60.0, 400.0}) {
        Level level = level_of(coarse(source.full, triangles), source);
        fit_wedges(level, source.captured);
        EXPECT_TRUE(level.wedges.empty()) << triangles;
        double sum = 0;
        for (std::size_t v = 0; v < level.mesh.positions.size(); ++v)
            sum += degrees_between(level.mesh.normals[v], glm::vec3(level.mesh.positions[v]));
        EXPECT_LT(sum / double(level.mesh.positions.size()), triangles < 100 ? 4 : 1) << triangles;
    }
}

TEST(Wedges, ColoursThatMeetOnAPlaneAreApart) {
    const double middle = 0.2;
    const glm::vec3 red(1, 0, 0), green(0, 0.5f, 0);
    const Source source = painted_box([&](const glm::dvec3& at, const glm::vec3&) {
        return (glm::transpose(turn) * at).x < middle * half.x ? red : green;
    });
    Level level = level_of(box_in_two(middle), source);
    fit_wedges(level, source.captured);
    ASSERT_TRUE(fits(level.mesh, level.wedges));
    // Three normals at each corner of the box; on the line two normals and on both two colours.
    EXPECT_EQ(level.wedges.normals.size(), 8u * 3 + 4u * 4);
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
        glm::dvec3 centre(0);
        for (const std::uint32_t v : level.mesh.triangles[t]) centre += level.mesh.positions[v] / 3.0;
        const glm::vec3 wanted = (glm::transpose(turn) * centre).x < middle * half.x ? red : green;
        for (const glm::vec3& colour : corner_colours(level.mesh, level.wedges, t))
            EXPECT_LT(largest_difference(colour, wanted), 0.06f) << t;
    }
}

/// A program's wrong normals: one side has them inward, the others at 80 degrees.
TEST(Wedges, NoNormalIsSquareToItsTriangle) {
    const glm::vec3 up(turn[2]);
    const Source source =
        painted_box([](const glm::dvec3&, const glm::vec3&) { return glm::vec3(1); },
                    [&](const glm::dvec3&, const glm::dvec3& normal) {
                        if (glm::dot(glm::vec3(normal), up) > 0.9f) return -normal;
                        const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0.6, 0.7, 0.4)));
                        return glm::normalize(normal + std::tan(glm::radians(80.0)) * across);
                    });
    Level level = level_of(plain_box(), source);
    const WedgeOptions options;
    fit_wedges(level, source.captured, options);
    const auto normals = triangle_normals(level.mesh);
    for (std::size_t t = 0; t < normals.size(); ++t)
        for (const glm::vec3& normal : corner_normals(level.mesh, level.wedges, t)) {
            EXPECT_NEAR(glm::length(normal), 1, 1e-4);
            const double off = degrees_between(normal, normals[t]);
            if (glm::dot(normals[t], up) > 0.9f)
                EXPECT_GT(off, 179) << t; // as drawn
            else
                EXPECT_NEAR(off, options.farthest_degrees, 0.1) << t;
        }
}

TEST(Wedges, WhereNothingWasCapturedVerticesKeepTheirOwn) {
    const Source source = painted_box([](const glm::dvec3&, const glm::vec3&) { return glm::vec3(1); });
    Level level = level_of(plain_box(), source);
    for (glm::dvec3& p : level.mesh.positions) p += 40.0;
    for (glm::vec3& normal : level.mesh.normals) normal = glm::normalize(glm::vec3(1));
    fit_wedges(level, source.captured);
    for (const glm::vec3& colour : level.mesh.colours) EXPECT_LT(largest_difference(colour, glm::vec3(0.5f)), 1e-4f);
    Level untouched = level;
    fit_wedges(untouched, CapturedSurface());
    EXPECT_EQ(untouched.mesh.colours, level.mesh.colours);
}

/// A box and a sphere of another colour that sticks out of it.
Source two_bodies() {
    return make_source(cast_layers(*unite({box({-0.2, 0, 0}, {0.5, 0.45, 0.4}, turn, {0.2f, 0.3f, 0.9f}),
                                           sphere({0.35, 0, 0}, 0.5, {0.9f, 0.5f, 0.1f})}),
                                   test_box, n),
                       true);
}

TEST(Wedges, AreTheSameOnAnyNumberOfThreads) {
    const Source source = two_bodies();
    Level one = level_of(coarse(source.full, 600), source), more = one;
    {
        const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        fit_wedges(one, source.captured);
    }
    fit_wedges(more, source.captured);
    ASSERT_FALSE(one.wedges.empty());
    EXPECT_TRUE(same(one.wedges, more.wedges));
    EXPECT_EQ(one.mesh.normals, more.mesh.normals);
    EXPECT_EQ(one.mesh.colours, more.mesh.colours);
}

OrthoView view_along(const glm::dvec3& towards) {
    OrthoView view;
    view.back = glm::normalize(towards);
    view.right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), view.back));
    view.up = glm::cross(view.back, view.right);
    view.width = view.height = 128;
    view.pixel = 2.0 / view.width;
    return view;
}

/// Decibels of lit pictures, where both cover.
double likeness(const Level& a, const Level& b) {
    double sum = 0;
    std::size_t values = 0;
    for (const glm::dvec3 towards : {glm::dvec3(1, 0.7, 0.4), glm::dvec3(-0.5, 1, -0.8), glm::dvec3(0.3, -0.6, 1)}) {
        const OrthoView view = view_along(towards);
        const SeenImage left = rasterise(a, view), right = rasterise(b, view);
        const auto lit = [&](const SeenImage& image, std::size_t p) {
            return image.colour[p] * (0.3f + 0.7f * std::max(0.0f, glm::dot(image.normal[p], glm::vec3(view.back))));
        };
        for (std::size_t p = 0; p < left.covered.size(); ++p) {
            if (!left.covered[p] || !right.covered[p]) continue;
            const glm::vec3 off = lit(left, p) - lit(right, p);
            sum += double(glm::dot(off, off)), values += 3;
        }
    }
    return -10 * std::log10(sum / double(values));
}

TEST(Wedges, LookMoreLikeTheSurfaceThanVerticesDo) {
    const Source source = two_bodies();
    Level full, nearest;
    full.mesh = source.full;
    nearest.mesh = coarse(source.full, 400);
    Level fitted = nearest;
    fit_wedges(fitted, source.captured);
    const double before = likeness(nearest, full), after = likeness(fitted, full);
    EXPECT_GT(after, before + 3) << "from " << before;
    EXPECT_LT(fitted.wedges.normals.size(), 2 * fitted.mesh.positions.size());
    RecordProperty("before", std::to_string(before));
    RecordProperty("after", std::to_string(after));
}

} // namespace
} // namespace glcast::test
