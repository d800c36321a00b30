// Programs from Debian that know nothing of glcast, cast into meshes. The t.* models are one torus and two
// spheres, so there the truth is known.
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <iostream>
#include <random>

#include "tests/real/cast_program.h"
#include "tests/real/command.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/mesh.h"

namespace glcast::test {
namespace {

std::string model(const std::string& name) { return std::string(TEST_DATA) + "/" + name; }
std::string saver(const std::string& name) { return "/usr/libexec/xscreensaver/" + name; }

constexpr double mean_limit_samples = 2 * 0.0026; // twice the most in docs/measured/results.md

/// What holds for every cast: it worked, the mesh is closed by code that did not make it, big enough to be
/// more than noise, and coloured.
Cast expect_cast(const RealProgram& program) {
    Cast cast = cast_program(program);
    EXPECT_EQ(cast.error, "");
    EXPECT_TRUE(cast.manifold) << cast.oracle;
    EXPECT_EQ(cast.self_intersections, 0u);
    // A body that fills the box has about n x n squares on each side; one that fills a thousandth of it is
    // still something.
    EXPECT_GT(cast.mesh.triangles.size(), static_cast<std::size_t>(program.n * program.n) / 50);
    EXPECT_LT(cast.mesh.triangles.size(), static_cast<std::size_t>(program.n) * program.n * 60);
    EXPECT_EQ(cast.mesh.colours.size(), cast.mesh.positions.size());
    EXPECT_EQ(cast.mesh.normals.size(), cast.mesh.positions.size());
    return cast;
}

void expect_close(const Cast& cast, const Mesh& truth) {
    if (!cast.error.empty()) {
        return;
    }
    const Accuracy is = accuracy(cast, truth);
    std::cout << "mean distance, samples: cast to truth " << is.to_truth << ", truth to cast "
              << is.from_truth << '\n';
    EXPECT_EQ(is.error, "");
    EXPECT_LE(is.to_truth, mean_limit_samples);
    EXPECT_LE(is.from_truth, mean_limit_samples);
}

/// OpenSceneGraph's reader of .obj turns models that are y up into z up.
Mesh z_up(Mesh mesh) {
    for (glm::dvec3& p : mesh.positions) {
        p = {p.x, -p.z, p.y};
    }
    return mesh;
}

/// Moved and scaled as a whole, as viewers do to fit a model into their world: the bounding box decides.
/// Never turned.
Mesh placed_like(Mesh truth, const Mesh& cast) {
    const auto bounds = [](const Mesh& mesh) {
        glm::dvec3 lo = mesh.positions.at(0), hi = lo;
        for (const glm::dvec3& p : mesh.positions) {
            lo = glm::min(lo, p), hi = glm::max(hi, p);
        }
        return std::pair(lo, hi);
    };
    const auto [from_lo, from_hi] = bounds(truth);
    const auto [to_lo, to_hi] = bounds(cast);
    const double scale = glm::distance(to_lo, to_hi) / glm::distance(from_lo, from_hi);
    for (glm::dvec3& p : truth.positions) {
        p = (p - (from_lo + from_hi) / 2.0) * scale + (to_lo + to_hi) / 2.0;
    }
    return truth;
}

void expect_close_where_placed(const Cast& cast, const Mesh& truth) {
    if (cast.error.empty()) {
        expect_close(cast, placed_like(truth, cast.mesh));
    }
}

TEST(Real, GlxgearsHasThreeGears) {
    const Cast cast = expect_cast({.name = "glxgears", .command = {"glxgears"}});
    for (const glm::vec3 colour :
         {glm::vec3(0.8f, 0.1f, 0.0f), glm::vec3(0.0f, 0.8f, 0.2f), glm::vec3(0.2f, 0.2f, 1.0f)}) {
        EXPECT_GT(area_share(cast.mesh, colour), 0.1) << colour.x << ' ' << colour.y << ' ' << colour.z;
    }
}

TEST(Real, Osgviewer) {
    const Cast cast =
        expect_cast({.name = "osgviewer",
                     .command = {"osgviewer", "--window", "100", "100", "800", "600", model("t.obj")}});
    expect_close(cast, z_up(read_mesh(model("t.obj"))));
}

TEST(Real, OsgviewerWithBuffers) {
    const Cast cast =
        expect_cast({.name = "osgviewer-vbo",
                     .command = {"osgviewer", "--window", "100", "100", "800", "600", model("t.obj")},
                     .environment = {{"OSG_VERTEX_BUFFER_HINT", "VBO"}}});
    expect_close(cast, z_up(read_mesh(model("t.obj"))));
}

TEST(Real, Geomview) {
    const Cast cast = expect_cast({.name = "geomview", .command = {"geomview", "-nopanels", model("t.off")}});
    expect_close_where_placed(cast, read_mesh(model("t.off")));
}

TEST(Real, Gmsh) {
    const Cast cast = expect_cast(
        {.name = "gmsh",
         .command = {"gmsh", "-setnumber", "Mesh.SurfaceFaces", "1", "-setnumber", "Mesh.SurfaceEdges", "0",
                     "-setnumber", "Mesh.VolumeEdges", "0", model("t.stl")}});
    expect_close_where_placed(cast, read_mesh(model("t.stl")));
}

TEST(Real, G3dviewer) {
    const Cast cast = expect_cast({.name = "g3dviewer", .command = {"g3dviewer", model("t.obj")}});
    expect_close_where_placed(cast, read_mesh(model("t.obj")));
}

TEST(Real, Meshlab) {
    const Cast cast = expect_cast({.name = "meshlab", .command = {"meshlab", model("t.ply")}});
    expect_close_where_placed(cast, read_mesh(model("t.ply")));
    for (const glm::vec3 colour : {glm::vec3(220, 60, 40), glm::vec3(40, 90, 220), glm::vec3(40, 200, 80)})
        EXPECT_GT(area_share(cast.mesh, colour / 255.0f), 0.03) << colour.x << ' ' << colour.y << ' ' << colour.z;
}

struct Sphere {
    glm::dvec3 centre{0};
    double radius = 0;
};

Sphere least_squares(const std::vector<glm::dvec3>& points) {
    glm::dmat4 normal(0.0);
    glm::dvec4 right(0.0);
    for (const glm::dvec3& p : points) {
        const glm::dvec4 row(2.0 * p, 1);
        normal += glm::outerProduct(row, row);
        right += row * glm::dot(p, p);
    }
    const glm::dvec4 x = glm::inverse(normal) * right;
    const glm::dvec3 centre(x);
    return {centre, std::sqrt(std::max(0.0, x.w + glm::dot(centre, centre)))};
}

/// The sphere that most points lie on, among spheres through four of them (RANSAC): bonds, axes and the flat sides of
/// half balls are left aside.
Sphere fit_sphere(const std::vector<glm::dvec3>& points, double tolerance) {
    std::mt19937 random(1);
    const auto on = [&](const Sphere& sphere) {
        std::vector<glm::dvec3> inliers;
        for (const glm::dvec3& p : points)
            if (std::abs(glm::distance(p, sphere.centre) - sphere.radius) < tolerance) inliers.push_back(p);
        return inliers;
    };
    std::vector<glm::dvec3> best;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<glm::dvec3> four;
        for (int i = 0; i < 4; ++i) four.push_back(points.at(random() % points.size()));
        const Sphere sphere = least_squares(four);
        if (!std::isfinite(sphere.radius) || sphere.radius > 100 * tolerance) continue;
        if (auto inliers = on(sphere); inliers.size() > best.size()) best = std::move(inliers);
    }
    return least_squares(best);
}

std::vector<glm::dvec3> points_of_colour(const Mesh& mesh, const glm::vec3& colour) {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (glm::distance(glm::vec3(mesh.colours[i]), colour) < 0.15f) points.push_back(mesh.positions[i]);
    return points;
}
/// Its atoms stand where the file says, but for one scale. It draws the halves that face the camera, so the rest of each
/// sphere is known from the fit alone.
TEST(Real, GdisHasItsAtomsInPlace) {
    const Cast cast = expect_cast({.name = "gdis", .command = {"gdis", model("cell.xyz")}, .levels = false});
    if (!cast.error.empty()) return;
    constexpr double tolerance = 0.01; // half a sample
    const Sphere carbon = fit_sphere(points_of_colour(cast.mesh, {0.55f, 0.9f, 0.6f}), tolerance),
                 sulphur = fit_sphere(points_of_colour(cast.mesh, {1, 1, 0.6f}), tolerance),
                 nitrogen = fit_sphere(points_of_colour(cast.mesh, {0.8f, 0.45f, 1}), tolerance);
    const double scale = glm::distance(carbon.centre, sulphur.centre) / 1.8;
    EXPECT_NEAR(glm::distance(carbon.centre, nitrogen.centre) / scale, std::sqrt(2.5), 0.02);
    EXPECT_NEAR(glm::distance(sulphur.centre, nitrogen.centre) / scale, std::sqrt(3.94), 0.02);
    EXPECT_NEAR(sulphur.radius / nitrogen.radius, 1, 0.05);
    EXPECT_NEAR(carbon.radius / nitrogen.radius, 1, 0.05);
}

TEST(Real, GlknotsThroughEgl) {
    expect_cast({.name = "glknots", .command = {saver("glknots"), "-window"}, .n = 128});
}

TEST(Real, SuperquadricsThroughEgl) {
    expect_cast({.name = "superquadrics", .command = {saver("superquadrics"), "-window"}, .n = 128});
}

class Saver : public testing::TestWithParam<const char*> {};
TEST_P(Saver, is_cast) {
    expect_cast({.name = GetParam(), .command = {saver(GetParam()), "-window"}, .n = 96, .levels = false});
}
INSTANTIATE_TEST_SUITE_P(Real, Saver, testing::Values("morph3d", "bouncingcow", "gears", "sproingies"),
                         [](const auto& info) { return info.param; });

struct Refused {
    const char* name;
    std::vector<std::string> command;
    const char* says;
};
class OtherDrawing : public testing::TestWithParam<Refused> {};

TEST_P(OtherDrawing, is_refused_in_a_plain_line) {
    std::vector<std::string> command = {GLCAST_RUN,  "--headless", "--quit", "--timeout",
                                        "25",        "-o",         std::string(testing::TempDir()) + "/none.exr", "--"};
    command.insert(command.end(), GetParam().command.begin(), GetParam().command.end());
    const CommandResult result =
        run_command(command, 60, {{"PATH", std::string("/usr/bin:") + std::getenv("PATH")}});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find(GetParam().says), std::string::npos) << result.err;
}
INSTANTIATE_TEST_SUITE_P(Real, OtherDrawing,
                         testing::Values(Refused{"es2gears", {"es2gears_x11"}, "it draws with OpenGL ES"},
                                         Refused{"f3d", {"f3d", model("t.stl")}, "a core profile context"},
                                         Refused{"view3dscene",
                                                 {"view3dscene", model("t.wrl")},
                                                 "it draws with shaders of its own"}),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
