// Textured and compressed files: what is written comes back, as the two-manifold that it was.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "tests/file/file_tools.h"
#include "tests/file/textured_torus.h"
#include "tools/io/glb_container.h"
#include "tools/io/glb_extras.h"
#include "tools/io/level_set.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"
#include "tools/mesh/error_names.h"
#include "tools/picture/png.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

constexpr Compression all[] = {Compression::none, Compression::quantize, Compression::meshopt};

struct Case {
    Compression compression;
    const char* name;
    double position, coordinate, tangent; ///< largest difference
};
// Half a step of 65535 over the torus's 2.5 along each axis; half a step of 65535; an angle of half a step of
// 127 along each axis.
constexpr Case cases[] = {
    {Compression::none, "plain", 1e-7, 0, 0},
    {Compression::quantize, "quantized", 2.5 / 65535 / 2 * 1.7321, 0.5001 / 65535, 0.0069},
    {Compression::meshopt, "meshopt", 2.5 / 65535 / 2 * 1.7321, 0.5001 / 65535, 0.0069}};

class Textured : public testing::TestWithParam<Case> {};
/// meshopt brings the corners back in another order: those are compared by place.
class TexturedInOrder : public Textured {};

/// Triangles by the places of their corners, whatever their order.
auto by_place(const Level& level) {
    std::multiset<std::array<long, 15>> corners;
    const auto whole = [](double x) { return std::lround((x + 2.3e-6) * 1e5); };
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
        std::array<std::array<long, 5>, 3> c;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = level.mesh.positions[level.mesh.triangles[t][k]];
            const glm::vec2& at = level.texture.coordinates[t][k];
            c[k] = {whole(p.x), whole(p.y), whole(p.z), whole(at.x), whole(at.y)};
        }
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        std::array<long, 15> one;
        for (int k = 0; k < 15; ++k) one[k] = c[k / 5][k % 5];
        corners.insert(one);
    }
    return corners;
}

void expect_same_pictures(const Texture& read, const Texture& wanted) {
    EXPECT_EQ(read.colour.width, wanted.colour.width);
    EXPECT_EQ(read.colour.rgb, wanted.colour.rgb);
    EXPECT_EQ(read.normal.rgb, wanted.normal.rgb);
}

} // namespace

TEST_P(Textured, ComesBackAsTheTwoManifoldItWas) {
    const Folder folder;
    std::vector levels{textured_torus(60, 40), textured_torus(12, 8, 32, "level 1")};
    round_levels(levels, GetParam().compression);
    if (GetParam().compression == Compression::none)
        for (Level& level : levels)
            for (glm::dvec3& p : level.mesh.positions)
                for (int c = 0; c < 3; ++c) {
                    volatile float stored = float(p[c]); // GCC 12 leaves the way there and back out
                    p[c] = stored;
                }
    write_levels(folder / "t.glb", levels, {.compression = GetParam().compression, .one_file = true});
    const std::vector<Level> read = read_levels(folder / "t.glb");
    ASSERT_EQ(read.size(), 2u);
    for (int k = 0; k < 2; ++k) {
        SCOPED_TRACE(k);
        const MeshCheck check = check_mesh(read[k].mesh);
        EXPECT_TRUE(check.closed_manifold()) << describe(check);
        EXPECT_EQ(check.euler, 0);
        EXPECT_EQ(check.vertices, levels[k].mesh.positions.size());
        EXPECT_TRUE(by_place(read[k]) == by_place(levels[k]));
        expect_same_pictures(read[k].texture, levels[k].texture);
    }
}

TEST_P(TexturedInOrder, CornersKeepTheirValues) {
    const Folder folder;
    const Level level = textured_torus(30, 20);
    write_levels(folder / "t.glb", std::vector{level}, {.compression = GetParam().compression});
    const Level read = read_levels(folder / "t.glb").at(0);
    ASSERT_EQ(read.mesh.triangles, level.mesh.triangles);
    for (std::size_t v = 0; v < level.mesh.positions.size(); ++v) {
        ASSERT_LE(glm::length(read.mesh.positions[v] - level.mesh.positions[v]), GetParam().position);
        for (int k = 0; k < 3; ++k) // the texture's at the vertex
            ASSERT_NEAR(read.mesh.colours[v][k], level.mesh.colours[v][k], 0.06);
    }
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const glm::vec2 apart = read.texture.coordinates[t][k] - level.texture.coordinates[t][k];
            ASSERT_LE(std::max(std::abs(apart.x), std::abs(apart.y)), GetParam().coordinate + 1e-7);
            const glm::vec4 &is = read.texture.tangents[t][k], &was = level.texture.tangents[t][k];
            ASSERT_LE(glm::length(glm::vec3(is) - glm::vec3(was)), GetParam().tangent + 1e-6);
            ASSERT_EQ(is.w, was.w);
        }
}

