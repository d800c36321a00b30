// What we write, read by assimp: the same counts, bounds and colours.
#include <gtest/gtest.h>

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/common.hpp>
#include <cmath>
#include <memory>

#include "tests/file/file_tools.h"
#include "tests/file/textured_torus.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

struct Bounds {
    glm::dvec3 lo{1e30}, hi{-1e30};
    void add(const glm::dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
};

Bounds bounds(const Mesh& mesh) {
    Bounds b;
    for (const glm::dvec3& p : mesh.positions) b.add(p);
    return b;
}

struct Scene {
    explicit Scene(const std::string& path)
        : scene(aiImportFile(path.c_str(), aiProcess_JoinIdenticalVertices), aiReleaseImport) {}
    std::unique_ptr<const aiScene, decltype(&aiReleaseImport)> scene;
};

void expect_same(const aiMesh& read, const Mesh& mesh) {
    EXPECT_EQ(read.mNumFaces, mesh.triangles.size());
    EXPECT_EQ(read.mNumVertices, mesh.positions.size());
    Bounds is;
    for (unsigned v = 0; v < read.mNumVertices; ++v)
        is.add({read.mVertices[v].x, read.mVertices[v].y, read.mVertices[v].z});
    const Bounds wanted = bounds(mesh);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(is.lo[k], wanted.lo[k], 1e-5);
        EXPECT_NEAR(is.hi[k], wanted.hi[k], 1e-5);
    }
    ASSERT_TRUE(read.HasVertexColors(0));
    double red = 0, red_wanted = 0;
    for (unsigned v = 0; v < read.mNumVertices; ++v) red += read.mColors[0][v].r;
    for (const glm::vec3& c : mesh.colours) red_wanted += c.r;
    EXPECT_NEAR(red / read.mNumVertices, red_wanted / double(mesh.colours.size()), 0.003);
}

} // namespace

TEST(Assimp, ReadsWhatWeWrite) {
    const Folder folder;
    const std::vector<Level> levels = {{torus(48, 24), "level 0", {}, 0.1, {}},
                                       {torus(12, 8), "level 1", {.mean = 0.1, .max = 0.2}, 0.1, {}}};
    for (const char* extension : {".glb", ".obj", ".ply", ".off"}) {
        SCOPED_TRACE(extension);
        const auto files = write_levels(folder / (std::string("t") + extension), levels);
        const bool glb = std::string(extension) == ".glb";
        ASSERT_EQ(files.size(), 2u);
        for (std::size_t k = 0; k < files.size(); ++k) {
            const Scene read(files[k]);
            ASSERT_TRUE(read.scene) << aiGetErrorString();
            ASSERT_EQ(read.scene->mNumMeshes, 1u);
            Mesh wanted = levels[k].mesh;
            if (glb) // linear light
                for (glm::vec3& c : wanted.colours)
                    c.r = c.r <= 0.04045f ? c.r / 12.92f : std::pow((c.r + 0.055f) / 1.055f, 2.4f);
            expect_same(*read.scene->mMeshes[0], wanted);
        }
    }
}

namespace {

/// Positions of all vertices; textures cut along seams, so there are more than the mesh has.
Bounds bounds(const aiMesh& mesh) {
    Bounds b;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
        b.add({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
    return b;
}

} // namespace

TEST(Assimp, ReadsTextures) {
    const Folder folder;
    const Level level = textured_torus(48, 24);
    for (const char* extension : {".glb", ".obj"}) {
        SCOPED_TRACE(extension);
        const auto path = write_levels(folder / (std::string("t") + extension), std::vector{level}).front();
        const Scene read(path);
        ASSERT_TRUE(read.scene) << aiGetErrorString();
        ASSERT_EQ(read.scene->mNumMeshes, 1u);
        const aiMesh& mesh = *read.scene->mMeshes[0];
        EXPECT_EQ(mesh.mNumFaces, level.mesh.triangles.size());
        EXPECT_EQ(mesh.mNumVertices, 49u * 25u) << "the seams once more, and where they cross";
        const Bounds is = bounds(mesh), wanted = bounds(level.mesh);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(is.lo[k], wanted.lo[k], 1e-5);
            EXPECT_NEAR(is.hi[k], wanted.hi[k], 1e-5);
        }
        ASSERT_TRUE(mesh.HasTextureCoords(0));
        EXPECT_FALSE(mesh.HasVertexColors(0));
        const aiMaterial& material = *read.scene->mMaterials[mesh.mMaterialIndex];
        aiString colour, normal;
        EXPECT_EQ(aiGetMaterialTexture(&material, aiTextureType_DIFFUSE, 0, &colour), aiReturn_SUCCESS);
        EXPECT_EQ(aiGetMaterialTexture(&material, aiTextureType_NORMALS, 0, &normal), aiReturn_SUCCESS);
        if (std::string(extension) == ".glb") {
            ASSERT_EQ(read.scene->mNumTextures, 2u);
            EXPECT_EQ(std::string(read.scene->mTextures[0]->achFormatHint), "png");
        } else
            EXPECT_EQ(std::string(colour.C_Str()), "t.colour.png");
    }
}
