// Mesh files: what is written comes back, what other programs write is understood, what is damaged is
// refused.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/file/file_tools.h"
#include "tests/file/sample_meshes.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

std::string why_refused(const std::filesystem::path& path) {
    try {
        read_levels(path);
    } catch (const std::runtime_error& e) {
        const std::string why = e.what();
        EXPECT_EQ(why.find('\n'), std::string::npos) << "one line: " << why;
        return why;
    }
    return "";
}

Level level_of(Mesh mesh, const char* name, double error = 0) {
    return {std::move(mesh), name, {.mean = error, .max = 2 * error}, 0.125, {}};
}

Mesh moved(Mesh mesh, const glm::dvec3& by) {
    for (auto& p : mesh.positions) p += by;
    return mesh;
}

struct Tolerance {
    const char* extension;
    double position, normal, colour; ///< normal < 0: not kept
};

void expect_near(const Mesh& read, const Mesh& wanted, const Tolerance& t) {
    ASSERT_EQ(read.triangles, wanted.triangles);
    ASSERT_EQ(read.positions.size(), wanted.positions.size());
    ASSERT_EQ(read.normals.size(), t.normal < 0 ? 0 : wanted.normals.size());
    ASSERT_EQ(read.colours.size(), wanted.colours.size());
    for (std::size_t v = 0; v < wanted.positions.size(); ++v) {
        ASSERT_LE(glm::length(read.positions[v] - wanted.positions[v]), t.position) << v;
        if (t.normal >= 0) {
            ASSERT_LE(glm::length(read.normals[v] - wanted.normals[v]), t.normal) << v;
        }
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(read.colours[v][k], wanted.colours[v][k], t.colour) << v;
    }
}

} // namespace

class MeshFormat : public testing::TestWithParam<Tolerance> {};

TEST_P(MeshFormat, RoundTrip) {
    const Folder folder;
    const Mesh mesh = torus(60, 40);
    const auto path = folder / (std::string("torus") + GetParam().extension);
    EXPECT_EQ(write_levels(path, std::vector{level_of(mesh, "level 0")}), std::vector{path});
    expect_near(read_mesh(path), mesh, GetParam());
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST_P(MeshFormat, FarFromTheOriginKeepsItsDigits) {
    const Folder folder;
    const Mesh mesh = moved(torus(30, 20), {123456.75, -654321.5, 0.25});
    const auto path = folder / (std::string("far") + GetParam().extension);
    write_levels(path, std::vector{level_of(mesh, "level 0")});
    Tolerance t = GetParam();
    t.position = t.extension == std::string(".glb") || t.extension == std::string(".ply")
                     ? 1e-6
                     : 1e-3; // text: 9 digits
    expect_near(read_mesh(path), mesh, t);
}

TEST_P(MeshFormat, WithoutNormalsAndColours) {
    const Folder folder;
    Mesh mesh = tetrahedron();
    mesh.normals.clear(), mesh.colours.clear();
    const auto path = folder / (std::string("bare") + GetParam().extension);
    write_levels(path, std::vector{level_of(mesh, "level 0")});
    const Mesh read = read_mesh(path);
    EXPECT_EQ(read.triangles, mesh.triangles);
    EXPECT_TRUE(read.normals.empty());
    EXPECT_TRUE(read.colours.empty());
}

TEST_P(MeshFormat, TruncationsAreRefusedOrHarmless) {
    const Folder folder;
    const auto path = folder / (std::string("t") + GetParam().extension);
    write_levels(path, std::vector{level_of(torus(5, 4), "level 0")});
    const std::string whole = read_text(path);
    const auto cut = folder / (std::string("cut") + GetParam().extension);
    // Text may lose its last digit or, in .obj, whole faces: nothing in those formats tells.
    const bool text =
        GetParam().extension == std::string(".obj") || GetParam().extension == std::string(".off");
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        write_text(cut, whole.substr(0, length));
        const std::string why = why_refused(cut);
        if (!text || length < 100) {
            ASSERT_NE(why, "") << length << " of " << whole.size();
        }
    }
}

TEST_P(MeshFormat, UnwritableTargetLeavesNothing) {
    const Folder folder;
    const std::vector levels{level_of(tetrahedron(), "level 0")};
    EXPECT_THROW(write_levels(folder / "no" / (std::string("x") + GetParam().extension), levels),
                 std::runtime_error);
    EXPECT_TRUE(folder.names().empty());
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFormat,
                         testing::Values(Tolerance{".glb", 1e-7, 1e-6, 0.25 / 255},
                                         Tolerance{".obj", 1e-8, 1e-6, 1e-6},
                                         Tolerance{".ply", 1e-7, 1e-6, 0.51 / 255},
                                         Tolerance{".off", 1e-8, -1, 1e-6}),
                         [](const auto& info) { return std::string(info.param.extension + 1); });

