// The page of glcast view in Debian's Chromium: page_test.mjs clicks and looks at pixels.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tests/view/ball.h"
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
        {&fine, &fine_texture, "level 0", 1000, first, std::vector<double>(fine.positions.size())},
        {&coarse, &coarse_texture, "level 1", 500, error, std::vector<double>(coarse.positions.size())},
        {&coarse, nullptr, "level 2", 400, error, std::vector<double>(coarse.positions.size())}};
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

TEST(Page, TexturesInChromium) {
    const Folder folder;
    const std::string page = (folder / "page.html").string();
    write_textured_page(page);
    const Ran ran = run(GLCAST_NODE " " GLCAST_TEXTURE_TEST " chromium " + page);
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("all is well"), std::string::npos) << ran.output;
}

TEST(Page, InChromium) {
    const Folder folder;
    const std::string ball = (folder / "s<i>&.glb").string(), capture = (folder / "s.exr").string(),
                      page = (folder / "page.html").string();
    write_balls(ball);
    ASSERT_EQ(write_sphere(capture, 48), "");
    const Ran made = run(GLCAST_COMMAND " view \"" + ball + "\" --capture " + capture +
                         " --max-triangles 5000 -o " + page);
    ASSERT_EQ(made.status, 0) << made.output;
    const Ran ran = run(GLCAST_NODE " " GLCAST_PAGE_TEST " chromium " + page);
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("all is well"), std::string::npos) << ran.output;
}
