// The page of glcast view in Debian's Chromium: page_test.mjs clicks and looks at pixels.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tests/view/ball.h"
#include "tools/io/mesh_io.h"
#include "tools/view/page.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

/// Seen from +z the whole ball: green on the left, yellow on the right, more blue towards the top; every
/// normal leans by 45 degrees towards +x.
Texture planar_texture(const Mesh& mesh) {
    Texture texture;
    for (const Triangle& t : mesh.triangles) {
        auto& at = texture.coordinates.emplace_back();
        auto& along = texture.tangents.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& p = mesh.positions[t[k]];
            const glm::dvec3 n(mesh.normals[t[k]]), x = glm::dvec3(1, 0, 0) - n * n.x;
            at[k] = glm::vec2(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y);
            along[k] = glm::vec4(glm::length(x) > 0.01 ? glm::normalize(x) : glm::dvec3(0, 0, -1), 1);
        }
    }
    constexpr int size = 64;
    texture.colour = texture.normal = {size, size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const std::uint8_t blue = y < size / 3 ? 90 : 0;
            for (const std::uint8_t value : {std::uint8_t(x < size / 2 ? 0 : 230), std::uint8_t(200), blue})
                texture.colour.rgb.push_back(value);
            for (const std::uint8_t value : {218, 128, 218}) texture.normal.rgb.push_back(value);
        }
    return texture;
}

void write_textured_page(const std::string& path) {
    const Mesh fine = ball(1, 64), coarse = ball(1, 32);
    const Texture fine_texture = planar_texture(fine), coarse_texture = planar_texture(coarse);
    LevelError error;
    error.mean = 0.01, error.p999 = 0.02, error.max = 0.03, error.normal_mean_degrees = 4;
    error.colour_mean = 0.05, error.colour_p999 = 0.1;
    LevelError first;
    first.unsupported_area_share = 0.06;
    PageInput input;
    input.title = "textured";
    input.levels = {
        {&fine, &fine_texture, nullptr, "level 0", 1000, first, std::vector<double>(fine.positions.size())},
        {&coarse, &coarse_texture, nullptr, "level 1", 500, error, std::vector<double>(coarse.positions.size())},
        {&coarse, nullptr, nullptr, "level 2", 400, error, std::vector<double>(coarse.positions.size())}};
    std::vector<ViewImage> views;
    for (const View& view : six_views()) views.push_back(sphere_view(16, view.axis, view.side));
    const CaptureInfo info = sphere_info(16);
    input.capture = &info;
    input.views = views;
    const Page page = make_page(input);
    EXPECT_EQ(page.html.find("picture-2"), std::string::npos) << "levels share two pictures";
    write_text(path, page.html);
}

} // namespace

namespace {

/// Made by the command, of balls, with what a sphere's capture shows beside them.
std::string write_page(const Folder& folder) {
    const std::string ball = (folder / "s<i>&.glb").string(), capture = (folder / "s.exr").string(),
                      page = (folder / "page.html").string();
    write_balls(ball);
    EXPECT_EQ(write_sphere(capture, 48), "");
    const Ran made = run(GLCAST_COMMAND " view \"" + ball + "\" --capture " + capture +
                         " --max-triangles 5000 -o " + page);
    EXPECT_EQ(made.status, 0) << made.output;
    return page;
}

void expect_well(const std::string& script, const std::string& page) {
    const Ran ran = run(GLCAST_NODE " " + script + " chromium " + page);
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("all is well"), std::string::npos) << ran.output;
}

/// What the page saved is the level that it was given, as far as its bytes hold it.
void expect_saved(const std::string& file, const Level& level, double size) {
    const Ran valid = run("GLCAST_NODE_MODULES=" GLCAST_NODE_MODULES " " GLCAST_NODE " " GLCAST_VALIDATE " \"" + file + "\"");
    EXPECT_EQ(valid.status, 0) << valid.output;
    const Level saved = read_levels(file).at(0);
    ASSERT_EQ(saved.mesh.triangles.size(), level.mesh.triangles.size());
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto v = level.mesh.triangles[t][k], w = saved.mesh.triangles[t][k];
            ASSERT_LT(glm::distance(level.mesh.positions[v], saved.mesh.positions[w]), size / 65535) << t;
            if (!level.mesh.colours.empty() && level.texture.empty())
                ASSERT_LT(glm::distance(level.mesh.colours[v], saved.mesh.colours[w]), 0.01f) << t;
            if (!level.mesh.normals.empty())
                ASSERT_GT(glm::dot(level.mesh.normals[v], saved.mesh.normals[w]), 0.999f) << t;
        }
    EXPECT_EQ(saved.texture.empty(), level.texture.empty());
    EXPECT_TRUE(saved.texture.colour.rgb == level.texture.colour.rgb);
    EXPECT_TRUE(saved.texture.normal.rgb == level.texture.normal.rgb);
}

} // namespace

TEST(Page, TexturesInChromium) {
    const Folder folder;
    const std::string page = (folder / "page.html").string();
    write_textured_page(page);
    expect_well(GLCAST_TEXTURE_TEST, page);
    Level level{ball(1, 64), "", {}, 0, {}};
    level.texture = planar_texture(level.mesh);
    expect_saved((folder / "textured_LOD0.glb").string(), level, 2);
}

TEST(Page, InChromium) {
    const Folder folder;
    expect_well(GLCAST_PAGE_TEST, write_page(folder));
    expect_saved((folder / "s_i_&_LOD1.glb").string(),
                 read_levels((folder / "s<i>&_LOD1.glb").string()).at(0), 3);
}

TEST(Page, Axe) {
    const Folder folder;
    expect_well(GLCAST_AXE_TEST, write_page(folder));
}
