// .stl and .3mf, the formats of printers: read back by our reader, assimp and lib3mf.
#include <gtest/gtest.h>

#include <Model/COM/NMR_DLLInterfaces.h>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <cstring>
#include <map>

#include "tests/file/file_tools.h"
#include "tests/file/sample_meshes.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

Level level_of(Mesh mesh) { return {std::move(mesh), "level 0"}; }

Mesh moved(Mesh mesh, const glm::dvec3& by) {
    for (auto& p : mesh.positions) p += by;
    return mesh;
}

void write(const std::filesystem::path& path, const Level& level, std::string_view units = "mm") {
    WriteOptions options;
    options.units = length_unit(units);
    write_levels(path, {&level, 1}, options);
}

/// As assimp finds it, equal places joined.
Mesh by_assimp(const std::filesystem::path& path) {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
    Mesh mesh;
    if (!scene) return mesh;
    std::map<std::array<float, 3>, std::uint32_t> seen;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMesh& part = *scene->mMeshes[m];
        for (unsigned t = 0; t < part.mNumFaces; ++t) {
            Triangle triangle{};
            for (unsigned k = 0; k < 3; ++k) {
                const aiVector3D& p = part.mVertices[part.mFaces[t].mIndices[k]];
                const auto [at, is_new] =
                    seen.try_emplace({p.x, p.y, p.z}, std::uint32_t(mesh.positions.size()));
                if (is_new) mesh.positions.emplace_back(p.x, p.y, p.z);
                triangle[k] = at->second;
            }
            mesh.triangles.push_back(triangle);
        }
    }
    return mesh;
}

} // namespace

TEST(Stl, ComesBackClosed) {
    const Folder folder;
    const Mesh mesh = torus(60, 40);
    write(folder / "t.stl", level_of(mesh), "cm");
    for (const Mesh& read : {read_mesh(folder / "t.stl"), by_assimp(folder / "t.stl")}) {
        const MeshCheck check = check_mesh(read, CheckDepth::everything);
        EXPECT_TRUE(check.closed_manifold());
        EXPECT_EQ(check.triangles, mesh.triangles.size());
        EXPECT_NEAR(check.volume, 1000 * check_mesh(mesh).volume, 0.01 * check.volume); // millimetres
    }
}

/// Vertices that floats would join stay apart, and far from the origin the mesh is moved.
TEST(Stl, FloatsJoinNothing) {
    const Folder folder;
    Mesh twice = tetrahedron();
    const Mesh other = moved(tetrahedron(), {1e-12, 0, 0});
    for (const Triangle& t : other.triangles) twice.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    twice.positions.insert(twice.positions.end(), other.positions.begin(), other.positions.end());
    twice.normals.clear(), twice.colours.clear();
    write(folder / "two.stl", level_of(twice));
    EXPECT_TRUE(check_mesh(read_mesh(folder / "two.stl")).closed_manifold());
    EXPECT_EQ(read_mesh(folder / "two.stl").positions.size(), 8u);
    const Level far = level_of(moved(torus(60, 40), {4500000, 0, 0.25}));
    write(folder / "far.stl", far);
    EXPECT_NE(note_on(folder / "far.stl", far).find("moved by (-4500000, 0, 0)"), std::string::npos);
    EXPECT_EQ(note_on(folder / "far.ply", far), "");
    const MeshCheck check = check_mesh(read_mesh(folder / "far.stl"), CheckDepth::everything);
    EXPECT_TRUE(check.closed_manifold());
    EXPECT_EQ(check.self_intersections, 0u);
    EXPECT_NE(read_text(folder / "far.stl").substr(0, 80).find("moved by"), std::string::npos);
}

