// What we write, read by glTF-Transform: all levels, compressed or not, have the same counts, bounds and
// textures.
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/textured_torus.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

void expect_level(const nlohmann::json& found, const Level& level, std::uint32_t u, std::uint32_t v) {
    SCOPED_TRACE(level.name + " " + found.dump());
    EXPECT_EQ(found["triangles"], level.mesh.triangles.size());
    const std::size_t seams = level.texture.empty() ? 0 : (u + 1) * (v + 1) - u * v;
    EXPECT_EQ(found["vertices"], level.mesh.positions.size() + seams);
    glm::dvec3 lo(1e30), hi(-1e30);
    for (const glm::dvec3& p : level.mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found["lo"][i].get<double>(), lo[i], 3e-5);
        EXPECT_NEAR(found["hi"][i].get<double>(), hi[i], 3e-5);
    }
    const auto has = [&](const char* name) {
        const auto& names = found["attributes"];
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    EXPECT_TRUE(has("NORMAL"));
    EXPECT_EQ(has("TANGENT") && has("TEXCOORD_0"), !level.texture.empty());
}

} // namespace

TEST(GltfTransform, ReadsEveryLevel) {
    const Folder folder;
    const std::vector textured{textured_torus(96, 48, 128), textured_torus(12, 8, 64, "level 1")};
    std::vector plain = textured;
    for (Level& level : plain) level.texture = {};
    std::string files;
    for (const bool has_texture : {false, true})
        for (const Compression compression :
             {Compression::none, Compression::quantize, Compression::meshopt}) {
            const auto path =
                folder / ((has_texture ? "textured" : "plain") + std::to_string(int(compression)) + ".glb");
            write_levels(path, has_texture ? textured : plain, {.compression = compression});
            files += " " + path.string();
        }
    const Ran ran = run(GLCAST_NODE " " GLCAST_TRANSFORM + files + " 2>&1");
    ASSERT_EQ(ran.status, 0) << ran.output;
    const auto found = nlohmann::json::parse(ran.output, nullptr, false);
    ASSERT_EQ(found.size(), 6u) << ran.output;
    for (std::size_t k = 0; k < 6; ++k) {
        SCOPED_TRACE("file " + std::to_string(k));
        const auto& levels = k < 3 ? plain : textured;
        ASSERT_EQ(found[k]["levels"].size(), 2u);
        expect_level(found[k]["levels"][0], levels[0], 96, 48);
        expect_level(found[k]["levels"][1], levels[1], 12, 8);
        const auto sizes =
            k < 3 ? nlohmann::json::array() : nlohmann::json({{128, 128}, {128, 128}, {64, 64}, {64, 64}});
        EXPECT_EQ(found[k]["textures"], sizes);
    }
}
