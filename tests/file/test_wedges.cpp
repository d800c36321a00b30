// Normals and colours of corners in files: what is written comes back, as the two-manifold that it was.
#include <gtest/gtest.h>

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <memory>
#include <set>

#include "tests/file/file_tools.h"
#include "tests/file/textured_torus.h"
#include "tools/io/glb_container.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

/// Each side with its own normal and colour: 8 vertices, 24 wedges.
Level cube(const char* name = "level 0") {
    Level level{{}, name, {}, 0.1};
    for (int v = 0; v < 8; ++v) level.mesh.positions.emplace_back(v & 1, v >> 1 & 1, v >> 2);
    CornerValues normals, colours;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3,
                                from = side ? 1u << axis : 0;
            const std::uint32_t b = side ? from + u : from + v, d = side ? from + v : from + u;
            level.mesh.triangles.push_back({from, b, from + u + v});
            level.mesh.triangles.push_back({from, from + u + v, d});
            glm::vec3 normal(0), colour(0.2f);
            normal[axis] = side ? 1 : -1;
            colour[axis] = side ? 1 : 0.6f;
            for (int k = 0; k < 2; ++k) {
                normals.push_back({normal, normal, normal});
                colours.push_back({colour, colour, colour});
            }
        }
    level.wedges = take_corner_values(level.mesh, normals, colours);
    return level;
}

/// A texture's seams and creases at other places.
Level creased_torus() {
    Level level = textured_torus(12, 8, 32);
    CornerValues normals(level.mesh.triangles.size());
    for (std::size_t t = 0; t < normals.size(); ++t)
        normals[t].fill(t % 5 == 0 ? glm::vec3(0, 0, 1) : level.mesh.normals[level.mesh.triangles[t][0]]);
    level.wedges = take_corner_values(level.mesh, normals, {});
    return level;
}

/// Triangles by the places, normals and colours of their corners, in thousandths, whatever their order.
auto by_place(const Level& level, bool normals, bool colours, float step = 1e-3f) {
    std::multiset<std::vector<long>> all;
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
        std::array<std::vector<long>, 3> corners;
        for (int k = 0; k < 3; ++k) {
            const auto add = [&](const glm::vec3& v, float by) {
                for (int c = 0; c < 3; ++c) corners[k].push_back(std::lround(v[c] / by));
            };
            add(glm::vec3(level.mesh.positions[level.mesh.triangles[t][k]]), 1e-3f);
            if (normals) add(corner_normals(level.mesh, level.wedges, t)[k], step);
            if (colours) add(corner_colours(level.mesh, level.wedges, t)[k], step);
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::vector<long> one;
        for (const auto& corner : corners) one.insert(one.end(), corner.begin(), corner.end());
        all.insert(one);
    }
    return all;
}

void expect_closed(const Level& read, std::size_t vertices) {
    const MeshCheck check = check_mesh(read.mesh);
    EXPECT_TRUE(check.closed_manifold()) << describe(check);
    EXPECT_EQ(check.vertices, vertices);
    EXPECT_TRUE(fits(read.mesh, read.wedges));
}

struct Scene {
    explicit Scene(const std::string& path) : scene(aiImportFile(path.c_str(), 0), aiReleaseImport) {}
    std::unique_ptr<const aiScene, decltype(&aiReleaseImport)> scene;
};

} // namespace

TEST(WedgesInFiles, ComeBackFromGlb) {
    const Folder folder;
    for (const Compression compression : {Compression::none, Compression::quantize, Compression::meshopt}) {
        SCOPED_TRACE(int(compression));
        std::vector levels{cube(), cube("level 1")};
        round_levels(levels, compression);
        write_levels(folder / "c.glb", levels, {.compression = compression});
        for (const Level& read : read_levels(folder / "c.glb")) {
            expect_closed(read, 8);
            EXPECT_EQ(read.wedges.normals.size(), 24u);
            EXPECT_TRUE(by_place(read, true, true) == by_place(levels[0], true, true));
        }
    }
}

TEST(WedgesInFiles, ComeBackFromPlyAndObj) {
    const Folder folder;
    const Level level = cube();
    write_levels(folder / "c.ply", std::vector{level});
    const Level ply = read_levels(folder / "c.ply").at(0);
    expect_closed(ply, 8);
    EXPECT_EQ(ply.wedges.normals.size(), 24u);
    EXPECT_TRUE(by_place(ply, true, true) == by_place(level, true, true));
    write_levels(folder / "c.obj", std::vector{level});
    const Level obj = read_levels(folder / "c.obj").at(0);
    expect_closed(obj, 8);
    EXPECT_EQ(obj.wedges.normals.size(), 24u);
    EXPECT_TRUE(by_place(obj, true, true) == by_place(level, true, true)) << "a material a colour";
}

