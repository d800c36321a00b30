// Meshes as other programs write them: every kind of file gives the shape and the colours that it means.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/foreign_kinds.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"
#include "tools/picture/png.h"

using namespace glcast;
using namespace glcast::samples;
using namespace glcast::foreign;

namespace {

void expect_colour(const Level& level, const glm::vec3& colour) {
    ASSERT_TRUE(has_colours(level.mesh, level.wedges));
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
        for (const glm::vec3& c : corner_colours(level.mesh, level.wedges, t)) ASSERT_LT(glm::length(c - colour), 1e-5);
}

std::string why_refused(const std::filesystem::path& path) {
    try {
        read_levels(path);
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        return e.what();
    }
    return "";
}

std::filesystem::path a_case(const char* name) { return std::filesystem::path(GLCAST_TEST_DATA) / "cases" / name; }

} // namespace

TEST(Foreign, EveryKindIsTheBox) {
    const Folder folder;
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.file);
        write_text(folder / kind.file, kind.text);
        std::vector<Level> levels;
        ASSERT_NO_THROW(levels = read_levels(folder / kind.file)) << why_refused(folder / kind.file);
        MeshCheck check = check_mesh(levels[0].mesh, CheckDepth::everything);
        if (kind.file.starts_with("no-area.o")) { // the two faces without area are kept there
            std::erase_if(levels[0].mesh.triangles, [](const Triangle& t) { return t[0] == t[1]; });
            check = check_mesh(levels[0].mesh, CheckDepth::everything);
        }
        EXPECT_TRUE(check.closed_manifold());
        EXPECT_EQ(check.triangles, 12u);
        EXPECT_NEAR(check.volume, 6, 1e-9);
        if (kind.colour)
            expect_colour(levels[0], *kind.colour);
        else
            EXPECT_FALSE(has_colours(levels[0].mesh, levels[0].wedges));
        for (const glm::vec3& n : levels[0].mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
    }
}

TEST(Foreign, CasesGiveTheirValues) {
    struct Case {
        const char* name;
        std::optional<glm::vec3> colour{};
    };
    for (const Case& c : {Case{"obj-colours-255.obj", brown}, Case{"obj-continued-lines.obj"}, Case{"obj-material-colours.obj", red},
                          Case{"obj-tiny-normals.obj"}, Case{"off-face-colours.off", brown}, Case{"off-free-lines.off"},
                          Case{"ply-face-colours.ply", brown}, Case{"ply-int-colours.ply", brown}, Case{"ply-nan-quality.ply"},
                          Case{"ply-tristrips.ply"}, Case{"stl-leading-blank.stl"}, Case{"stl-upper-case.stl"}}) {
        SCOPED_TRACE(c.name);
        const Level level = read_levels(a_case(c.name)).front();
        const MeshCheck check = check_mesh(level.mesh, CheckDepth::everything);
        EXPECT_TRUE(check.closed_manifold());
        EXPECT_EQ(check.triangles, 12u);
        EXPECT_NEAR(check.volume, 6, 1e-9);
        if (c.colour) expect_colour(level, *c.colour);
    }
    EXPECT_NE(why_refused(a_case("obj-edges-of-1e155-abort-compare.obj")).find("scale"), std::string::npos);
}

TEST(Foreign, ConcaveCapsAreCutRight) {
    const MeshCheck check = check_mesh(read_mesh(a_case("obj-concave-caps.obj")), CheckDepth::everything);
    EXPECT_TRUE(check.closed_manifold());
    EXPECT_NEAR(check.volume, 3, 1e-12);
    EXPECT_NEAR(check.area, 14, 1e-12);
    EXPECT_EQ(check.self_intersections, 0u);
}

