// Textures against bodies in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <tbb/global_control.h>

#include "tests/texture/baked.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/texture/bake.h"

namespace glcast::test {
namespace {

const glm::vec3 corner_weights[] = {{0.34f, 0.33f, 0.33f}, {0.8f, 0.1f, 0.1f}, {0.1f, 0.8f, 0.1f},
                                    {0.1f, 0.1f, 0.8f},    {0.5f, 0.5f, 0},    {0, 0.5f, 0.5f},
                                    {0.5f, 0, 0.5f}};
constexpr double radius = 0.8;
const glm::dvec3 centre(0.05, -0.02, 0.03);

/// Waves a quarter of the sphere long: much finer than 500 triangles.
glm::vec3 waves(const glm::dvec3& at) {
    return glm::vec3(0.5 + 0.4 * std::sin(12 * at.x), 0.5 + 0.4 * std::sin(15 * at.y),
                     0.5 + 0.4 * std::sin(10 * at.z + 1));
}

Source waved_sphere(int n) {
    auto images = cast_body(*sphere(centre, radius), test_box, n);
    paint(images, test_box, [](const glm::dvec3& at, const glm::vec3&) { return waves(at); });
    return make_source(images);
}

glm::dvec3 point_of(const Mesh& mesh, std::size_t t, const glm::vec3& w) {
    const Triangle& v = mesh.triangles[t];
    return double(w.x) * mesh.positions[v[0]] + double(w.y) * mesh.positions[v[1]] +
           double(w.z) * mesh.positions[v[2]];
}

struct Error {
    double colour = 0, worst_colour = 0, normal = 0, worst_normal = 0;
};
/// Of a waved sphere's level, against the point of the sphere above or below each of its own.
Error error_of(const Mesh& mesh, const Texture& texture) {
    Error error;
    double count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const glm::vec3& w : corner_weights) {
            const Shown seen = shown_at(mesh, texture, t, w);
            const glm::dvec3 out = glm::normalize(point_of(mesh, t, w) - centre);
            const glm::vec3 off = glm::abs(seen.colour - waves(centre + radius * out));
            const double colour = std::max({off.x, off.y, off.z}),
                         normal = degrees_between(seen.normal, glm::vec3(out));
            error.colour += colour, error.normal += normal, ++count;
            error.worst_colour = std::max(error.worst_colour, colour);
            error.worst_normal = std::max(error.worst_normal, normal);
        }
    error.colour /= count, error.normal /= count;
    return error;
}

TEST(Bake, FiveHundredTrianglesShowTheSphere) {
    const Source source = waved_sphere(128);
    Mesh mesh = coarse(source.full, 500);
    TextureReport report;
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512}, &report);
    const Error error = error_of(mesh, texture);
    RecordProperty("colour", std::to_string(error.colour));
    RecordProperty("normal", std::to_string(error.normal));
    EXPECT_LT(error.colour, 0.01);
    EXPECT_LT(error.worst_colour, 0.15);
    EXPECT_LT(error.normal, 0.6);
    EXPECT_LT(error.worst_normal, 10);
    EXPECT_LE(report.charts, 24u);
    EXPECT_LT(double(report.texels_unseen), 0.001 * double(report.texels));
    // and the vertices alone do not: the test could fail
    double alone = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const glm::vec3 flat = (mesh.colours[v[0]] + mesh.colours[v[1]] + mesh.colours[v[2]]) / 3.0f;
        const glm::dvec3 out = glm::normalize(point_of(mesh, t, glm::vec3(1 / 3.0f)) - centre);
        alone += glm::length(flat - waves(centre + radius * out)) / double(mesh.triangles.size());
    }
    EXPECT_GT(alone, 5 * error.colour);
}

TEST(Bake, TheFullSurfaceIsACropOfTheImages) {
    const Source source = waved_sphere(64);
    Mesh mesh = source.full;
    TextureReport report;
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512}, &report);
    EXPECT_EQ(report.texels_per_sample, 1);
    EXPECT_EQ(coverage(mesh, texture, charts_of(mesh, texture)).twice, 0u);
    const Error error = error_of(mesh, texture);
    EXPECT_LT(error.colour, 0.01);
    EXPECT_LT(error.normal, 0.5);
}

