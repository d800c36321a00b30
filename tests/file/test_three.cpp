// What we write, read by three.js in Debian's Chromium: the same counts, bounds, pictures and colours.
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/textured_torus.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;

TEST(Three, ReadsWhatWeWrite) {
    const Folder folder;
    Level textured = textured_torus(96, 48, 128), plain = textured;
    plain.texture = {};
    const Level coarse{torus(12, 8), "level 1"};
    std::string files;
    for (const char* name : {"plain", "textured"})
        for (const Compression compression :
             {Compression::none, Compression::quantize, Compression::meshopt}) {
            const auto path = folder / (name + std::to_string(int(compression)) + ".glb");
            write_levels(path, std::vector{*name == 'p' ? plain : textured, coarse},
                         {.compression = compression, .one_file = true});
            files += " " + path.string();
        }
    const Ran ran = run(GLCAST_NODE " " GLCAST_THREE " chromium " GLCAST_MODULES + files + " 2>&1");
    ASSERT_EQ(ran.status, 0) << ran.output;
    const auto found = nlohmann::json::parse(ran.output, nullptr, false);
    ASSERT_EQ(found.size(), 6u) << ran.output;

    glm::dvec3 lo(1e30), hi(-1e30);
    for (const glm::dvec3& p : textured.mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    for (std::size_t k = 0; k < 6; ++k) {
        SCOPED_TRACE(found[k].dump());
        const bool with_texture = k >= 3;
        EXPECT_EQ(found[k]["meshes"], 1) << "the scene shows level 0 alone";
        EXPECT_EQ(found[k]["triangles"], textured.mesh.triangles.size());
        const std::size_t copies = 97 * 49 - 96 * 48; // the seams, once more
        EXPECT_EQ(found[k]["vertices"], textured.mesh.positions.size() + (with_texture ? copies : 0));
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(found[k]["lo"][i].get<double>(), lo[i], 2e-5);
            EXPECT_NEAR(found[k]["hi"][i].get<double>(), hi[i], 2e-5);
        }
        EXPECT_EQ(found[k]["map"].is_null(), !with_texture);
        if (with_texture) {
            EXPECT_EQ(found[k]["map"][0], 128);
            EXPECT_EQ(found[k]["normalMap"][1], 128);
        }
        const glm::vec3 colour = torus_colour(0, 0.25) * 255.0f; // at (1, 0), seen from +z
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[k]["colour"][i].get<double>(), colour[i], 12) << i;
    }
}
