// What OpenMesh makes of our .pm.
#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>

#include "tests/file/file_tools.h"
#include "tests/mesh/bodies.h"
#include "tests/progressive/bodies.h"
#include "tests/progressive/openmesh_reader.h"
#include "tools/progressive/openmesh_pm.h"

namespace glcast::test {
namespace {

using samples::Folder;

void write_pm(const std::filesystem::path& path, ProgressiveMesh& mesh) {
    OutputFile file(path.string());
    write_openmesh_pm(file, mesh);
    ASSERT_TRUE(file.commit()) << file.error();
}

/// Triangles as their corners' places, each in the least of their three rotations, sorted: the geometry
/// whatever the order.
template <class Positions>
std::vector<std::array<std::array<float, 3>, 3>> geometry(const Positions& positions,
                                                          const std::vector<Triangle>& triangles) {
    std::vector<std::array<std::array<float, 3>, 3>> all;
    for (const Triangle& t : triangles) {
        auto& corners = all.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            for (int c = 0; c < 3; ++c) corners[k][std::size_t(c)] = float(positions[t[k]][c]);
        auto least = corners; // places may be equal, as floats
        for (int turn = 0; turn < 2; ++turn) {
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            least = std::min(least, corners);
        }
        corners = least;
    }
    std::sort(all.begin(), all.end());
    return all;
}

bool has_unused_vertices(const Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size());
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) used[v] = true;
    return std::find(used.begin(), used.end(), false) != used.end();
}

TEST(OpenMeshPm, RefinedByOpenMeshItIsTheOriginal) {
    const Folder folder;
    for (const LoggedBody& body : logged_bodies()) {
        ProgressiveMesh mesh(body.mesh, body.log);
        mesh.refine_to(mesh.splits() / 3);
        write_pm(folder / "x.pm", mesh);
        EXPECT_EQ(mesh.level(), mesh.splits() / 3);
        const OpenMeshRefined refined = refined_by_openmesh(samples::read_text(folder / "x.pm"));
        EXPECT_EQ(refined.base_vertices, mesh.vertices(0)) << body.name;
        EXPECT_EQ(refined.splits, mesh.splits()) << body.name;
        EXPECT_EQ(refined.positions.size(), body.mesh.positions.size()) << body.name;
        EXPECT_TRUE(geometry(refined.positions, refined.triangles) ==
                    geometry(body.mesh.positions, body.mesh.triangles))
            << body.name;
        if (!has_unused_vertices(body.mesh)) {
            EXPECT_TRUE(refined.manifold) << body.name;
        }
    }
}

/// Every level: connectivity is ours, and every vertex stands where one of the original does, no further from
/// ours than from there to the others that became it.
TEST(OpenMeshPm, LevelsBetweenHaveOurConnectivityOnVerticesOfTheOriginal) {
    const Folder folder;
    const LoggedBody body = small_body();
    ProgressiveMesh mesh(body.mesh, body.log);
    write_pm(folder / "x.pm", mesh);
    const std::string file = samples::read_text(folder / "x.pm");
    std::map<std::array<float, 3>, int> places;
    for (const glm::dvec3& p : body.mesh.positions) ++places[{float(p.x), float(p.y), float(p.z)}];
    ASSERT_EQ(places.size(), body.mesh.positions.size()) << "each is at its own place";
    for (std::size_t level = 0; level <= mesh.splits(); ++level) {
        mesh.refine_to(level);
        const OpenMeshRefined refined = refined_by_openmesh(file, level);
        ASSERT_TRUE(refined.manifold);
        ASSERT_EQ(refined.triangles.size(), mesh.triangles(level));
        for (const glm::vec3& p : refined.positions) ASSERT_EQ(places.count({p.x, p.y, p.z}), 1u);
        // The same graph: as many vertices of each valence.
        const auto valences = [](const std::vector<Triangle>& triangles, std::size_t vertices) {
            std::vector<int> valence(vertices);
            for (const Triangle& t : triangles)
                for (const std::uint32_t v : t) ++valence[v];
            std::sort(valence.begin(), valence.end());
            return valence;
        };
        const Mesh ours = mesh.mesh();
        ASSERT_EQ(valences(refined.triangles, refined.positions.size()),
                  valences(ours.triangles, ours.positions.size()));
    }
}

/// A run of half-edge collapses moves nothing, so there every level is ours, place for place.
TEST(OpenMeshPm, LevelsOfHalfEdgeCollapsesAreOurs) {
    const Folder folder;
    const Mesh body = torus(2, 0.6, 16, 9);
    ProgressiveMesh mesh(body, shortest_edges(body, 30, Placement::half).log);
    write_pm(folder / "x.pm", mesh);
    for (const std::size_t level :
         {std::size_t(0), mesh.splits() / 4, mesh.splits() / 2, mesh.splits() - 1}) {
        mesh.refine_to(level);
        const OpenMeshRefined refined = refined_by_openmesh(samples::read_text(folder / "x.pm"), level);
        const Mesh ours = mesh.mesh();
        EXPECT_TRUE(geometry(refined.positions, refined.triangles) ==
                    geometry(ours.positions, ours.triangles))
            << level;
    }
}

/// The reader here reads what OpenMesh itself writes, or it would prove nothing.
TEST(OpenMeshPm, TheReaderOfTheseTestsReadsOpenMeshsOwn) {
    const Folder folder;
    for (const Mesh& body : {sphere(1, 3), torus(2, 0.6, 20, 12), cube(1, 6)}) {
        write_by_openmesh(body, 40, (folder / "x.pm").string());
        const OpenMeshRefined refined = refined_by_openmesh(samples::read_text(folder / "x.pm"));
        EXPECT_LE(refined.base_vertices, 40u);
        EXPECT_TRUE(geometry(refined.positions, refined.triangles) ==
                    geometry(body.positions, body.triangles));
    }
}

/// OpenMesh's own program (Debian: libopenmesh-apps) reads a .pm, refines it fully and writes its vertex
/// hierarchy.
TEST(OpenMeshPm, TheAnalyzerOfOpenMeshTakesIt) {
    const Folder folder;
    const LoggedBody body = small_body();
    ProgressiveMesh mesh(body.mesh, body.log);
    write_pm(folder / "x.pm", mesh);
    const auto ran =
        samples::run("OpenMesh-Analyzer " + (folder / "x.pm").string() + " " + (folder / "x.spm").string());
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_GT(std::filesystem::file_size(folder / "x.spm"), 24 * mesh.splits()) << ran.output;
}

} // namespace
} // namespace glcast::test
