// glcast mesh --pm, glcast refine and glcast info of a .glpm, run as a user runs them.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/file/command_line.h"
#include "tests/file/sphere_capture.h"
#include "tests/progressive/openmesh_reader.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;
using Json = nlohmann::json;

namespace {

void expect_refused(const std::string& arguments, int status, const std::string& part) {
    expect_one_line(glcast_run(arguments), status, part);
}

/// Six views of a box in the middle, each side with its own normal and colour; the writer's error.
std::string write_box(const std::string& path, int n) {
    constexpr double half = 0.3;
    CaptureWriter writer(path, sphere_info(n), 6);
    for (const View& view : six_views()) {
        ViewImage image = blank_image({view.axis, view.side, 0}, n);
        const double sign = view.side == Side::minus ? -1 : 1;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double u = (i + 0.5) / n - 0.5, v = (j + 0.5) / n - 0.5;
                if (std::abs(u) > half || std::abs(v) > half) continue;
                const std::size_t p = std::size_t(j) * std::size_t(n) + std::size_t(i);
                image.depth[p] = float(0.5 + sign * half);
                image.colour[p] = {sign > 0 ? 1 : 0, 0.25f * float(int(view.axis)), 0.5f, 1};
                glm::vec4 normal(0, 0, 0, 1);
                normal[image_axes(view.axis).depth] = float(sign);
                image.normal[p] = normal;
            }
        if (!writer.add(image)) return writer.error();
    }
    writer.finish();
    return writer.error();
}

class Refine : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(write_nested(folder / "cast.exr", 48), "");
        const Ran ran = glcast_run("mesh " + at("cast.exr") + " -o " + at("levels.ply") + " --pm " +
                                   at("all.glpm") + " --texture none --triangles 4000,1000,300");
        ASSERT_EQ(ran.status, 0) << ran.output;
        ASSERT_EQ(
            glcast_run("mesh " + at("cast.exr") + " -o " + at("full.ply") + " --full --texture none").status,
            0);
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    /// Without what says which levels were written together.
    std::string bytes(const std::string& name) const {
        std::string text = read_text(folder / name);
        if (const std::size_t at = text.find("comment glcast-levels"); at != text.npos)
            text.erase(at, text.find('\n', at) + 1 - at);
        return text;
    }

    Folder folder;
};

} // namespace

TEST_F(Refine, GivesTheFilesThatSimplifyingGave) {
    for (const auto& [triangles, file] :
         {std::pair{"4000", "levels.ply"}, {"1000", "levels_LOD1.ply"}, {"300", "levels_LOD2.ply"}}) {
        const Json json =
            json_of("refine " + at("all.glpm") + " -o " + at("x.ply") + " --triangles " + triangles);
        EXPECT_TRUE(json["withinTarget"].get<bool>());
        EXPECT_LE(json["mesh"]["triangles"].get<int>(), std::stoi(triangles));
        EXPECT_TRUE(bytes("x.ply") == bytes(file)) << triangles;
    }
    EXPECT_EQ(glcast_run("refine " + at("all.glpm") + " -o " + at("x.ply")).status, 0);
    EXPECT_TRUE(bytes("x.ply") == bytes("full.ply"));
    EXPECT_EQ(json_of("refine " + at("all.glpm") + " -o " + at("x.glb") + " --edges 1500")["mesh"]["edges"],
              1500);
    EXPECT_EQ(read_mesh(folder / "x.glb").triangles.size(), 1000u);
}

/// A cube's sides meet at right angles: no vertex of its edges has one normal for all of them.
TEST(RefineWedges, EveryLevelHasNormalsByCorner) {
    const Folder folder;
    const auto at = [&](const std::string& name) { return (folder / name).string(); };
    ASSERT_EQ(write_box(folder / "cast.exr", 40), "");
    ASSERT_EQ(glcast_run("mesh " + at("cast.exr") + " -o " + at("c.glb") +
                         " --texture none --triangles 200 --pm " + at("c.glpm"))
                  .status,
              0);
    for (const char* count : {"1000", "200", "60"}) {
        SCOPED_TRACE(count);
        ASSERT_EQ(
            glcast_run("refine " + at("c.glpm") + " -o " + at("x.glb") + " --triangles " + count).status, 0);
        const Level level = read_levels(folder / "x.glb").at(0);
        ASSERT_FALSE(level.wedges.normals.empty());
        double off = 0, all = 0;
        for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
            const glm::dvec3& a = level.mesh.positions[level.mesh.triangles[t][0]];
            const glm::dvec3 across = glm::cross(level.mesh.positions[level.mesh.triangles[t][1]] - a,
                                                 level.mesh.positions[level.mesh.triangles[t][2]] - a);
            for (const glm::vec3& n : corner_normals(level.mesh, level.wedges, t)) {
                all += glm::length(across);
                if (glm::dot(glm::dvec3(n), glm::normalize(across)) < 0.95) off += glm::length(across);
            }
        }
        EXPECT_LT(off, 0.05 * all) << "flat sides, flat normals";
    }
}

