// .glb and .gltf as others write them: the same body however it is told.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/gltf_maker.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

using namespace glcast;
using namespace glcast::samples;
using Json = nlohmann::ordered_json;

namespace {

class ForeignGltf : public testing::Test {
  protected:
    Level read(const GltfMaker& maker) {
        write_text(folder / "f.glb", maker.glb());
        return read_levels(folder / "f.glb").at(0);
    }
    /// One closed body of that volume, its outside outside.
    void expect_volume(const Mesh& mesh, double volume) {
        const MeshCheck check = check_mesh(mesh, CheckDepth::everything);
        EXPECT_NEAR(check.volume, volume, 1e-5 * volume);
        EXPECT_TRUE(check.closed_manifold());
    }
    Folder folder;
};

const std::filesystem::path files = GLCAST_HOSTILE_FILES;

} // namespace

TEST_F(ForeignGltf, AMirroredNodeKeepsItsOutside) {
    expect_volume(read_mesh(files / "glb-negative-scale.glb"), 6);
    for (const Json& node :
         {Json{{"scale", {1, -2, 1}}}, Json{{"scale", {-1, -1, -2}}}, Json{{"scale", {-1, -2, 1}}},
          Json{{"matrix", {0, 2, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}}) {
        GltfMaker maker = box_gltf();
        maker.json["nodes"][0].update(node);
        expect_volume(read(maker).mesh, 12);
    }
    // Twice mirrored is not mirrored; normals point out of the surface in all cases.
    GltfMaker maker = box_gltf();
    std::vector<float> outwards;
    for (std::size_t k = 0; k < box_corners.size(); ++k)
        outwards.push_back(box_corners[k] > 0 ? 1.0f : -1.0f);
    maker.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = maker.floats(outwards);
    maker.json["nodes"][0]["scale"] = {-1, 1, 1};
    maker.json["nodes"].push_back({{"children", {0}}, {"scale", {1, 1, -1}}});
    const Mesh mesh = read(maker).mesh;
    expect_volume(mesh, 6);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        EXPECT_GT(glm::dot(glm::dvec3(mesh.normals[v]), mesh.positions[v] - glm::dvec3(-0.5, 1, -1.5)), 0);
}

TEST_F(ForeignGltf, WithoutASceneAllRootsAreShown) {
    expect_volume(read_mesh(files / "glb-no-scene.glb"), 6);
    GltfMaker maker = box_gltf(); // a grandchild, before its parents in the list, and a second root
    maker.json["nodes"] = {{{"mesh", 0}, {"scale", {2, 1, 1}}},
                           {{"children", {0}}, {"translation", {5, 0, 0}}},
                           {{"children", {1}}},
                           {{"mesh", 0}, {"translation", {-9, 0, 0}}}};
    expect_volume(read(maker).mesh, 18);
    maker.json["scenes"] = {{{"nodes", {3}}}, {{"nodes", {2}}}}; // and no "scene": the first
    expect_volume(read(maker).mesh, 6);
    maker.json["scene"] = 1;
    const Mesh mesh = read(maker).mesh;
    expect_volume(mesh, 12);
    for (const glm::dvec3& p : mesh.positions) EXPECT_GE(p.x, 5);
}

TEST_F(ForeignGltf, MaterialsOfPrimitivesAreColours) {
    const Mesh two = read_mesh(files / "glb-red-and-white.glb");
    expect_volume(two, 12);
    ASSERT_EQ(two.colours.size(), two.positions.size());
    for (std::size_t v = 0; v < two.positions.size(); ++v) {
        const glm::vec3 wanted = two.positions[v].x < 3 ? glm::vec3(1, 0, 0) : glm::vec3(1);
        EXPECT_LT(glm::distance(two.colours[v], wanted), 1e-6f) << v;
    }

    // Colours of vertices times the material's, one primitive beside one without either, 8 bits and floats.
    GltfMaker maker = box_gltf();
    std::vector<std::uint8_t> bytes;
    for (int v = 0; v < 8; ++v) bytes.insert(bytes.end(), {255, 255, 0, 255});
    const int colours = maker.add(bytes, 5121, "VEC4", 4);
    maker.json["accessors"][std::size_t(colours)]["normalized"] = true;
    const Json plain = maker.json["meshes"][0]["primitives"][0];
    Json coloured = plain;
    coloured["attributes"]["COLOR_0"] = colours;
    coloured["material"] = 0;
    maker.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.2158605, 1, 1}}}}}};
    maker.json["meshes"][0]["primitives"] = {plain, coloured};
    const Mesh mesh = read(maker).mesh;
    ASSERT_EQ(mesh.colours.size(), 16u);
    EXPECT_LT(glm::distance(mesh.colours[3], glm::vec3(1)), 1e-6f);
    EXPECT_NEAR(mesh.colours[11].x, 1, 1e-6);
    EXPECT_NEAR(mesh.colours[11].y, 128.0 / 255, 1e-3) << "linear light becomes display values";
    EXPECT_EQ(mesh.colours[11].z, 0);
    EXPECT_TRUE(read(box_gltf()).mesh.colours.empty()) << "white everywhere is no colour";
}

