// Programs from Debian that know nothing of glcast, cast into meshes. The t.* models are one torus and two
// spheres, so there the truth is known.
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iostream>

#include "tests/real/cast_program.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/mesh.h"

namespace glcast::test {
namespace {

std::string model(const std::string& name) { return std::string(TEST_DATA) + "/" + name; }
std::string saver(const std::string& name) { return "/usr/libexec/xscreensaver/" + name; }

constexpr double mean_limit_samples = 0.15;

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

TEST(Real, GlknotsThroughEgl) {
    expect_cast({.name = "glknots", .command = {saver("glknots"), "-window"}, .n = 128});
}

TEST(Real, SuperquadricsThroughEgl) {
    expect_cast({.name = "superquadrics", .command = {saver("superquadrics"), "-window"}, .n = 128});
}

} // namespace
} // namespace glcast::test