/// A comb with `teeth` teeth, and a square with a hole that a bridge joins to its outline: prisms over concave polygons.
TEST(Foreign, CombsAndHoles) {
    const Folder folder;
    const auto prism = [](const std::vector<glm::dvec2>& outline, const std::vector<int>& cap) {
        std::string text;
        for (const int z : {0, 1})
            for (const glm::dvec2& p : outline) text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(z) + "\n";
        std::string top = "f", bottom = "f";
        for (std::size_t k = 0; k < cap.size(); ++k) {
            top += " " + std::to_string(cap[k] + 1 + int(outline.size()));
            bottom += " " + std::to_string(cap[cap.size() - 1 - k] + 1);
        }
        return text + top + "\n" + bottom + "\n";
    };
    const auto sides = [](int from, int to, int all) {
        std::string text;
        for (int k = from; k < to; ++k) {
            const int next = k + 1 == to ? from : k + 1;
            text += "f " + std::to_string(k + 1) + " " + std::to_string(next + 1) + " " + std::to_string(next + 1 + all) + " " + std::to_string(k + 1 + all) + "\n";
        }
        return text;
    };
    std::vector<glm::dvec2> comb = {{0, -1}, {400, -1}};
    for (int tooth = 199; tooth >= 0; --tooth)
        for (const glm::dvec2& p : {glm::dvec2(2 * tooth + 2, 0), {2 * tooth + 1.5, 5}, {2 * tooth + 1, 0}}) comb.push_back(p);
    comb.back() = {0, 0};
    std::vector<int> all(comb.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = int(k);
    write_text(folder / "comb.obj", prism(comb, all) + sides(0, int(comb.size()), int(comb.size())));
    const std::vector<glm::dvec2> hole = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {1, 2}, {2, 2}, {2, 1}};
    write_text(folder / "hole.obj", prism(hole, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}) + sides(0, 4, 8) + sides(4, 8, 8));
    double area = 0;
    for (std::size_t k = 0; k < comb.size(); ++k) {
        const glm::dvec2 &a = comb[k], &b = comb[(k + 1) % comb.size()];
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    for (const auto& [name, volume] : {std::pair<const char*, double>{"comb.obj", area}, {"hole.obj", 8.0}}) {
        SCOPED_TRACE(name);
        const MeshCheck check = check_mesh(read_mesh(folder / name), CheckDepth::everything);
        EXPECT_TRUE(check.closed_manifold());
        EXPECT_NEAR(check.volume, volume, 1e-9 * volume);
        EXPECT_EQ(check.self_intersections, 0u);
    }
}

TEST(Foreign, MaterialsAndTheirPictures) {
    const Folder folder;
    Picture picture{2, 1, {255, 0, 0, 0, 0, 255}}; // red on the left
    write_text(folder / "two colours.png", std::string(png_bytes(picture)));
    write_text(folder / "m.mtl", "# m\r\nnewmtl  the green one\r\n\tKd 0 1 0\nnewmtl shown\nKd 0.5 0.5 0.5\n"
                                 "map_Kd -s 1 1 1 -clamp on C:\\work\\two colours.png\n");
    const std::string box = vertices("v ", "") + "vt 0.1 0.5\nvt 0.9 0.5\n";
    write_text(folder / "m.obj", "mtllib m.mtl\n" + box + "usemtl the green one\nf 1 2 4 3\nusemtl shown\n"
                                 "f 5/1 7/1 8/1 6/1\nf 1/2 5/2 6/2 2/2\nusemtl none\n" + polygons("f ", 1).substr(30));
    const Level level = read_levels(folder / "m.obj").front();
    EXPECT_TRUE(check_mesh(level.mesh).closed_manifold());
    const glm::vec3 wanted[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, glm::vec3(0.8f)};
    for (std::size_t t = 0; t < 8; ++t)
        for (const glm::vec3& c : corner_colours(level.mesh, level.wedges, t))
            EXPECT_LT(glm::length(c - wanted[t / 2]), 1e-5) << t;
}

TEST(Foreign, NormalsOfCornersStay) {
    const Folder folder;
    write_text(folder / "n.obj", vertices("v ", "") + "vn -1 0 0\nvn 1 0 0\nvn 0 -1 0\nvn 0 1 0\nvn 0 0 -1\nvn 0 0 1\n"
                                 "f 1//1 2//1 4//1 3//1\nf 5//2 7//2 8//2 6//2\nf 1//3 5//3 6//3 2//3\nf 3//4 4//4 8//4 7//4\n"
                                 "f 1//5 3//5 7//5 5//5\nf 2//6 6//6 8//6 4//6\n");
    const Level level = read_levels(folder / "n.obj").front();
    EXPECT_EQ(level.mesh.positions.size(), 8u);
    ASSERT_FALSE(level.wedges.normals.empty());
    for (std::size_t t = 0; t < 12; ++t) {
        const auto& p = level.mesh.positions;
        const Triangle& at = level.mesh.triangles[t];
        const glm::vec3 flat(glm::normalize(glm::cross(p[at[1]] - p[at[0]], p[at[2]] - p[at[0]])));
        for (const glm::vec3& n : corner_normals(level.mesh, level.wedges, t)) EXPECT_LT(glm::length(n - flat), 1e-6);
    }
}