TEST_F(ForeignGltf, IndicesOfEverySizeAndNone) {
    for (const int component : {5121, 5123, 5125}) {
        GltfMaker maker;
        const int corners = maker.floats(box_corners);
        const int triangles =
            component == 5121 ? maker.add(std::vector<std::uint8_t>(box_indices.begin(), box_indices.end()),
                                          5121, "SCALAR", 1)
            : component == 5123
                ? maker.indices(box_indices)
                : maker.add(std::vector<std::uint32_t>(box_indices.begin(), box_indices.end()), 5125,
                            "SCALAR", 1);
        maker.mesh({{{"attributes", {{"POSITION", corners}}}, {"indices", triangles}}});
        expect_volume(read(maker).mesh, 6);
    }
    GltfMaker soup;
    std::vector<float> corners;
    for (const std::uint16_t v : box_indices)
        corners.insert(corners.end(), &box_corners[3 * v], &box_corners[3 * v] + 3);
    soup.mesh({{{"attributes", {{"POSITION", soup.floats(corners)}}}}});
    const Mesh mesh = read(soup).mesh;
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(check_mesh(mesh, CheckDepth::everything).volume, 6, 1e-5);
}

TEST_F(ForeignGltf, StripsAndFans) {
    GltfMaker maker;
    const int corners = maker.floats(box_corners);
    // The four walls as a strip, with a turn in it that joins two strips; floor and lid as fans.
    const int walls = maker.indices({0, 4, 3, 7, 2, 6, 6, 2, 2, 6, 1, 5, 0, 4}),
              floor = maker.indices({0, 3, 2, 1}), lid = maker.indices({4, 5, 6, 7});
    const auto primitive = [&](int indices, int mode) {
        return Json{{"attributes", {{"POSITION", corners}}}, {"indices", indices}, {"mode", mode}};
    };
    maker.mesh({primitive(walls, 5), primitive(floor, 6), primitive(lid, 6), primitive(floor, 1),
                primitive(floor, 0)});
    const Mesh mesh = read(maker).mesh;
    const MeshCheck check = check_mesh(mesh, CheckDepth::everything);
    EXPECT_EQ(check.degenerate_triangles, 0u);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(check.volume, 6, 1e-5);
}

TEST_F(ForeignGltf, SparseAccessors) {
    GltfMaker maker = box_gltf();
    std::vector<float> squashed = box_corners;
    for (std::size_t v = 4; v < 8; ++v) squashed[3 * v + 2] = 0;
    const int base = maker.floats(squashed), values = maker.floats({0, 0, 3, 1, 0, 3, 1, 2, 3, 0, 2, 3});
    const int where = maker.add(std::vector<std::uint8_t>{4, 5, 6, 7}, 5121, "SCALAR", 1);
    const auto view = [&](int accessor) {
        return maker.json["accessors"][std::size_t(accessor)]["bufferView"];
    };
    const Json sparse = {{"count", 4},
                         {"indices", {{"bufferView", view(where)}, {"componentType", 5121}}},
                         {"values", {{"bufferView", view(values)}}}};
    maker.json["accessors"][std::size_t(base)]["sparse"] = sparse;
    maker.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = base;
    expect_volume(read(maker).mesh, 6);
    // Of zeros but for what is told: the lid alone moves.
    maker.json["accessors"][std::size_t(base)].erase("bufferView");
    const Mesh mesh = read(maker).mesh;
    EXPECT_EQ(mesh.positions[0], glm::dvec3(0));
    EXPECT_EQ(mesh.positions[2], glm::dvec3(0));
    EXPECT_EQ(mesh.positions[6], glm::dvec3(1, 2, 3));
}

TEST_F(ForeignGltf, QuantizedPositions) {
    GltfMaker maker;
    std::vector<std::int16_t> shorts;
    for (std::size_t v = 0; v < 8; ++v) {
        for (std::size_t k = 0; k < 3; ++k) shorts.push_back(std::int16_t(box_corners[3 * v + k] * 100 - 50));
        shorts.push_back(0);
    }
    const int corners = maker.add(shorts, 5122, "VEC3", 4), triangles = maker.indices(box_indices);
    maker.json["bufferViews"][0]["byteStride"] = 8;
    maker.mesh({{{"attributes", {{"POSITION", corners}}}, {"indices", triangles}}});
    maker.json["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    expect_volume(read(maker).mesh, 6);
}

TEST_F(ForeignGltf, BuffersInUrisAndBesideTheFile) {
    GltfMaker maker = box_gltf();
    std::filesystem::create_directory(folder / "parts");
    write_text(folder / "parts" / "a box.bin", maker.bytes);
    const std::string wide = maker.bytes + "padding";
    write_text(folder / "wide.bin", wide);
    maker.json["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", "parts/a%20box.bin"}}};
    write_text(folder / "f.gltf", maker.gltf());
    expect_volume(read_mesh(folder / "f.gltf"), 6);
    write_text(folder / "f.glb", maker.glb());
    expect_volume(read_mesh(folder / "f.glb"), 6);
    maker.json["buffers"][0]["uri"] = "wide.bin";
    write_text(folder / "f.gltf", maker.gltf());
    expect_volume(read_mesh(folder / "f.gltf"), 6);
    // As base64, from wherever one stands.
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text, bytes = maker.bytes;
    ASSERT_EQ(bytes.size() % 3, 0u);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const auto byte = [&](std::size_t i) { return unsigned(static_cast<unsigned char>(bytes[k + i])); };
        const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (const int shift : {18, 12, 6, 0}) text += digits[three >> shift & 63];
    }
    maker.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + text;
    write_text(folder / "f.gltf", maker.gltf());
    expect_volume(read_mesh(folder / "f.gltf"), 6);
}

TEST_F(ForeignGltf, WhatIsRequiredAndNotReadIsRefused) {
    const auto why = [&](const GltfMaker& maker) {
        try {
            read(maker);
        } catch (const std::runtime_error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    GltfMaker maker = box_gltf();
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_NE(why(maker).find("KHR_draco_mesh_compression"), std::string::npos);
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_EQ(why(maker), "");
    maker.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = Json::object();
    EXPECT_NE(why(maker).find("EXT_mesh_gpu_instancing"), std::string::npos)
        << "else instances would be missing in silence";
}