TEST(Glb, LevelsErrorsAndSample) {
    const Folder folder;
    const std::vector levels{level_of(torus(40, 30), "level 0"), level_of(torus(20, 15), "level 1", 0.01),
                             level_of(torus(8, 6), "level 2", 0.04)};
    write_levels(folder / "l.glb", levels, {.one_file = true});
    const std::vector<Level> read = read_levels(folder / "l.glb");
    ASSERT_EQ(read.size(), 3u);
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(read[k].name, levels[k].name);
        EXPECT_EQ(read[k].mesh.triangles, levels[k].mesh.triangles);
        EXPECT_EQ(read[k].error.mean, levels[k].error.mean);
        EXPECT_EQ(read[k].error.max, levels[k].error.max);
        EXPECT_EQ(read[k].sample, 0.125);
    }
}

TEST(Glb, ManyVerticesNeedWideIndices) {
    const Folder folder;
    const Mesh mesh = torus(300, 220); // 66,000 vertices
    write_levels(folder / "m.glb", std::vector{level_of(mesh, "level 0")}, {.one_file = true});
    EXPECT_EQ(read_mesh(folder / "m.glb").triangles, mesh.triangles);
}

TEST(Glb, KhronosValidatorFindsNothing) {
    const Folder folder;
    const Mesh small = torus(12, 9);
    Mesh bare = tetrahedron();
    bare.normals.clear(), bare.colours.clear();
    write_levels(folder / "one.glb", std::vector{level_of(small, "level 0")}, {.one_file = true});
    write_levels(folder / "three.glb",
                 std::vector{level_of(torus(300, 220), "level 0"), level_of(small, "level 1", 0.1),
                             level_of(tetrahedron(), "level 2", 0.3)},
                 {.one_file = true});
    write_levels(folder / "far.glb", std::vector{level_of(moved(small, {5e5, 0, -3e6}), "level 0")},
                 {.one_file = true});
    write_levels(folder / "bare.glb", std::vector{level_of(bare, "level 0")}, {.one_file = true});
    const Ran ran = run("node " GLCAST_VALIDATE " " + folder.path().string() + "/*.glb");
    EXPECT_EQ(ran.status, 0) << ran.output;
}

TEST(Levels, OtherFormatsGetAFileEach) {
    const Folder folder;
    const std::vector levels{level_of(torus(20, 15), "level 0"), level_of(torus(8, 6), "level 1", 0.1)};
    write_levels(folder / "t.ply", levels);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.ply", "t_LOD1.ply"}));
    EXPECT_EQ(read_mesh(folder / "t_LOD1.ply").triangles.size(), 96u);
}

