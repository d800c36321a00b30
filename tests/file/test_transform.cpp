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
            const auto& levels = has_texture ? textured : plain;
            write_levels(path, levels, {.compression = compression, .one_file = true});
            files += " " + path.string();
            for (const auto& file : write_levels(folder / ("each" + path.filename().string()), levels,
                                                 {.compression = compression}))
                files += " " + file.string();
        }
    const Ran ran = run(GLCAST_NODE " " GLCAST_TRANSFORM + files + " 2>&1");
    ASSERT_EQ(ran.status, 0) << ran.output;
    const auto found = nlohmann::json::parse(ran.output, nullptr, false);
    ASSERT_EQ(found.size(), 18u) << ran.output;
    for (std::size_t k = 0; k < 6; ++k) {
        SCOPED_TRACE("run " + std::to_string(k));
        const auto& levels = k < 3 ? plain : textured;
        const auto &both = found[3 * k], &fine = found[3 * k + 1], &coarse = found[3 * k + 2];
        ASSERT_EQ(both["levels"].size(), 2u);
        ASSERT_EQ(fine["levels"].size(), 1u);
        ASSERT_EQ(coarse["levels"].size(), 1u);
        expect_level(both["levels"][0], levels[0], 96, 48);
        expect_level(both["levels"][1], levels[1], 12, 8);
        expect_level(fine["levels"][0], levels[0], 96, 48);
        expect_level(coarse["levels"][0], levels[1], 12, 8);
        const auto pictures = [&](const nlohmann::json& sizes) {
            return k < 3 ? nlohmann::json::array() : sizes;
        };
        EXPECT_EQ(both["textures"], pictures({{128, 128}, {128, 128}, {64, 64}, {64, 64}}));
        EXPECT_EQ(fine["textures"], pictures({{128, 128}, {128, 128}}));
        EXPECT_EQ(coarse["textures"], pictures({{64, 64}, {64, 64}}));
    }
}
