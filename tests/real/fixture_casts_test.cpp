// The whole road with shapes known in closed form: a running program, its capture, its mesh, against the
// truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "fixtures/shapes.h"
#include "tests/real/cast_program.h"

namespace glcast::test {
namespace {

Cast cast_fixture(const std::string& shape) {
    Cast cast = cast_program(
        {.name = "fixture-" + shape, .command = {FIXTURE_GLX, "--shape", shape}, .n = 256, .levels = false});
    EXPECT_EQ(cast.error, "");
    EXPECT_TRUE(cast.manifold) << cast.oracle;
    EXPECT_EQ(cast.self_intersections, 0u);
    return cast;
}

/// Mean distances in samples, twice what docs/measured/results.md says.
struct Bound {
    double to_truth, from_truth;
};
constexpr Bound cube{2 * 0.00003, 2 * 0.00003}, spheres{2 * 0.0023, 2 * 0.0032}, torus{2 * 0.001, 2 * 0.001},
    teapot{2 * 0.032, 2 * 0.055};

Accuracy expect_close(const Cast& cast, const std::string& shape, const Bound& bound) {
    const Accuracy is = accuracy(cast, fixtures::truth(shape));
    EXPECT_EQ(is.error, "");
    EXPECT_LE(is.to_truth, bound.to_truth);
    EXPECT_LE(is.from_truth, bound.from_truth);
    std::cout << shape << ": mean distance, samples: cast to truth " << is.to_truth << ", truth to cast "
              << is.from_truth << '\n';
    return is;
}

/// A part of a shape in closed form.
struct Part {
    std::function<double(const glm::dvec3&)> distance; ///< outside positive
    std::function<glm::dvec3(const glm::dvec3&)> normal;
    glm::dvec3 colour;
};

glm::dvec3 vector(const nlohmann::json& json) { return {json.at(0), json.at(1), json.at(2)}; }

Part make_part(const nlohmann::json& json) {
    const glm::dvec3 centre = vector(json.at("centre"));
    Part part;
    part.colour = vector(json.at("colour")) / 255.0;
    if (json.at("kind") == "sphere") {
        const double radius = json.at("radius");
        part.distance = [=](const glm::dvec3& p) { return glm::distance(p, centre) - radius; };
        part.normal = [=](const glm::dvec3& p) { return glm::normalize(p - centre); };
        return part;
    }
    const double major = json.at("major_radius"), minor = json.at("minor_radius");
    const glm::dvec3 axis = vector(json.at("axis"));
    const auto from_ring = [=](const glm::dvec3& p) {
        const glm::dvec3 flat = p - centre - axis * glm::dot(p - centre, axis);
        return p - centre - glm::normalize(flat) * major;
    };
    part.distance = [=](const glm::dvec3& p) { return glm::length(from_ring(p)) - minor; };
    part.normal = [=](const glm::dvec3& p) { return glm::normalize(from_ring(p)); };
    return part;
}

std::vector<Part> closed_form(const std::string& shape) {
    std::vector<Part> parts;
    const auto description = nlohmann::json::parse(fixtures::describe(shape));
    for (const auto& part : description.at("parts")) {
        parts.push_back(make_part(part));
    }
    return parts;
}

/// The part that a point lies on; none where another passes within two samples, since the cast may take
/// either's colour there.
const Part* part_at(const std::vector<Part>& parts, const glm::dvec3& point, double sample) {
    const Part* on = nullptr;
    for (const Part& part : parts) {
        if (std::abs(part.distance(point)) < 2 * sample) {
            if (on != nullptr) {
                return nullptr;
            }
            on = &part;
        }
    }
    return on;
}

/// `degrees`: that normals may be off, mean. `wrong_colours`: the share of vertices that may have another
/// colour: a place that none of the six views sees takes its neighbours'.
void expect_normals_and_colours(const Cast& cast, const std::string& shape, double sample, double degrees,
                                double wrong_colours) {
    const std::vector<Part> parts = closed_form(shape);
    double angles = 0;
    std::size_t counted = 0, wrong = 0;
    for (std::size_t v = 0; v < cast.mesh.positions.size(); ++v) {
        const Part* part = part_at(parts, cast.mesh.positions[v], sample);
        if (part == nullptr) {
            continue;
        }
        const double cosine =
            glm::dot(part->normal(cast.mesh.positions[v]), glm::dvec3(cast.mesh.normals[v]));
        angles += glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
        const glm::dvec3 off = glm::abs(part->colour - glm::dvec3(cast.mesh.colours[v]));
        wrong += std::max({off.x, off.y, off.z}) > 1 / 255.0 ? 1 : 0;
        ++counted;
    }
    EXPECT_GT(counted, cast.mesh.positions.size() * 8 / 10);
    EXPECT_LE(angles / double(counted), degrees) << "degrees, mean";
    EXPECT_LE(double(wrong), wrong_colours * double(counted));
    std::cout << wrong << " of " << counted << " vertices have another colour; normals are "
              << angles / double(counted) << " degrees off\n";
}

double nearest_vertex(const Mesh& mesh, const glm::dvec3& point) {
    double nearest = std::numeric_limits<double>::max();
    for (const glm::dvec3& p : mesh.positions) {
        nearest = std::min(nearest, glm::distance(p, point));
    }
    return nearest;
}

TEST(FixtureCasts, CubeIsSharp) {
    const Cast cast = cast_fixture("cube");
    const Accuracy is = expect_close(cast, "cube", cube);
    EXPECT_LE(is.worst_to_truth, 0.05);
    EXPECT_LE(is.worst_from_truth, 0.05);
    const auto bounds = nlohmann::json::parse(fixtures::describe("cube")).at("bounds");
    const glm::dvec3 ends[] = {vector(bounds.at("lo")), vector(bounds.at("hi"))};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(ends[corner & 1].x, ends[corner >> 1 & 1].y, ends[corner >> 2].z);
        EXPECT_LE(nearest_vertex(cast.mesh, point), 0.1 * is.sample) << "corner " << corner;
    }
}

TEST(FixtureCasts, SpheresHaveTheirNormalsAndColours) {
    const Cast cast = cast_fixture("spheres");
    expect_normals_and_colours(cast, "spheres", expect_close(cast, "spheres", spheres).sample, 2 * 0.0063,
                               0.0001);
}

TEST(FixtureCasts, TorusHasItsNormalsAndColour) {
    const Cast cast = cast_fixture("torus");
    expect_normals_and_colours(cast, "torus", expect_close(cast, "torus", torus).sample, 2 * 0.097, 0);
}

TEST(FixtureCasts, TeapotIsClose) { expect_close(cast_fixture("teapot"), "teapot", teapot); }

} // namespace
} // namespace glcast::test