const auto case_name = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Files, Textured, testing::ValuesIn(cases), case_name);
INSTANTIATE_TEST_SUITE_P(Files, TexturedInOrder, testing::ValuesIn(std::span(cases).first(2)), case_name);

TEST(TexturedGlb, TheSameBytesEachTime) {
    const Folder folder;
    const std::vector levels{textured_torus(30, 20)};
    for (const Compression compression : all) {
        write_levels(folder / "a.glb", levels, {.compression = compression, .one_file = true});
        write_levels(folder / "b.glb", levels, {.compression = compression, .one_file = true});
        EXPECT_EQ(read_text(folder / "a.glb"), read_text(folder / "b.glb"));
    }
}

TEST(TexturedGlb, KhronosValidatorFindsNothing) {
    const Folder folder;
    const std::vector levels{textured_torus(300, 220), textured_torus(12, 8, 32, "level 1")};
    const std::vector bare{Level{torus(60, 40), "level 0"}, Level{torus(12, 8), "level 1"}};
    int k = 0;
    for (const Compression compression : all) {
        write_levels(folder / ("t" + std::to_string(k) + ".glb"), levels,
                     {.compression = compression});
        write_levels(folder / ("b" + std::to_string(k++) + ".glb"), bare, {.compression = compression, .one_file = true});
    }
    ASSERT_EQ(folder.names().size(), 9u);
    const Ran ran = run("node " GLCAST_VALIDATE " " + folder.path().string() + "/*.glb");
    EXPECT_EQ(ran.status, 0) << ran.output;
}

TEST(TexturedGlb, SeamsThatDoNotHoldAreLeftOpen) {
    const Folder folder;
    write_levels(folder / "t.glb", std::vector{textured_torus(12, 8)}, {.one_file = true});
    const std::string file = read_text(folder / "t.glb");
    format::GlbChunks chunks = format::glb_chunks(file);
    for (const int accessor : {0, 1, 4, 99, -1}) {
        chunks.json["meshes"][0]["extras"]["seams"] = accessor;
        write_text(folder / "x.glb", format::glb_file(chunks.json, chunks.bytes));
        const Level read = read_levels(folder / "x.glb").at(0);
        EXPECT_EQ(read.mesh.triangles.size(), 192u);
        EXPECT_FALSE(check_mesh(read.mesh).closed_manifold());
    }
}

TEST(TexturedGlb, PicturesThatTheirBytesCannotExplainAreRefused) {
    std::string png = png_bytes(textured_torus(3, 3, 16).texture.colour);
    EXPECT_EQ(decode_picture(png).rgb, textured_torus(3, 3, 16).texture.colour.rgb);
    for (int k = 16; k < 24; ++k) png[k] = k % 4 == 2 ? 0x3f : 0; // 16128 x 16128
    EXPECT_THROW(decode_picture(png), std::runtime_error);
    EXPECT_THROW(decode_picture("\x89PNG"), std::runtime_error);
    EXPECT_THROW(decode_picture(""), std::runtime_error);
}

TEST(Rounding, WhatIsRoundedIsWhatTheFileHolds) {
    const Folder folder;
    std::vector levels{textured_torus(60, 40), textured_torus(12, 8, 32, "level 1")};
    round_levels(levels, Compression::quantize);
    write_levels(folder / "t.glb", levels, {.compression = Compression::quantize});
    for (const char* name : {"t_LOD1.glb"}) {
        const Level read = read_levels(folder / name).back();
        for (std::size_t v = 0; v < read.mesh.positions.size(); ++v)
            ASSERT_LE(glm::length(read.mesh.positions[v] - levels[1].mesh.positions[v]), 1e-14) << name;
    }
}

TEST(Rounding, NoTwoVerticesComeToOnePlace) {
    Mesh small = torus(12, 8);
    for (glm::dvec3& p : small.positions) p *= 1e-5; // all of it within a step of the grid
    std::vector levels{Level{joined(small, torus(60, 40), {}), "level 0"}};
    for (const Compression compression : {Compression::quantize, Compression::meshopt}) {
        const Folder folder;
        write_levels(folder / "t.glb", levels, {.compression = compression, .one_file = true});
        const Mesh read = read_mesh(folder / "t.glb");
        std::set<std::array<double, 3>> places;
        for (const glm::dvec3& p : read.positions) places.insert({p.x, p.y, p.z});
        EXPECT_EQ(places.size(), read.positions.size());
        EXPECT_TRUE(check_mesh(read).closed_manifold());
    }
}

TEST(Extras, EveryErrorComesBack) {
    const Folder folder;
    std::vector levels{Level{torus(12, 8), "level 0"}};
    double value = 0.125;
    for (const ErrorName& e : error_names) levels[0].error.*e.value = value *= 1.5;
    for (const Compression compression : all) {
        write_levels(folder / "t.glb", levels, {.compression = compression, .one_file = true});
        const Level read = read_levels(folder / "t.glb").at(0);
        for (const ErrorName& e : error_names)
            EXPECT_EQ(read.error.*e.value, levels[0].error.*e.value) << e.name;
    }
}