TEST(ThreeMf, ReadBackByLib3mfWithUnitAndColours) {
    using namespace NMR;
    const Folder folder;
    const Mesh mesh = torus(20, 12);
    write(folder / "t.3mf", level_of(mesh), "inch");
    PLib3MFBase *model = nullptr, *reader = nullptr, *objects = nullptr, *object = nullptr,
                *handler = nullptr;
    ASSERT_EQ(lib3mf_createmodel(&model), 0);
    ASSERT_EQ(lib3mf_model_queryreader(model, "3mf", &reader), 0);
    ASSERT_EQ(lib3mf_reader_readfromfileutf8(reader, (folder / "t.3mf").c_str()), 0);
    DWORD unit = 0, vertices = 0, triangles = 0;
    ASSERT_EQ(lib3mf_model_getunit(model, &unit), 0);
    EXPECT_EQ(unit, DWORD(MODELUNIT_INCH));
    ASSERT_EQ(lib3mf_model_getmeshobjects(model, &objects), 0);
    BOOL there = false;
    ASSERT_EQ(lib3mf_resourceiterator_movenext(objects, &there), 0);
    ASSERT_TRUE(there);
    ASSERT_EQ(lib3mf_resourceiterator_getcurrent(objects, &object), 0);
    ASSERT_EQ(lib3mf_meshobject_getvertexcount(object, &vertices), 0);
    ASSERT_EQ(lib3mf_meshobject_gettrianglecount(object, &triangles), 0);
    EXPECT_EQ(vertices, mesh.positions.size());
    EXPECT_EQ(triangles, mesh.triangles.size());
    BOOL closed = false;
    ASSERT_EQ(lib3mf_meshobject_ismanifoldandoriented(object, &closed), 0);
    EXPECT_TRUE(closed);
    ASSERT_EQ(lib3mf_meshobject_createpropertyhandler(object, &handler), 0);
    for (DWORD t = 0; t < triangles; ++t) {
        MODELMESHTRIANGLE corners;
        MODELMESH_TRIANGLECOLOR_SRGB colours;
        ASSERT_EQ(lib3mf_meshobject_gettriangle(object, t, &corners), 0);
        ASSERT_EQ(lib3mf_propertyhandler_getcolor(handler, t, &colours), 0);
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& wanted = mesh.colours[corners.m_nIndices[k]];
            ASSERT_NEAR(colours.m_Colors[k].m_Red, wanted.x * 255, 1);
            ASSERT_NEAR(colours.m_Colors[k].m_Green, wanted.y * 255, 1);
            ASSERT_NEAR(colours.m_Colors[k].m_Blue, wanted.z * 255, 1);
        }
    }
    for (PLib3MFBase* of : {handler, object, objects, reader, model}) lib3mf_release(of);
}

namespace {

/// A .3mf of lib3mf's own making, as other programs write it.
class Made {
  public:
    Made() { ok(NMR::lib3mf_createmodel(&model)); }
    ~Made() {
        for (NMR::PLib3MFBase* of : handles) NMR::lib3mf_release(of);
        NMR::lib3mf_release(model);
    }
    NMR::PLib3MFBase* mesh(const Mesh& from) {
        NMR::PLib3MFBase* object = nullptr;
        ok(NMR::lib3mf_model_addmeshobject(model, &object));
        for (const glm::dvec3& p : from.positions) {
            NMR::MODELMESHVERTEX vertex{{float(p.x), float(p.y), float(p.z)}};
            ok(NMR::lib3mf_meshobject_addvertex(object, &vertex, nullptr));
        }
        for (const Triangle& t : from.triangles) {
            NMR::MODELMESHTRIANGLE triangle{{t[0], t[1], t[2]}};
            ok(NMR::lib3mf_meshobject_addtriangle(object, &triangle, nullptr));
        }
        return kept(object);
    }
    NMR::PLib3MFBase* assembly(const std::vector<NMR::PLib3MFBase*>& parts, NMR::MODELTRANSFORM transform) {
        NMR::PLib3MFBase *object = nullptr, *component = nullptr;
        ok(NMR::lib3mf_model_addcomponentsobject(model, &object));
        for (NMR::PLib3MFBase* part : parts) {
            ok(NMR::lib3mf_componentsobject_addcomponent(object, part, &transform, &component));
            kept(component);
        }
        return kept(object);
    }
    /// The object's colour, of a group of base materials.
    void paint(NMR::PLib3MFBase* object, std::array<BYTE, 3> colour) {
        NMR::PLib3MFBase *group = nullptr, *whole = nullptr;
        DWORD id = 0, index = 0;
        ok(NMR::lib3mf_model_addbasematerialgroup(model, &group));
        ok(NMR::lib3mf_basematerial_addmaterialutf8(kept(group), "paint", colour[0], colour[1], colour[2],
                                                    &index));
        ok(NMR::lib3mf_resource_getresourceid(group, &id));
        ok(NMR::lib3mf_object_createdefaultpropertyhandler(object, &whole));
        ok(NMR::lib3mf_defaultpropertyhandler_setbasematerial(kept(whole), id, index));
    }
    void build(NMR::PLib3MFBase* object, NMR::MODELTRANSFORM transform) {
        NMR::PLib3MFBase* item = nullptr;
        ok(NMR::lib3mf_model_addbuilditem(model, object, &transform, &item));
        kept(item);
    }
    void write(const std::filesystem::path& path) {
        NMR::PLib3MFBase* writer = nullptr;
        ok(NMR::lib3mf_model_querywriter(model, "3mf", &writer));
        ok(NMR::lib3mf_writer_writetofileutf8(kept(writer), path.c_str()));
    }