TEST(Bake, SeamsShowTheSameOnBothSides) {
    const Source source = waved_sphere(128);
    Mesh mesh = coarse(source.full, 500);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
    const auto charts = charts_of(mesh, texture);
    double colour = 0, normal = 0, count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t s = t + 1; s < mesh.triangles.size(); ++s) {
            if (charts[s] == charts[t]) continue;
            for (int k = 0; k < 3; ++k)
                for (int j = 0; j < 3; ++j) {
                    const Triangle &a = mesh.triangles[t], &b = mesh.triangles[s];
                    if (a[k] != b[(j + 1) % 3] || a[(k + 1) % 3] != b[j]) continue;
                    glm::vec3 w(0), u(0);
                    w[k] = u[(j + 1) % 3] = 0.4f, w[(k + 1) % 3] = u[j] = 0.6f;
                    const Shown here = shown_at(mesh, texture, t, w), there = shown_at(mesh, texture, s, u);
                    colour += glm::length(here.colour - there.colour);
                    normal += degrees_between(here.normal, there.normal);
                    ++count;
                }
        }
    ASSERT_GT(count, 20);
    EXPECT_LT(colour / count, 0.03);
    EXPECT_LT(normal / count, 1.5);
}

/// Distinct colours for the six sides of a turned box: each chart has one.
Source coloured_box(int n) {
    auto images = cast_body(*box({0, 0, 0}, {0.6, 0.5, 0.4}, turned({1, 2, 3}, 12)), test_box, n);
    paint(images, test_box, [](const glm::dvec3&, const glm::vec3& normal) {
        const glm::vec3 size = glm::abs(normal);
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        glm::vec3 colour(0.1f);
        colour[axis] = normal[axis] > 0 ? 0.9f : 0.5f;
        return colour;
    });
    return make_source(images);
}

TEST(Bake, SharpEdgesKeepTheColoursAndNormalsOfTheirSides) {
    const Source source = coloured_box(96);
    Mesh mesh = coarse(source.full, 60);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
    double off = 0, count = 0, colour = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 flat =
            glm::cross(mesh.positions[mesh.triangles[t][1]] - mesh.positions[mesh.triangles[t][0]],
                       mesh.positions[mesh.triangles[t][2]] - mesh.positions[mesh.triangles[t][0]]);
        if (glm::length(flat) < 0.01) continue; // slivers along an edge
        const glm::vec3 side(glm::normalize(flat));
        for (int k = 0; k < 4; ++k) {
            const Shown seen = shown_at(mesh, texture, t, corner_weights[k]);
            off += degrees_between(seen.normal, side);
            int axis = 0;
            for (int a = 1; a < 3; ++a)
                if (std::abs(side[a]) > std::abs(side[axis])) axis = a;
            glm::vec3 wanted(0.1f);
            wanted[axis] = side[axis] > 0 ? 0.9f : 0.5f;
            colour += glm::length(seen.colour - wanted);
            ++count;
        }
    }
    ASSERT_GT(count, 24);
    EXPECT_LT(off / count, 2);
    EXPECT_LT(colour / count, 0.01);
}

TEST(Bake, ABodyWithAllNormalsInwardKeepsThem) {
    const Source source = make_source(cast_body(*sphere(centre, radius), test_box, 64,
                                                [](auto&, const glm::dvec3& normal) { return -normal; }));
    Mesh mesh = coarse(source.full, 500);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 256});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3 out(glm::normalize(point_of(mesh, t, corner_weights[0]) - centre));
        EXPECT_LT(glm::dot(mesh.normals[mesh.triangles[t][0]], out), -0.8f);
        EXPECT_LT(degrees_between(shown_at(mesh, texture, t, corner_weights[0]).normal, -out), 10);
    }
}

TEST(Bake, ChartsAreApartAndCoverNothingTwice) {
    for (const double triangles : {300.0, 4000.0}) {
        const Source source = coloured_box(96);
        Mesh mesh = coarse(source.full, triangles);
        const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
        const auto charts = charts_of(mesh, texture);
        for (const auto& corners : texture.coordinates)
            for (const glm::vec2& p : corners) {
                EXPECT_GE(std::min(p.x, p.y) * 512, 4);
                EXPECT_LE(std::max(p.x, p.y) * 512, 508);
            }
        const Coverage covered = coverage(mesh, texture, charts);
        EXPECT_EQ(covered.twice, 0u);
        std::size_t close = 0;
        for (int y = 0; y < 512; ++y)
            for (int x = 0; x + 7 < 512; ++x) {
                const std::uint32_t own = covered.chart[std::size_t(y) * 512 + x];
                if (own == ~0u) continue;
                for (int dy = -7; dy <= 7; ++dy)
                    for (int dx = 0; dx <= 7; ++dx) {
                        if (y + dy < 0 || y + dy >= 512) continue;
                        const std::uint32_t other = covered.chart[std::size_t(y + dy) * 512 + x + dx];
                        close += other != ~0u && other != own;
                    }
            }
        EXPECT_EQ(close, 0u);
    }
}