TEST(ScreenCoverage, ALevelIsDrawnWhileItsErrorIsUnderAPixel) {
    std::vector levels{Level{tetrahedron(), "0"}, Level{tetrahedron(), "1"}, Level{tetrahedron(), "2"}};
    const double diameter = std::sqrt(3.0); // of the unit cube's diagonal
    levels[1].error.p999 = diameter / 500;  // a pixel when the sphere is 500 pixels wide
    levels[2].error.p999 = diameter / 100;
    const std::vector<double> coverage = format::screen_coverage(levels);
    ASSERT_EQ(coverage.size(), 3u);
    EXPECT_NEAR(coverage[0], M_PI / 4 * 500 * 500 / (1920 * 1080), 1e-12);
    EXPECT_NEAR(coverage[1], M_PI / 4 * 100 * 100 / (1920 * 1080), 1e-12);
    EXPECT_EQ(coverage[2], 0);
}

TEST(Files, AFileForEachLevel) {
    const Folder folder;
    const std::vector levels{textured_torus(20, 15), textured_torus(8, 6, 32, "level 1")};
    EXPECT_EQ(write_levels(folder / "t.glb", levels),
              (std::vector<std::filesystem::path>{folder / "t.glb", folder / "t_LOD1.glb"}));
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.glb", "t_LOD1.glb"}));
    for (const char* name : {"t.glb", "t_LOD1.glb"}) {
        const std::string file = read_text(folder / name);
        const auto json = format::glb_chunks(file).json;
        EXPECT_EQ(json["meshes"].size(), 1u) << name;
        EXPECT_EQ(json["nodes"].size(), 1u) << name;
        EXPECT_FALSE(json.contains("extensionsUsed")) << name;
    }
    EXPECT_EQ(read_mesh(folder / "t_LOD1.glb").triangles.size(), 96u);
    EXPECT_THROW(write_levels(folder / "t.obj", levels, {.one_file = true}), std::runtime_error);
    write_levels(folder / "one.glb", levels, {.one_file = true});
    EXPECT_EQ(read_levels(folder / "one.glb").size(), 2u);
}

TEST(Files, LevelsOfASetFindOneAnother) {
    for (const char* ending : {".glb", ".obj", ".ply"}) {
        const Folder folder;
        const std::filesystem::path file = folder / (std::string("t") + ending);
        std::vector levels{Level{torus(20, 15), "t_LOD0"}, Level{torus(12, 8), "t_LOD1"}, Level{torus(8, 6), "t_LOD2"}};
        join_as_set(levels);
        write_levels(file, levels);
        const std::vector<Level> all = read_all_levels(file);
        ASSERT_EQ(all.size(), 3u) << ending;
        EXPECT_EQ(all[2].mesh.triangles.size(), 96u);
        EXPECT_EQ(read_levels(file).size(), 1u);
        EXPECT_EQ(read_all_levels(folder / (std::string("t_LOD1") + ending)).size(), 1u) << "a level alone is asked for";
        // What only has the name is not of the set.
        std::vector other{Level{torus(10, 9), "x"}};
        write_levels(folder / (std::string("t_LOD1") + ending), other);
        EXPECT_EQ(read_all_levels(file).size(), 2u) << ending;
        std::vector changed{Level{torus(20, 15), "t_LOD0"}, Level{torus(10, 8), "t_LOD1"}};
        join_as_set(changed);
        EXPECT_NE(changed[0].set.id, levels[0].set.id);
    }
}

TEST(TexturedObj, MaterialAndPicturesAppearWithIt) {
    const Folder folder;
    const Level level = textured_torus(20, 15);
    write_levels(folder / "t.obj", std::vector{level});
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.colour.png", "t.mtl", "t.normal.png", "t.obj"}));
    EXPECT_EQ(decode_picture(read_text(folder / "t.colour.png")).rgb, level.texture.colour.rgb);
    EXPECT_NE(read_text(folder / "t.mtl").find("map_Kd t.colour.png"), std::string::npos);
    EXPECT_EQ(read_mesh(folder / "t.obj").triangles, level.mesh.triangles) << "seams cut no mesh";
    std::filesystem::create_directory(folder / "u.mtl"); // in the way
    EXPECT_THROW(write_levels(folder / "u.obj", std::vector{level}), std::runtime_error);
    EXPECT_EQ(folder.names().size(), 5u) << "nothing of a run that failed";
}

TEST(TexturedPly, CoordinatesOfCornersAndAPicture) {
    const Folder folder;
    const Level level = textured_torus(20, 15);
    write_levels(folder / "t.ply", std::vector{level});
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.colour.png", "t.ply"}));
    EXPECT_NE(read_text(folder / "t.ply").find("comment TextureFile t.colour.png"), std::string::npos);
    EXPECT_EQ(read_mesh(folder / "t.ply").triangles, level.mesh.triangles);
}

