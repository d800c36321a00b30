// Viewers of kinds that the other real programs are not: a scene graph (Coin), a window with four views
// (mm3d), a cloud of points (meshlab).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "tests/real/cast_program.h"
#include "tools/io/mesh_io.h"

namespace glcast::test {
namespace {

std::string model(const std::string& name) { return std::string(TEST_DATA) + "/" + name; }

constexpr double mean_limit_samples = 2 * 0.0011; // twice the most that was measured

Cast expect_cast(const RealProgram& program) {
    Cast cast = cast_program(program);
    EXPECT_EQ(cast.error, "");
    EXPECT_TRUE(cast.manifold) << cast.oracle;
    EXPECT_EQ(cast.self_intersections, 0u);
    return cast;
}

void expect_close(const Cast& cast, const Mesh& truth) {
    if (!cast.error.empty()) return;
    const Accuracy is = accuracy(cast, truth);
    EXPECT_EQ(is.error, "");
    EXPECT_LE(is.to_truth, mean_limit_samples);
    EXPECT_LE(is.from_truth, mean_limit_samples);
}

/// An Open Inventor file of the mesh, in one colour.
std::string write_inventor(const Mesh& mesh, const glm::vec3& colour) {
    const std::string file = testing::TempDir() + "/t_faces.iv";
    std::ofstream out(file);
    out << "#Inventor V2.1 ascii\nSeparator {\n  Material { diffuseColor " << colour.x << ' ' << colour.y
        << ' ' << colour.z << " }\n  Coordinate3 { point [\n";
    for (const glm::dvec3& p : mesh.positions) out << p.x << ' ' << p.y << ' ' << p.z << ",\n";
    out << "] }\n  IndexedFaceSet { coordIndex [\n";
    for (const Triangle& t : mesh.triangles) out << t[0] << ',' << t[1] << ',' << t[2] << ",-1,\n";
    out << "] }\n}\n";
    return file;
}

// In the model's own coordinates: the camera of the viewer is the view.
TEST(RealViewers, CoinShowsAFaceSet) {
    const Mesh truth = read_mesh(model("t.obj"));
    const glm::vec3 colour(0.2f, 0.7f, 0.4f);
    const Cast cast = expect_cast(
        {.name = "coin", .command = {COIN_VIEWER, write_inventor(truth, colour)}, .levels = false});
    expect_close(cast, truth);
    EXPECT_GT(area_share(cast.mesh, colour), 0.99);
}

// Three orthographic views as outlines and one in perspective, shaded: that one is cast.
TEST(RealViewers, OfFourViewsOneIsCast) {
    const Cast cast = expect_cast({.name = "mm3d", .command = {"mm3d", model("t.obj")}, .levels = false});
    expect_close(cast, read_mesh(model("t.obj")));
}

struct Cloud {
    std::vector<glm::dvec3> points;
    std::string file;
};

glm::dvec3 colour_at(const glm::dvec3& p) { return glm::floor(127.0 + 127.0 * p) / 255.0; }

/// Points on the unit sphere, coloured by where they are.
Cloud write_cloud(std::size_t number) {
    Cloud cloud;
    cloud.file = testing::TempDir() + "/cloud.ply";
    std::mt19937 random(1);
    const auto unit = [&] { return random() / 4294967295.0; };
    std::ofstream out(cloud.file);
    out << "ply\nformat ascii 1.0\nelement vertex " << number
        << "\nproperty float x\nproperty float y\nproperty float z\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (std::size_t i = 0; i < number; ++i) {
        const double z = 2 * unit() - 1, turn = 2 * 3.14159265358979 * unit(), r = std::sqrt(1 - z * z);
        const glm::dvec3 p(r * std::cos(turn), r * std::sin(turn), z), c = colour_at(p) * 255.0;
        out << p.x << ' ' << p.y << ' ' << p.z << ' ' << int(c.x) << ' ' << int(c.y) << ' ' << int(c.z)
            << '\n';
        cloud.points.push_back(p);
    }
    return cloud;
}

/// In the cloud's own coordinates: meshlab scales what it shows, about the middle.
std::vector<glm::dvec3> on_unit_sphere(std::vector<glm::dvec3> points) {
    double radius = 0;
    for (const glm::dvec3& p : points) radius += glm::length(p) / double(points.size());
    for (glm::dvec3& p : points) p /= radius;
    return points;
}

// Each point becomes a block of a sample and a half, where it is and of its colour.
TEST(RealViewers, PointsOfACloudAreBlocksInPlace) {
    const Cloud cloud = write_cloud(1500);
    const Cast cast = expect_cast({.name = "cloud",
                                   .command = {"meshlab", cloud.file},
                                   .n = 64,
                                   .levels = false,
                                   .options = {"--include", "points"}});
    if (!cast.error.empty()) return;
    // The box is the sphere and two samples of margin on either side. Blocks have a half diagonal of 1.3
    // samples, and a vertex may stand anywhere in a cell that a block reaches into.
    const double sample = 2.0 / 60, reach = 1.3 * sample, cell = std::sqrt(3.0) * sample;
    const std::vector<glm::dvec3> vertices = on_unit_sphere(cast.mesh.positions);
    double farthest = 0, off = 0;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        farthest = std::max(farthest, std::abs(glm::length(vertices[v]) - 1));
        off +=
            glm::distance(glm::dvec3(cast.mesh.colours[v]), colour_at(vertices[v])) / double(vertices.size());
    }
    EXPECT_LE(farthest, reach + cell);
    EXPECT_LE(off, reach); // the slope of the colours is one half
    std::size_t alone = 0;
    for (const glm::dvec3& p : cloud.points) {
        const auto near = [&](const glm::dvec3& v) { return glm::distance(p, v) <= reach; };
        alone += std::none_of(vertices.begin(), vertices.end(), near);
    }
    EXPECT_EQ(alone, 0u);
}

} // namespace
} // namespace glcast::test