/// Digits that floats do not hold come through readers that have floats.
TEST(Foreign, DigitsOfDoubles) {
    const Folder folder;
    const std::string far = "v 4500000.0000001 1e-17 0.1\nv 4500001.123456789 0 0\nv 4500000 1 0\nf 1 2 3\n";
    write_text(folder / "far.obj", far);
    EXPECT_EQ(read_mesh(folder / "far.obj").positions.at(0), glm::dvec3(4500000.0000001, 1e-17, 0.1));
    EXPECT_EQ(read_mesh(folder / "far.obj").positions.at(1).x, 4500001.123456789);
    write_text(folder / "far.ply", ply("", "", vertices("450000", ".000000001") + polygons("4 ", 0)));
    EXPECT_EQ(read_mesh(folder / "far.ply").positions.at(0), glm::dvec3(4500000, 0, 0.000000001));
    write_text(folder / "far.stl", "solid\nfacet\nvertex 4500000.0000001 0 0\nvertex 4500000.0000002 0 0\nvertex 4500000 1 0\nendfacet\nendsolid\n");
    EXPECT_EQ(read_mesh(folder / "far.stl").positions.at(1).x, 4500000.0000002);
}

TEST(Foreign, OpensNothingBesides) {
    const Folder folder;
    std::filesystem::create_directory(folder / "in");
    write_text(folder / "out.mtl", "newmtl a\nKd 1 0 0\n");
    ASSERT_EQ(mkfifo((folder / "in/fifo.mtl").c_str(), 0600), 0);
    std::filesystem::create_symlink("../out.mtl", folder / "in/link.mtl");
    for (const std::string& name : {std::string("../out.mtl"), (folder / "out.mtl").string(), std::string("fifo.mtl"),
                                    std::string("link.mtl"), std::string("/dev/zero"), std::string("/proc/self/fd/0")}) {
        write_text(folder / "in/m.obj", "mtllib " + name + "\nusemtl a\n" + vertices("v ", "") + polygons("f ", 1));
        const Level level = read_levels(folder / "in/m.obj").front();
        EXPECT_FALSE(has_colours(level.mesh, level.wedges)) << name;
    }
    std::filesystem::create_directory(folder / "in/sub");
    write_text(folder / "in/sub/m.mtl", "newmtl a\nKd 1 0 0\n");
    write_text(folder / "in/m.obj", "mtllib sub\\m.mtl\nusemtl a\n" + vertices("v ", "") + polygons("f ", 1));
    expect_colour(read_levels(folder / "in/m.obj").front(), red);
}

/// One line each.
TEST(Foreign, DamageIsRefused) {
    const Folder folder;
    std::string tangled = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int k = 0; k < 60000; ++k) tangled += " " + std::to_string(k % 3 + 1);
    const std::vector<std::array<std::string, 3>> table = {
        {"a.obj", vertices("v ", "") + "f 1 2 9\n", "corner 9 of 8"},
        {"b.obj", vertices("v ", "") + "f 1 2 -9\n", "corner"},
        {"c.obj", vertices("v ", "") + "f 1 2 3x\n", "line 9"},
        {"d.obj", vertices("v ", "") + "f 1 2 99999999999\n", "line 9"},
        {"e.obj", tangled + "\n", "too tangled"},
        {"f.obj", "v 1e400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"},
        {"a.ply", ply("", "", vertices("", "")), "truncated"},
        {"b.ply", binary_ply<float, std::uint8_t>(false, "float", "uchar", 1, 2, 3).substr(0, 300), "truncated"},
        {"c.ply", ply("", "", vertices("", "") + polygons("4 ", 3)), "corner"},
        {"a.off", "OFF\n8 7 12\n" + vertices("", "") + polygons("4 ", 0), "truncated"},
        {"b.off", binary_off(true).substr(0, 200), "truncated"},
        {"a.stl", binary_stl("x", 0).substr(0, 600), "truncated"},
        {"b.stl", text_stl("solid\n", "facet ", "\nvertex ", " endfacet\n", ""), "truncated"},
    };
    for (const auto& [name, text, why] : table) {
        write_text(folder / name, text);
        EXPECT_NE(why_refused(folder / name).find(why), std::string::npos) << name << ": " << why_refused(folder / name);
    }
}
