// Meshes without thickness, all layers: closed, both sides there, as far apart as asked for.
#include <glm/geometric.hpp>

#include "tests/reconstruct/cast.h"
#include "tests/reconstruct/mesh_layers.h"
#include "tools/mesh/point_triangle.h"

namespace glcast::test {
namespace {

constexpr int n = 96;

Mesh turned_mesh(std::vector<glm::dvec3> positions, std::vector<Triangle> triangles, double degrees) {
    Mesh mesh;
    for (glm::dvec3& p : positions) p = turned({1, 2, 3}, degrees) * p;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    return mesh;
}

Mesh leaf() {
    return turned_mesh({{-.7, 0, 0}, {0, -.4, .1}, {.7, 0, 0}, {0, .4, .1}}, {{0, 1, 2}, {0, 2, 3}}, 37);
}

Mesh cone_without_bottom() {
    std::vector<glm::dvec3> positions{{0, 0, .7}};
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const double angle = 2 * M_PI * i / 64;
        positions.push_back({.6 * std::cos(angle), .6 * std::sin(angle), -.5});
        triangles.push_back({0, 1 + i, 1 + (i + 1) % 64});
    }
    return turned_mesh(positions, triangles, 37);
}

Mesh box_without_lid(double degrees) {
    std::vector<glm::dvec3> positions;
    for (int c = 0; c < 8; ++c)
        positions.push_back({c & 1 ? .5 : -.5, c >> 1 & 1 ? .6 : -.6, c >> 2 ? .4 : -.4});
    return turned_mesh(positions,
                       {{0, 1, 3},
                        {0, 3, 2},
                        {0, 1, 5},
                        {0, 5, 4},
                        {2, 3, 7},
                        {2, 7, 6},
                        {0, 2, 6},
                        {0, 6, 4},
                        {1, 3, 7},
                        {1, 7, 5}},
                       degrees);
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles)
        sum += 0.5 * glm::length(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                            mesh.positions[t[2]] - mesh.positions[t[0]]));
    return sum;
}

std::vector<glm::dvec3> points_of(const Mesh& mesh) {
    std::vector<glm::dvec3> points;
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i <= 20; ++i)
            for (int j = 0; i + j <= 20; ++j)
                points.push_back((mesh.positions[t[0]] * double(i) + mesh.positions[t[1]] * double(j) +
                                  mesh.positions[t[2]] * double(20 - i - j)) /
                                 20.0);
    return points;
}

/// Few and large triangles: all are asked.
double mean_distance(const Mesh& mesh, const Mesh& sheet) {
    double sum = 0;
    for (const glm::dvec3& p : mesh.positions) {
        double least = 1e300;
        for (const Triangle& t : sheet.triangles)
            least = std::min(
                least, glm::distance(p, nearest_in_triangle(p, sheet.positions[t[0]], sheet.positions[t[1]],
                                                            sheet.positions[t[2]])
                                            .point));
        sum += least;
    }
    return sum / double(mesh.positions.size());
}

void expect_two_sides(const Mesh& sheet, const char* name) {
    const Box box = box_around(sheet, n);
    const double sample = box.size / n;
    const auto images = cast_mesh(sheet, box, n);
    for (const double thickness : {0.1, 0.5}) {
        ReconstructOptions how;
        how.complete_layers = true;
        how.sheet_thickness = thickness;
        const Mesh mesh = reconstruct(images, box, how);
        EXPECT_TRUE(topology(mesh).closed()) << name;
        EXPECT_LT(points_to_mesh(points_of(sheet), mesh, sample).mean, thickness / 2 + 0.06) << name;
        EXPECT_LT(mean_distance(mesh, sheet) / sample, thickness / 2 + 0.03) << name;
        EXPECT_NEAR(topology(mesh).volume / area(sheet) / sample, thickness, 0.25 * thickness) << name;
    }
}

TEST(Sheets, HaveTwoSidesAsFarApartAsAskedFor) {
    expect_two_sides(leaf(), "leaf");
    expect_two_sides(cone_without_bottom(), "cone without bottom");
    expect_two_sides(box_without_lid(37), "tilted box without lid");
    expect_two_sides(box_without_lid(0), "box without lid");
}

TEST(Sheets, OpenVesselsAreOneBodyWithTheirInsideOpen) {
    for (const Mesh& vessel : {cone_without_bottom(), box_without_lid(37), box_without_lid(0)}) {
        const Box box = box_around(vessel, n);
        ReconstructOptions how;
        how.complete_layers = true;
        const Topology found = topology(reconstruct(cast_mesh(vessel, box, n), box, how));
        EXPECT_EQ(found.components, 1u);
        EXPECT_EQ(found.euler, 2);
    }
}

} // namespace
} // namespace glcast::test