  private:
    static void ok(LIB3MFRESULT result) { ASSERT_EQ(result, 0); }
    NMR::PLib3MFBase* kept(NMR::PLib3MFBase* of) { return handles.emplace_back(of); }

    NMR::PLib3MFBase* model = nullptr;
    std::vector<NMR::PLib3MFBase*> handles;
};

constexpr NMR::MODELTRANSFORM moved_by_ten{{{1, 0, 0, 10}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
    mirrored_and_doubled{{{-2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 5}}};

} // namespace

TEST(ThreeMf, ComesBackWithItsColours) {
    const Folder folder;
    const Level level = level_of(torus(20, 12));
    write(folder / "t.3mf", level, "inch");
    const Level read = read_levels(folder / "t.3mf").at(0);
    const MeshCheck check = check_mesh(read.mesh);
    EXPECT_TRUE(check.closed_manifold());
    EXPECT_NEAR(check.volume, check_mesh(level.mesh).volume, 1e-5) << "in its own units";
    ASSERT_EQ(read.mesh.positions.size(), level.mesh.positions.size());
    ASSERT_EQ(read.mesh.colours.size(), level.mesh.colours.size());
    for (std::size_t v = 0; v < read.mesh.positions.size(); ++v) {
        EXPECT_LT(glm::distance(read.mesh.positions[v], level.mesh.positions[v]), 1e-5);
        EXPECT_LT(glm::distance(read.mesh.colours[v], level.mesh.colours[v]), 0.005f);
    }
}

/// What is built, with the transforms on the way; what lies in the file and is not built is not there.
TEST(ThreeMf, OfOthersIsReadWithTransformsAndMaterials) {
    const Folder folder;
    Made made;
    NMR::PLib3MFBase* const part = made.mesh(tetrahedron());
    made.paint(part, {200, 100, 50});
    made.mesh(torus(6, 4));
    made.build(made.assembly({part, part}, moved_by_ten), mirrored_and_doubled);
    made.build(part, moved_by_ten);
    made.write(folder / "a.3mf");
    const Level read = read_levels(folder / "a.3mf").at(0);
    const MeshCheck check = check_mesh(read.mesh);
    EXPECT_TRUE(check.closed_manifold());
    EXPECT_EQ(check.triangles, 12u);
    EXPECT_NEAR(check.volume, (2 * 8 + 1) / 6.0, 1e-6) << "a mirrored one keeps its outside";
    EXPECT_NEAR(read.mesh.positions[0].x, -20, 1e-6);
    EXPECT_NEAR(read.mesh.positions[0].z, 5, 1e-6);
    EXPECT_NEAR(read.mesh.positions[8].x, 10, 1e-6);
    ASSERT_FALSE(read.mesh.colours.empty());
    for (const glm::vec3& colour : read.mesh.colours)
        EXPECT_LT(glm::distance(colour, glm::vec3(200, 100, 50) / 255.0f), 0.005f);
}

/// Components of components that double: refused before there is a billion of them.
TEST(ThreeMf, AFileThatMultipliesIsRefused) {
    const Folder folder;
    Made made;
    NMR::PLib3MFBase* object = made.mesh(tetrahedron());
    for (int k = 0; k < 30; ++k) object = made.assembly({object, object}, moved_by_ten);
    made.build(object, moved_by_ten);
    made.write(folder / "many.3mf");
    try {
        read_levels(folder / "many.3mf");
        ADD_FAILURE() << "was read";
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
}