TEST(WedgesInFiles, StandBesideSeamsOfATexture) {
    const Folder folder;
    const Level level = creased_torus();
    ASSERT_FALSE(level.wedges.empty());
    for (const char* name : {"t.glb", "t.obj", "t.ply"}) {
        SCOPED_TRACE(name);
        write_levels(folder / name, std::vector{level});
        const Level read = read_levels(folder / name).at(0);
        expect_closed(read, 96);
        EXPECT_TRUE(by_place(read, true, false) == by_place(level, true, false));
        if (std::string(name) == "t.glb") {
            EXPECT_EQ(read.texture.coordinates, level.texture.coordinates);
        }
    }
}

/// In .glb a mesh for each of the six colours, with vertices of its own.
TEST(WedgesInFiles, AreSplitVerticesForOthers) {
    const Folder folder;
    write_levels(folder / "c.glb", std::vector{cube()});
    write_levels(folder / "c.obj", std::vector{cube()});
    for (const char* name : {"c.glb", "c.obj"}) {
        SCOPED_TRACE(name);
        const Scene read((folder / name).string());
        ASSERT_TRUE(read.scene) << aiGetErrorString();
        ASSERT_EQ(read.scene->mNumMeshes, std::string(name) == "c.glb" ? 6u : 1u);
        unsigned faces = 0, vertices = 0;
        for (unsigned m = 0; m < read.scene->mNumMeshes; ++m) {
            const aiMesh& mesh = *read.scene->mMeshes[m];
            faces += mesh.mNumFaces, vertices += mesh.mNumVertices;
            EXPECT_FALSE(mesh.HasVertexColors(0)) << "they would be multiplied by the material's";
            ASSERT_TRUE(mesh.HasNormals());
            for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
                const auto& i = mesh.mFaces[f].mIndices;
                const aiVector3D face = ((mesh.mVertices[i[1]] - mesh.mVertices[i[0]]) ^
                                         (mesh.mVertices[i[2]] - mesh.mVertices[i[0]]))
                                            .Normalize();
                for (int k = 0; k < 3; ++k) EXPECT_GT(face * mesh.mNormals[i[k]], 0.999f) << f;
            }
        }
        EXPECT_EQ(faces, 12u);
        if (std::string(name) == "c.glb") {
            EXPECT_EQ(vertices, 24u);
        }
    }
}

/// Blender 3.4 and Godot 3.2 show no COLOR_0; all multiply it by the material's.
TEST(PlainColours, AreMaterialsInGlb) {
    const Folder folder;
    Level one = cube(), mixed = cube();
    std::fill(one.mesh.colours.begin(), one.mesh.colours.end(), glm::vec3(0.2f, 0.5f, 1));
    one.wedges.colours.clear();
    mixed.wedges.colours[0] = {1, 1, 1};
    const auto json_of = [&](const Level& level) {
        write_levels(folder / "c.glb", std::vector{level});
        return format::glb_chunks(read_text(folder / "c.glb")).json;
    };
    for (const auto& [level, materials] : {std::pair{one, 1u}, {cube(), 6u}}) {
        const auto json = json_of(level);
        EXPECT_EQ(json["materials"].size(), materials);
        EXPECT_EQ(json["meshes"].size(), 1u);
        ASSERT_EQ(json["meshes"][0]["primitives"].size(), materials);
        for (const auto& primitive : json["meshes"][0]["primitives"]) {
            EXPECT_FALSE(primitive["attributes"].contains("COLOR_0"));
            EXPECT_TRUE(json["materials"][primitive["material"].get<int>()]["pbrMetallicRoughness"].contains(
                "baseColorFactor"));
        }
        const Level read = read_levels(folder / "c.glb").at(0);
        expect_closed(read, 8);
        EXPECT_TRUE(by_place(read, true, true) == by_place(level, true, true));
    }
    const auto json = json_of(mixed);
    ASSERT_EQ(json["meshes"][0]["primitives"].size(), 1u);
    EXPECT_TRUE(json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
    EXPECT_FALSE(json["materials"][0]["pbrMetallicRoughness"].contains("baseColorFactor"));
    EXPECT_TRUE(by_place(read_levels(folder / "c.glb").at(0), true, true) == by_place(mixed, true, true));
}

/// What says which vertices are one may be damaged: then they stay apart.
TEST(PlainColours, StayApartWhereTheFileDoesNotFit) {
    const Folder folder;
    write_levels(folder / "c.glb", std::vector{cube()});
    const std::string file = read_text(folder / "c.glb");
    format::GlbChunks chunks = format::glb_chunks(file);
    const auto primitive = chunks.json["meshes"][0]["primitives"][0];
    for (const int wrong :
         {primitive["indices"].get<int>(), primitive["attributes"]["POSITION"].get<int>(), 1000}) {
        chunks.json["meshes"][0]["extras"]["vertices"] = wrong;
        const std::string_view bytes = chunks.bytes;
        write_text(folder / "d.glb", format::glb_head(chunks.json, bytes.size()) + std::string(bytes) +
                                         std::string(format::glb_padding(bytes.size()), '\0'));
        EXPECT_EQ(read_levels(folder / "d.glb").at(0).mesh.positions.size(), 24u) << wrong;
    }
}

TEST(PlainColours, AreAPictureInObjAndOthersHaveALine) {
    const Folder folder;
    write_levels(folder / "c.obj", std::vector{cube()});
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"c.colour.png", "c.mtl", "c.obj"}));
    EXPECT_EQ(note_on(folder / "c.obj", cube()), "");
    const std::string obj = read_text(folder / "c.obj"), mtl = read_text(folder / "c.mtl");
    EXPECT_NE(obj.find("vt 0.0625 0.5\n"), obj.npos) << "the first of eight squares";
    EXPECT_NE(mtl.find("Kd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd c.colour.png\n"), mtl.npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "c.colour.png"));
    EXPECT_NE(obj.find("v 1 1 1\n"), obj.npos) << "no colours behind: readers multiply them";
    Level mixed = cube();
    mixed.wedges.colours[0] = {1, 1, 1};
    EXPECT_NE(note_on(folder / "c.obj", mixed).find("one colour"), std::string::npos);
    EXPECT_NE(note_on(folder / "c.off", cube()).find("one colour"), std::string::npos);
    EXPECT_EQ(note_on(folder / "c.ply", mixed), "");
    EXPECT_EQ(note_on(folder / "c.obj", creased_torus()), "") << "a texture has them";
}