TEST(Obj, WhatOthersWrite) {
    const Folder folder;
    write_text(folder / "a.obj",
               "# a cube's face, relative indices, texture coordinates, CRLF\r\n"
               "mtllib none.mtl\r\no thing\r\nv 0 0 0\r\nv 1 0 0 1.0\r\nv +1 1e0 0\r\nv 0 1 0\r\n"
               "vt 0 0\r\nvn 0 0 2\r\ns off\r\nf -4/1/1 -3/1/1 -2/1/1 -1/1/1\r\nf 1 2 3\r\n");
    const Mesh m = read_mesh(folder / "a.obj");
    EXPECT_EQ(m.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
    EXPECT_EQ(m.normals.at(2), glm::vec3(0, 0, 1));
    EXPECT_TRUE(m.colours.empty());
}

TEST(Ply, AsciiAndBigEndianAndOtherElements) {
    const Folder folder;
    write_text(
        folder / "a.ply",
        "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar float m\nelement vertex 4\n"
        "property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
        "property uchar blue\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
        "2 1 2\n0 0 0 255 0 51\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 0 0 0\n4 0 1 2 3\n");
    const Mesh a = read_mesh(folder / "a.ply");
    EXPECT_EQ(a.triangles.size(), 2u);
    EXPECT_NEAR(a.colours.at(0).b, 0.2, 1e-6);
    std::string big = "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty "
                      "double y\nproperty short z\n"
                      "element face 1\nproperty list uchar uint vertex_indices\nend_header\n";
    const auto put = [&](auto value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        std::reverse(bytes, bytes + sizeof value);
        big.append(bytes, sizeof value);
    };
    for (int v = 0; v < 3; ++v) put(float(v)), put(double(v * v)), put(std::int16_t(-v));
    big += '\3', put(0u), put(1u), put(2u);
    write_text(folder / "b.ply", big);
    EXPECT_EQ(read_mesh(folder / "b.ply").positions.at(2), glm::dvec3(2, 4, -2));
}

TEST(Off, Kinds) {
    const Folder folder;
    const std::string faces = "3 0 1 2\n4 0 1 2 3 255 0 0\n";
    write_text(folder / "a.off", "OFF\n# comment\n\n4 2 0\n0 0 0\n1 0 0 # x\n0 1 0\n0 0 1\n" + faces);
    EXPECT_EQ(read_mesh(folder / "a.off").triangles.size(), 3u);
    write_text(folder / "b.off",
               "COFF 4 2 0\n0 0 0 255 0 51 255\n1 0 0 0 0 0 255\n0 1 0 0 0 0 255\n0 0 1 0 0 0 255\n" + faces);
    EXPECT_NEAR(read_mesh(folder / "b.off").colours.at(0).b, 0.2, 1e-6);
    write_text(folder / "c.off", "NOFF\n4 2 0\n0 0 0 0 0 2\n1 0 0 0 0 2\n0 1 0 0 0 2\n0 0 1 0 0 2\n" + faces);
    EXPECT_EQ(read_mesh(folder / "c.off").normals.at(0), glm::vec3(0, 0, 1));
}

TEST(Stl, AsciiAndBinaryAreWelded) {
    const Folder folder;
    const Mesh mesh = tetrahedron();
    std::string ascii = "solid t\n", binary(80, 's');
    const auto put = [&](const auto& value) {
        binary.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(std::uint32_t(mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) {
        ascii += " facet normal 0 0 0\n  outer loop\n";
        put(glm::vec3(0));
        for (auto v : t) {
            const glm::vec3 p(mesh.positions[v]);
            ascii += "   vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                     std::to_string(p.z) + "\n";
            put(p);
        }
        ascii += "  endloop\n endfacet\n";
        put(std::uint16_t(0));
    }
    write_text(folder / "a.stl", ascii + "endsolid t\n");
    write_text(folder / "b.stl", binary);
    for (const char* name : {"a.stl", "b.stl"}) {
        const MeshCheck c = check_mesh(read_mesh(folder / name));
        EXPECT_TRUE(c.closed_manifold()) << name;
        EXPECT_NEAR(c.volume, 1.0 / 6, 1e-9);
    }
    write_text(folder / "a.stl", ascii.substr(0, ascii.size() / 2));
    write_text(folder / "b.stl", binary.substr(0, binary.size() - 1));
    EXPECT_NE(why_refused(folder / "a.stl"), "");
    EXPECT_NE(why_refused(folder / "b.stl"), "");
}

TEST(Refused, InOneLine) {
    const Folder folder;
    const std::vector<std::array<std::string, 3>> table = {
        {"a.obj", "", "empty"},
        {"b.obj", "v 0 0 0\n", "no triangles"},
        {"c.obj", "v 0 0 zero\n", "line 1"},
        {"d.obj", "v 0 0 0\nf 1 2 3\n", "corner"},
        {"e.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3"},
        {"f.obj", "v 0 0 0\nf 0 1 2\n", "line 2"},
        {"g.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "finite"},
        {"a.off", "hello\n", "no OFF"},
        {"b.off", "OFF\n99999999999 1 0\n", "counts"},
        {"c.off", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n", "corner"},
        {"d.off", "nOFF\n1 1 0\n", "kind"},
        {"a.ply", "plyx\n", "no PLY"},
        {"b.ply",
         "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n",
         "truncated"},
        {"c.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
         "no x, y and z"},
        {"d.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty colour x\n", "unknown type"},
        {"a.glb", "glTF", "truncated"},
        {"b.glb", "something else altogether", "no .glb"},
        {"a.stl", "hello", "no STL"},
        {"a.3mf", "hello", "no .3mf"},
        {"b.3mf", "PK\x03\x04 and no more", "lib3mf"},
        {"a.fbx", "hello", "extension"},
    };
    for (const auto& [name, text, why] : table) {
        write_text(folder / name, text);
        EXPECT_NE(why_refused(folder / name).find(why), std::string::npos)
            << name << ": " << why_refused(folder / name);
    }
    EXPECT_NE(why_refused(folder / "none.obj").find("No such file"), std::string::npos);
}
