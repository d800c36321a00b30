// Colours and normals of the vertices.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/reconstruct/cast.h"

namespace glcast::test {
namespace {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

double mean_normal_error(const Mesh& mesh, const glm::dvec3& centre, double sign) {
    double sum = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        sum += degrees_between(mesh.normals[v], sign * (mesh.positions[v] - centre));
    return sum / double(mesh.positions.size());
}

TEST(Attributes, OneColourComesOutExactly) {
    const glm::vec3 colour(0.25f, 0.5f, 0.8f);
    for (const auto& body :
         {torus({0, 0, 0}, {1, 2, 3}, 0.6, 0.25, colour), torus({0, 0, 0}, {0, 0, 1}, 0.6, 0.25, colour)})
        for (SurfaceMethod method : {SurfaceMethod::contour, SurfaceMethod::cubes}) {
            const Cast made = cast(*body, 48, {method});
            float off = 0;
            for (const glm::vec3& c : made.mesh.colours)
                for (int k = 0; k < 3; ++k) off = std::max(off, std::abs(c[k] - colour[k]));
            EXPECT_LT(off, 1e-5f);
        }
}

TEST(Attributes, NormalsAreTheDrawnOnes) {
    const glm::dvec3 centre(0.1, 0, -0.05);
    const auto body = sphere(centre, 0.8);
    const Cast made = cast(*body, 64);
    EXPECT_LT(mean_normal_error(made.mesh, centre, 1), 0.1);
    for (const glm::vec3& normal : made.mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-4);
}

TEST(Attributes, InvalidNormalsStayAsDrawnOrAreRecomputed) {
    const auto body = sphere({0, 0, 0}, 0.8);
    const auto inwards = [](auto&, const glm::dvec3& normal) { return -3.0 * normal; };
    EXPECT_LT(mean_normal_error(cast(*body, 64, {}, inwards).mesh, {}, -1), 0.1);
    ReconstructOptions options;
    options.geometric_normals = true;
    EXPECT_LT(mean_normal_error(cast(*body, 64, options, inwards).mesh, {}, 1), 0.5);
}

TEST(Attributes, DrawnNormalsThatDisagreeAreMeasured) {
    const auto body = sphere({0, 0, 0}, 0.8);
    const auto share = [&](const NormalEdit& edit, const ReconstructOptions& options = {}) {
        return cast(*body, 48, options, edit).report.disagreeing_normals_share;
    };
    EXPECT_EQ(share({}), 0);
    const auto turned_over_above = [](double height) {
        return [=](const glm::dvec3& at, const glm::dvec3& normal) { return at.y > height ? -normal : normal; };
    };
    EXPECT_NEAR(share(turned_over_above(0)), 0.5, 0.03);
    EXPECT_NEAR(share(turned_over_above(0.4)), 0.25, 0.03) << "Archimedes' hat box";
    EXPECT_NEAR(share(turned_over_above(-1)), 1, 0.01);
    ReconstructOptions geometric;
    geometric.geometric_normals = true;
    EXPECT_NEAR(share(turned_over_above(0), geometric), 0.5, 0.03) << "what was drawn is told all the same";
    const auto leaning = [](double degrees) {
        return [=](const glm::dvec3&, const glm::dvec3& normal) {
            const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8)));
            const double angle = glm::radians(degrees);
            return std::cos(angle) * normal + std::sin(angle) * across;
        };
    };
    EXPECT_LT(share(leaning(50)), 0.01) << "as coarse facets do, shaded smoothly";
    EXPECT_GT(share(leaning(70)), 0.95);
}

TEST(Attributes, UnlitPartsGetTheSurfacesNormals) {
    const auto body = sphere({0, 0, 0}, 0.8);
    auto images = cast_body(*body, test_box, 48);
    for (ViewImage& image : images)
        for (glm::vec4& normal : image.normal) normal = glm::vec4(0);
    EXPECT_LT(mean_normal_error(cast(images).mesh, {}, 1), 1.0);
}

TEST(Attributes, PartsKeepTheirColoursToTheSeam) {
    const int n = 96;
    const auto red = sphere({-0.3, 0, 0}, 0.5, {1, 0, 0}), blue = sphere({0.3, 0.05, 0}, 0.5, {0, 0, 1});
    const Cast made = cast(*unite({red, blue}), n);
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < made.mesh.positions.size(); ++v) {
        const glm::dvec3& p = made.mesh.positions[v];
        const double to_red = std::abs(red->distance(p)), to_blue = std::abs(blue->distance(p));
        if (std::abs(to_red - to_blue) < 1.5 * sample_size(n)) continue;
        const glm::vec3 wanted = to_red < to_blue ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
        wrong += glm::distance(made.mesh.colours[v], wanted) > 1.0f / 255;
    }
    EXPECT_LE(wrong, made.mesh.positions.size() / 500);
}

TEST(Attributes, AHiddenPartDoesNotBleed) {
    const auto shell = sphere({0, 0, 0}, 0.8, {1, 1, 0}), inner = sphere({0, 0, 0}, 0.78, {0, 0, 1});
    const Cast made = cast(*unite({shell, inner}), 64);
    for (const glm::vec3& c : made.mesh.colours) EXPECT_LT(glm::distance(c, glm::vec3(1, 1, 0)), 1e-5f);
}

} // namespace
} // namespace glcast::test