TEST(WedgesInFiles, KhronosValidatorFindsNothing) {
    const Folder folder;
    int k = 0;
    for (const Compression compression : {Compression::none, Compression::quantize, Compression::meshopt})
        for (const Level& level : {cube(), creased_torus()})
            write_levels(folder / (std::to_string(k++) + ".glb"), std::vector{level},
                         {.compression = compression});
    const Ran ran = run("node " GLCAST_VALIDATE " " + folder.path().string() + "/*.glb");
    EXPECT_EQ(ran.status, 0) << ran.output;
}

/// Corners of a vertex with the same values are one wedge; a vertex without a second needs none.
TEST(WedgesInFiles, EqualCornersAreNoWedges) {
    Mesh mesh = torus(12, 8);
    CornerValues normals;
    for (const Triangle& t : mesh.triangles)
        normals.push_back({mesh.normals[t[0]], mesh.normals[t[1]], mesh.normals[t[2]]});
    const std::vector<glm::vec3> before = mesh.normals;
    EXPECT_TRUE(take_corner_values(mesh, normals, {}).empty());
    EXPECT_EQ(mesh.normals, before);
    normals[0][0] = {0, 1, 0};
    const Wedges one = take_corner_values(mesh, normals, {});
    EXPECT_EQ(one.normals.size(), mesh.positions.size() + 1);
    EXPECT_TRUE(one.colours.empty());
}

/// What a file holds is what was checked; what floats would spoil stays.
TEST(Floats, HoldWhatIsCheckedBefore) {
    const Folder folder;
    Level level{torus(12, 8), "level 0"};
    const std::vector<glm::dvec3> before = level.mesh.positions;
    hold_in_floats(level.mesh);
    EXPECT_NE(level.mesh.positions, before);
    write_levels(folder / "t.ply", std::vector{level});
    EXPECT_NE(read_text(folder / "t.ply").find("property float x"), std::string::npos);
    for (const char* name : {"t.ply", "t.glb"}) {
        write_levels(folder / name, std::vector{level});
        EXPECT_EQ(read_mesh(folder / name).positions, level.mesh.positions) << name;
    }
    Mesh far = torus(12, 8), close = torus(12, 8);
    for (glm::dvec3& p : far.positions) p.x += 4'500'000;
    close.positions[1] = close.positions[0] + glm::dvec3(1e-12, 0, 0);
    for (Mesh* mesh : {&far, &close}) {
        const std::vector<glm::dvec3> kept = mesh->positions;
        hold_in_floats(*mesh);
        EXPECT_EQ(mesh->positions, kept);
    }
}