TEST(Bake, GuttersHoldTheColourOfTheirChart) {
    const Source source = coloured_box(96);
    Mesh mesh = coarse(source.full, 60);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
    const Coverage covered = coverage(mesh, texture, charts_of(mesh, texture));
    const auto at = [&](int x, int y) {
        const std::uint8_t* p = &texture.colour.rgb[(std::size_t(y) * 512 + x) * 3];
        return glm::ivec3(p[0], p[1], p[2]);
    };
    std::size_t gutter = 0, foreign = 0;
    for (int y = 3; y < 509; ++y)
        for (int x = 3; x < 509; ++x) {
            if (covered.chart[std::size_t(y) * 512 + x] != ~0u) continue;
            bool near = false, same = false;
            for (int dy = -3; dy <= 3; ++dy)
                for (int dx = -3; dx <= 3; ++dx)
                    if (dx * dx + dy * dy <= 9 && covered.chart[std::size_t(y + dy) * 512 + x + dx] != ~0u) {
                        near = true;
                        same = same || glm::length(glm::vec3(at(x, y) - at(x + dx, y + dy))) < 8;
                    }
            gutter += near;
            foreign += near && !same;
        }
    ASSERT_GT(gutter, 1000u);
    EXPECT_EQ(foreign, 0u);
}

TEST(Bake, WhatLiesInsideDoesNotShine) {
    const auto shell = sphere({0, 0, 0}, 0.8, {1, 1, 0}), inner = sphere({0, 0, 0}, 0.76, {0, 0, 1});
    const Source source = make_source(cast_layers(*unite({shell, inner}), test_box, 96), true);
    Mesh mesh = coarse(source.full, 200);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 256});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const glm::vec3& w : corner_weights)
            EXPECT_LT(glm::length(shown_at(mesh, texture, t, w).colour - glm::vec3(1, 1, 0)), 0.01f);
}

/// A plate thinner than a sample, red above and green below.
TEST(Bake, TheSidesOfASheetKeepTheirColours) {
    auto images = cast_body(*box({0, 0, 0.001}, {0.7, 0.7, 1e-4}, turned({1, 0.3, 0}, 10)), test_box, 96);
    for (ViewImage& image : images)
        for (std::size_t p = 0; p < image.colour.size(); ++p)
            if (image.covered(p))
                image.colour[p] = image.normal[p].z > 0 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1);
    const Source source = make_source(images);
    Mesh mesh = coarse(source.full, 100);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
    double wrong = 0, count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 flat =
            glm::cross(mesh.positions[mesh.triangles[t][1]] - mesh.positions[mesh.triangles[t][0]],
                       mesh.positions[mesh.triangles[t][2]] - mesh.positions[mesh.triangles[t][0]]);
        if (std::abs(flat.z) < 0.7 * glm::length(flat)) continue; // the rim
        const glm::vec3 wanted = flat.z > 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        wrong += glm::length(flat) *
                 (glm::length(shown_at(mesh, texture, t, corner_weights[0]).colour - wanted) > 0.3f);
        count += glm::length(flat);
    }
    ASSERT_GT(count, 0);
    EXPECT_LT(wrong / count, 0.02);
}

TEST(Bake, TheSameOnAnyNumberOfThreads) {
    const Source source = waved_sphere(64);
    for (const double triangles : {1e9, 300.0}) {
        const Mesh level = triangles < 1e9 ? coarse(source.full, triangles) : source.full;
        std::vector<Texture> made;
        std::vector<Mesh> meshes;
        for (const std::size_t threads : {1, 2, 7}) {
            tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            meshes.push_back(level);
            made.push_back(bake_texture(meshes.back(), source.captured, {.size = 256}));
        }
        for (std::size_t k = 1; k < made.size(); ++k) {
            EXPECT_EQ(made[k].colour.rgb, made[0].colour.rgb);
            EXPECT_EQ(made[k].normal.rgb, made[0].normal.rgb);
            EXPECT_TRUE(made[k].coordinates == made[0].coordinates);
            EXPECT_TRUE(made[k].tangents == made[0].tangents);
            EXPECT_TRUE(meshes[k].normals == meshes[0].normals);
        }
    }
}