TEST_F(Refine, MorphsBetweenLevels) {
    const std::string command = "refine " + at("all.glpm") + " --triangles 400 --to 2000 -o ";
    for (const char* fraction : {"0", "0.5", "1"})
        ASSERT_EQ(
            glcast_run(command + at(std::string("m") + fraction + ".ply") + " --fraction " + fraction).status,
            0);
    ASSERT_EQ(glcast_run("refine " + at("all.glpm") + " --triangles 2000 -o " + at("fine.ply")).status, 0);
    EXPECT_EQ(read_mesh(folder / "m1.ply").positions, read_mesh(folder / "fine.ply").positions);
    EXPECT_EQ(read_mesh(folder / "m1.ply").triangles, read_mesh(folder / "fine.ply").triangles);
    const Mesh start = read_mesh(folder / "m0.ply"), middle = read_mesh(folder / "m0.5.ply"),
               end = read_mesh(folder / "fine.ply");
    ASSERT_EQ(start.triangles, end.triangles);
    for (std::size_t v = 0; v < end.positions.size(); ++v)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(middle.positions[v][k], (start.positions[v][k] + end.positions[v][k]) / 2, 1e-6);
}

TEST_F(Refine, OpenMeshRefinesItsFormatToTheFullSurface) {
    const Json json = json_of("mesh " + at("cast.exr") + " -o " + at("x.glb") + " --pm " + at("all.pm") +
                              " --triangles 4000");
    EXPECT_EQ(json["levels"].size(), 1u);
    const auto refined = test::refined_by_openmesh(bytes("all.pm"));
    EXPECT_EQ(refined.base_triangles, 500u);
    EXPECT_TRUE(refined.manifold);
    const Mesh full = read_mesh(folder / "full.ply");
    EXPECT_EQ(refined.triangles.size(), full.triangles.size());
    EXPECT_EQ(refined.positions.size(), full.positions.size());
}

TEST_F(Refine, TheBaseIsTheCoarsestLevelWhereThatHasFewer) {
    const Json json =
        json_of("mesh " + at("cast.exr") + " -o " + at("x.ply") + " --texture none --pm " + at("x.glpm"));
    const Json coarsest = json["levels"].back();
    ASSERT_GE(json["levels"].size(), 2u);
    ASSERT_LT(coarsest["triangles"], 500) << "three pixels wide, it needs no more";
    const Json info = json_of("info " + at("x.glpm"));
    EXPECT_EQ(info["base"]["triangles"], coarsest["triangles"]);
    EXPECT_EQ(json_of("refine " + at("x.glpm") + " -o " + at("y.ply") + " --triangles 1")["level"], 0);
    EXPECT_TRUE(bytes("y.ply") == bytes("x_LOD" + std::to_string(json["levels"].size() - 1) + ".ply"));
}

TEST_F(Refine, SaysThatAFileIsCutOff) {
    const std::string whole = bytes("all.glpm");
    write_text(folder / "cut.glpm", whole.substr(0, whole.size() / 2));
    const Json json = json_of("refine " + at("cut.glpm") + " -o " + at("x.ply"));
    EXPECT_FALSE(json["complete"].get<bool>());
    const int triangles = json["mesh"]["triangles"];
    EXPECT_TRUE(json["mesh"]["closedManifold"].get<bool>());
    EXPECT_NE(glcast_run("refine " + at("cut.glpm") + " -o " + at("x.ply")).output.find("is cut off"),
              std::string::npos);
    ASSERT_EQ(glcast_run("refine " + at("all.glpm") + " -o " + at("y.ply") + " --triangles " +
                         std::to_string(triangles))
                  .status,
              0);
    const Mesh x = read_mesh(folder / "x.ply"), y = read_mesh(folder / "y.ply");
    EXPECT_EQ(x.positions, y.positions) << "the coarser mesh is a level";
    EXPECT_EQ(x.triangles, y.triangles);
    const Json info = json_of("info " + at("cut.glpm"));
    EXPECT_FALSE(info["complete"].get<bool>());
    EXPECT_EQ(info["finest"]["triangles"], triangles);
    EXPECT_LT(info["splits"], info["splitsWhenComplete"]);
    EXPECT_NE(glcast_run("info " + at("cut.glpm")).output.find("cut off"), std::string::npos);
}

TEST_F(Refine, RefusesInOneLine) {
    write_text(folder / "short.glpm", bytes("all.glpm").substr(0, 100));
    expect_refused("refine " + at("short.glpm") + " -o " + at("x.ply"), 1, "cut off before its base mesh");
    expect_refused("refine " + at("full.ply") + " -o " + at("x.ply"), 1,
                   "is no progressive mesh of glcast (.glpm)");
    expect_refused("refine " + at("nowhere.glpm") + " -o " + at("x.ply"), 1, "no such file");
    expect_refused("refine " + at("all.glpm") + " -o " + at("x.xyz"), 1, "name it .glb, .obj, .ply");
    expect_refused("refine " + at("all.glpm") + " -o " + at("x.ply") + " --to 100 --fraction 0.5", 1,
                   "--to needs");
    expect_refused("refine " + at("all.glpm") + " -o " + at("x.ply") + " --edges 9 --ratio 0.5", 2,
                   "excludes");
    expect_refused("refine " + at("all.glpm") + " -o " + at("x.ply") +
                       " --triangles 400 --to 300 --fraction 1",
                   1, "finer level");
    expect_refused("mesh " + at("cast.exr") + " -o " + at("x.ply") + " --pm " + at("x.obj"), 1,
                   "name a progressive mesh");
    EXPECT_FALSE(std::filesystem::exists(folder / "x.ply"));
    EXPECT_FALSE(std::filesystem::exists(folder / "x.obj"));
}

TEST_F(Refine, BelowTheBaseMeshItIsTheBaseMeshAndSaysSo) {
    const Json json = json_of("refine " + at("all.glpm") + " -o " + at("x.ply") + " --triangles 10");
    EXPECT_FALSE(json["withinTarget"].get<bool>());
    EXPECT_EQ(json["level"], 0);
    EXPECT_LE(json["mesh"]["triangles"], 300);
}
