#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <unistd.h>

#include "tests/mesh/bodies.h"
#include "tools/render/render.h"

namespace glcast::test {
namespace {

using Rgb = std::array<int, 3>;

Rgb at(const Picture& picture, int x, int y) {
    const std::size_t i = (std::size_t(y) * std::size_t(picture.width) + std::size_t(x)) * 3;
    return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

bool is_background(const Rgb& c) { return std::min({c[0], c[1], c[2]}) > 230; }

/// Each side of the cube by its own colour: -x black-ish red, +x red, and so on.
Mesh signed_cube() {
    Mesh mesh = cube(2, 2);
    paint(mesh, [](const glm::dvec3& p) { return glm::vec3(p * 0.5 + 0.5); });
    return mesh;
}

struct TemporaryFolder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("glcast_render_" + std::to_string(getpid()));
    TemporaryFolder() { std::filesystem::create_directory(path); }
    ~TemporaryFolder() { std::filesystem::remove_all(path); }
};

TEST(Render, ASphereFillsADiscInItsOwnColour) {
    Mesh mesh = sphere(3, 5, {100, 50, -20});
    paint(mesh, [](const glm::dvec3&) { return glm::vec3(0.8F, 0.1F, 0.1F); });
    const Picture p = picture(mesh, {1, 2, 3}, 200);
    ASSERT_EQ(p.rgb.size(), 200U * 200 * 3);
    int covered = 0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) covered += !is_background(at(p, x, y));
    EXPECT_NEAR(covered, std::numbers::pi * 100 * 100 / (1.04 * 1.04), 600);
    const Rgb middle = at(p, 100, 100);
    EXPECT_NEAR(middle[0], 0.8 * 255, 16); // lit from the viewer's side: nearly as drawn
    EXPECT_NEAR(middle[1], 0.1 * 255, 6);
    EXPECT_EQ(middle[1], middle[2]);
    const Rgb rim = at(p, 100 + 92, 100);
    EXPECT_LT(rim[0], middle[0] - 40);       // shaded, and
    EXPECT_GT(rim[0], 0.8 * 0.35 * 255 - 8); // never darker than the ambient light
}

TEST(Render, EverySideOfTheSheetIsSeenFromWhereItSays) {
    const Level levels[] = {{signed_cube(), "level 0"}};
    const Picture sheet = contact_sheet(levels, 128);
    ASSERT_EQ(sheet.width, 8 * 129 + 1);
    const int y = sheet.height - 128 / 2 - 2;
    for (int side = 0; side < 6; ++side) {
        const Rgb middle = at(sheet, 1 + 129 * side + 64, y);
        const int axis = side / 2;
        EXPECT_NEAR(middle[std::size_t(axis)], side % 2 ? 255 : 0, 25) << side; // the side towards us
        for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
            EXPECT_NEAR(middle[std::size_t(other)], 128, 25) << side;
    }
}

TEST(Render, UpIsUp) {
    const Level levels[] = {{signed_cube(), ""}};
    const Picture sheet = contact_sheet(levels, 128);
    const int middle_y = sheet.height - 128 / 2 - 2;
    const auto channel = [&](int column, int dx, int dy, std::size_t k) {
        return at(sheet, 1 + 129 * column + 64 + dx, middle_y + dy)[k];
    };
    for (const int column : {0, 1, 4, 5})
        EXPECT_GT(channel(column, 0, -20, 1), channel(column, 0, 20, 1)) << column;
    EXPECT_GT(channel(5, 20, 0, 0), channel(5, -20, 0, 0)); // from +z: x to the right
    EXPECT_GT(channel(1, -20, 0, 2), channel(1, 20, 0, 2)); // from +x: z to the left
}

TEST(Render, ARowPerLevelOnOneScale) {
    const Level levels[] = {{sphere(1, 3), "level 0"}, {sphere(0.5, 3), "level 1", 0.1, 0.2}};
    const Picture one = contact_sheet({levels, 1}, 64), two = contact_sheet(levels, 64);
    EXPECT_EQ(two.width, one.width);
    const int row = 64 + 2 + 12;
    EXPECT_EQ(two.height, one.height + row);
    const auto covered = [&](int top) {
        int count = 0;
        for (int y = top; y < top + 64; ++y)
            for (int x = 1; x < 65; ++x) count += !is_background(at(two, x, y));
        return count;
    };
    const double large = covered(two.height - 65 - row), small = covered(two.height - 65);
    EXPECT_NEAR(small / large, 0.25, 0.03);
    EXPECT_TRUE(std::equal(one.rgb.begin(), one.rgb.end(), two.rgb.begin())); // the first row is as it was
}

TEST(Render, LabelsAreDrawn) {
    const Level named[] = {{sphere(1, 2), "level 0"}}, other[] = {{sphere(1, 2), "coarse"}};
    EXPECT_NE(contact_sheet(named, 64).rgb, contact_sheet(other, 64).rgb);
    const Level strange[] = {{sphere(1, 2), std::string(5000, '\xc3')}}; // does not fit, not ASCII
    EXPECT_EQ(contact_sheet(strange, 64).width, contact_sheet(named, 64).width);
}

TEST(Render, WithoutNormalsOrColoursItIsFacetedAndGrey) {
    Mesh mesh = sphere(1, 1);
    mesh.normals.clear();
    const Rgb middle = at(picture(mesh, {0, 0, -1}, 64), 32, 32);
    EXPECT_EQ(middle[0], middle[1]);
    EXPECT_EQ(middle[1], middle[2]);
    EXPECT_FALSE(is_background(middle));
    EXPECT_GT(middle[0], 100);
}

TEST(Render, SaysWhatIsWrong) {
    EXPECT_THROW(contact_sheet({}), std::runtime_error);
    const Level empty[] = {{Mesh{}, "level 0"}}, good[] = {{sphere(1, 1), "level 0"}};
    EXPECT_THROW(contact_sheet(empty), std::runtime_error);
    EXPECT_THROW(contact_sheet(good, 0), std::runtime_error);
    EXPECT_THROW(contact_sheet(good, 100'000), std::runtime_error);
    EXPECT_THROW(picture(sphere(1, 1), {0, 0, 0}, 64), std::runtime_error);
}

TEST(Png, IsWrittenWholeOrNotAtAll) {
    const TemporaryFolder folder;
    const Picture p = picture(sphere(1, 2), {0, 0, -1}, 32);
    write_png(folder.path / "a.png", p);
    write_png(folder.path / "a.png", p); // over it
    std::ifstream file(folder.path / "a.png", std::ios::binary);
    std::array<char, 24> head{};
    file.read(head.data(), head.size());
    EXPECT_EQ(std::string(head.data() + 1, 3), "PNG");
    EXPECT_EQ(head[19], 32); // the width's last byte
    EXPECT_THROW(write_png(folder.path / "none" / "a.png", p), std::runtime_error);
    std::filesystem::create_directories(folder.path / "taken.png" / "x");
    EXPECT_THROW(write_png(folder.path / "taken.png", p), std::runtime_error);
    EXPECT_THROW(write_png(folder.path / "b.png", Picture{}), std::runtime_error);
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path)) ++files;
    EXPECT_EQ(files, 2U); // a.png and taken.png: nothing half-written is left
}

} // namespace
} // namespace glcast::test