Mesh tetrahedron(double size) {
    Mesh mesh;
    mesh.positions = {{size, size, size}, {size, -size, -size}, {-size, size, -size}, {-size, -size, size}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

void expect_usable(const Mesh& mesh, const Texture& texture) {
    ASSERT_EQ(texture.coordinates.size(), mesh.triangles.size());
    ASSERT_EQ(texture.tangents.size(), mesh.triangles.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const glm::vec4& tangent = texture.tangents[t][k];
            EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1, 1e-4);
            EXPECT_NEAR(glm::dot(glm::vec3(tangent), mesh.normals[mesh.triangles[t][k]]), 0, 1e-4);
            EXPECT_EQ(std::abs(tangent.w), 1);
            for (int c = 0; c < 2; ++c) {
                EXPECT_GE(texture.coordinates[t][k][c], 0);
                EXPECT_LE(texture.coordinates[t][k][c], 1);
            }
        }
}

TEST(Bake, TakesATetrahedronWithoutNormalsOrColours) {
    const Source source = waved_sphere(64);
    for (const double size : {0.46, 0.1, 3.0}) { // on the sphere, deep inside, beyond the box
        Mesh mesh = tetrahedron(size);
        expect_usable(mesh, bake_texture(mesh, source.captured, {.size = 64}));
    }
}

TEST(Bake, TakesTrianglesWithoutArea) {
    const Source source = waved_sphere(64);
    Mesh mesh = tetrahedron(0.46);
    // edge 0 - 1 split by a vertex that lies on vertex 0: two triangles without area
    mesh.positions.push_back(mesh.positions[0]);
    mesh.triangles = {{4, 1, 2}, {0, 4, 2}, {0, 3, 4}, {4, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    expect_usable(mesh, bake_texture(mesh, source.captured, {.size = 64}));
}

TEST(Bake, UnlitPartsGetTheSurfacesNormals) {
    auto images = cast_body(*sphere(centre, radius), test_box, 96);
    for (ViewImage& image : images)
        for (glm::vec4& normal : image.normal) normal = glm::vec4(0);
    paint(images, test_box, [](const glm::dvec3& at, const glm::vec3&) { return waves(at); });
    const Source source = make_source(images);
    Mesh mesh = coarse(source.full, 500);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
    EXPECT_LT(error_of(mesh, texture).normal, 2);
}

TEST(Bake, UnseenPartsKeepTheColoursOfTheVertices) {
    const Source source = waved_sphere(64);
    Mesh mesh = tetrahedron(0.1); // nothing is near it
    mesh.colours.assign(4, glm::vec3(0.25f, 0.5f, 0.75f));
    TextureReport report;
    const Texture texture = bake_texture(mesh, source.captured, {.size = 64}, &report);
    ASSERT_GT(report.texels, 0u);
    EXPECT_EQ(report.texels_unseen, report.texels);
    EXPECT_LT(glm::length(shown_at(mesh, texture, 0, corner_weights[0]).colour - mesh.colours[0]), 0.01f);
}

TEST(Bake, SaysWhatIsWrong) {
    const Source source = waved_sphere(32);
    Mesh mesh = tetrahedron(0.4), none;
    for (const int size : {0, 63, 100, 16384})
        EXPECT_THROW(bake_texture(mesh, source.captured, {.size = size}), std::runtime_error);
    EXPECT_THROW(bake_texture(mesh, source.captured, {.gutter = 1}), std::runtime_error);
    EXPECT_THROW(bake_texture(none, source.captured, {}), std::runtime_error);
    EXPECT_THROW(bake_texture(mesh, {}, {}), std::runtime_error);
}

TEST(CapturedSurface, IsFoundAlongALine) {
    const Source source = waved_sphere(64);
    std::mt19937 random(7);
    std::normal_distribution<double> any;
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
        const glm::dvec3 out = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        const double height =
            std::uniform_real_distribution<double>(-3, 3)(random) * source.captured.sample();
        const CapturedPoint found =
            source.captured.find(centre + (radius + height) * out, glm::vec3(out), glm::vec3(out), 6);
        ASSERT_TRUE(found.found);
        worst =
            std::max(worst, glm::distance(found.position, centre + radius * out) / source.captured.sample());
    }
    EXPECT_LT(worst, 0.1);
    EXPECT_FALSE(CapturedSurface().find({}, {0, 0, 1}, {0, 0, 1}, 6).found);
}

} // namespace
} // namespace glcast::test
