// Meshes made to do harm: files named that are not theirs, nesting, and much made of few bytes. Each is
// refused in one line, within memory that the file explains.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include "tests/file/file_tools.h"
#include "tests/file/gltf_maker.h"
#include "tests/file/memory_limit.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;
using Json = nlohmann::ordered_json;

namespace {

class HostileMesh : public testing::Test {
  protected:
    std::string why(const std::filesystem::path& path) {
        const test::MemoryLimit limit;
        try {
            read_levels(path);
        } catch (const std::runtime_error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "one line: " << e.what();
            EXPECT_EQ(std::string(e.what()).find("bad_alloc"), std::string::npos);
            return e.what();
        }
        return "";
    }
    std::string why(const GltfMaker& maker) {
        write_text(folder / "h.glb", maker.glb());
        return why(folder / "h.glb");
    }
    void has(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << '"' << text << "\" has no \"" << part << '"';
    }
    Folder folder;
};

const std::filesystem::path files = GLCAST_HOSTILE_FILES;

} // namespace

TEST_F(HostileMesh, NoFileOutsideTheFolderIsOpened) {
    std::filesystem::create_directories(folder / "in" / "deep");
    const GltfMaker box = box_gltf();
    write_text(folder / "secret.bin", box.bytes);
    write_text(folder / "in" / "deep" / "mine.bin", box.bytes);
    std::filesystem::create_symlink(folder / "secret.bin", folder / "in" / "link.bin");
    std::filesystem::create_symlink("deep/mine.bin", folder / "in" / "inside.bin");
    std::filesystem::create_symlink("..", folder / "in" / "up");
    ASSERT_EQ(mkfifo((folder / "in" / "fifo.bin").c_str(), 0600), 0);
    const auto with = [&](const std::string& uri) {
        GltfMaker maker = box;
        maker.json["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", uri}}};
        write_text(folder / "in" / "h.glb", maker.glb());
        write_text(folder / "in" / "h.gltf", maker.gltf());
        const std::string one = why(folder / "in" / "h.glb"), two = why(folder / "in" / "h.gltf");
        EXPECT_EQ(one.empty(), two.empty());
        return one;
    };
    for (const std::string& uri :
         {(folder / "secret.bin").string(), std::string("../secret.bin"),
          std::string("deep/../../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("link.bin"),
          std::string("up/secret.bin"), std::string("fifo.bin"), std::string("/dev/zero"),
          std::string("/proc/self/environ"), std::string("file:///etc/passwd"),
          std::string("http://example.org/x.bin"), std::string("none.bin"), std::string("deep"),
          std::string("."), std::string("mine.bin%00.txt"), std::string(5000, 'x')})
        has(with(uri), "names a file that is not in its folder");
    EXPECT_EQ(with("deep/mine.bin"), "");
    EXPECT_EQ(with("inside.bin"), "") << "a link that stays";
}

/// Not relative to where one stands, but to the file; and the case that was found, whose file is its
/// neighbour.
TEST_F(HostileMesh, NamesAreRelativeToTheFile) {
    const GltfMaker box = box_gltf();
    std::filesystem::create_directories(folder / "here");
    std::filesystem::create_directories(folder / "there");
    write_text(folder / "here" / "box.bin", box.bytes);
    GltfMaker maker = box;
    maker.json["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", "box.bin"}}};
    write_text(folder / "there" / "h.gltf", maker.gltf());
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder / "here");
    has(why("../there/h.gltf"), "not in its folder");
    std::filesystem::current_path(before);
    std::filesystem::copy(files / "glb-buffer-is-another-file.glb", folder / "moved.glb");
    write_text(folder / "there" / "glb-buffer-is-another-file.secret.txt", std::string(59, '1'));
    std::filesystem::current_path(folder / "there");
    has(why("../moved.glb"), "not in its folder");
    std::filesystem::current_path(before);
}

TEST_F(HostileMesh, NestingIsBoundedOrNoMatter) {
    const auto chain = [](int nodes) {
        GltfMaker maker = box_gltf();
        maker.json["nodes"] = Json::array();
        for (int k = 0; k < nodes; ++k) maker.json["nodes"].push_back({{"children", {k + 1}}});
        maker.json["nodes"].push_back({{"mesh", 0}});
        maker.json["scenes"] = {{{"nodes", {0}}}};
        return maker;
    };
    EXPECT_EQ(why(chain(200'000)), "") << "a long chain is a mesh all the same";
    GltfMaker cycle = chain(3);
    cycle.json["nodes"][2]["children"] = {0};
    has(why(cycle), "no tree");
    cycle = chain(3);
    cycle.json["nodes"][2]["children"] = {3, 3};
    has(why(cycle), "no tree");
    for (const char* where : {"extras", "extensions", "nodes"}) {
        GltfMaker maker = box_gltf();
        const std::string deep = std::string(15'000, '[') + std::string(15'000, ']');
        std::string json = maker.json.dump();
        json.insert(1, "\"" + std::string(where) + "\":" + deep + ",");
        write_text(folder / "h.gltf", json);
        has(why(folder / "h.gltf"), "nested deeper");
    }
    GltfMaker brackets = box_gltf(); // in a text they are no nesting
    brackets.json["asset"]["generator"] = std::string(500, '[') + "\"\\" + std::string(500, '{');
    EXPECT_EQ(why(brackets), "");
}

TEST_F(HostileMesh, MuchMadeOfFewBytesIsRefused) {
    GltfMaker grid; // 1,000 triangles of three corners
    std::vector<std::uint16_t> corners;
    for (int k = 0; k < 3000; ++k) corners.push_back(std::uint16_t(k % 8));
    const int positions = grid.floats(box_corners), triangles = grid.indices(corners);
    const Json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", triangles}};
    grid.mesh({primitive});
    GltfMaker bad = grid; // instances
    for (int k = 0; k < 2000; ++k) bad.json["nodes"].push_back({{"mesh", 0}});
    has(why(bad), "of its bytes than is read");
    bad = grid; // primitives
    for (int k = 0; k < 2000; ++k) bad.json["meshes"][0]["primitives"].push_back(primitive);
    has(why(bad), "of its bytes than is read");
    bad = grid; // one level named often, and many
    bad.json["scenes"] = {{{"nodes", {0}}}};
    bad.json["nodes"].push_back({{"mesh", 0}});
    bad.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = std::vector<int>(20'000, 1);
    has(why(bad), "names a level twice");
    std::vector<int> many;
    for (int k = 1; k < 2000; ++k) {
        bad.json["nodes"].push_back({{"mesh", 0}});
        many.push_back(k);
    }
    bad.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = many;
    has(why(bad), "of its bytes than is read");
    bad = grid; // buffers
    bad.json["buffers"] = Json::array();
    for (int k = 0; k < 20; ++k) bad.json["buffers"].push_back({{"byteLength", bad.bytes.size()}});
    EXPECT_NE(why(bad), "");
    write_text(folder / "box.bin", grid.bytes);
    for (Json& buffer : bad.json["buffers"]) buffer["uri"] = "box.bin";
    has(why(bad), "for two buffers");
    bad = grid; // elements without bytes
    bad.json["accessors"][0] = {{"componentType", 5126}, {"count", 1'000'000'000}, {"type", "VEC3"}};
    has(why(bad), "more elements than its bytes explain");
    // A forest of a few hundred trees is no harm.
    for (int k = 0; k < 90; ++k) grid.json["nodes"].push_back({{"mesh", 0}, {"translation", {5 * k, 0, 0}}});
    EXPECT_EQ(why(grid), "");
}

TEST_F(HostileMesh, NumbersOfLevelsThatAreNone) {
    has(why(files / "glb-level-number-1e99.glb"), "refers to a node that is not there");
    for (const char* number :
         {"-1", "1e99", "-1e99", "4294967296", "\"a\"", "2147483648", "0"}) {
        GltfMaker maker = box_gltf();
        maker.json["scenes"] = {{{"nodes", {0}}}};
        maker.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {Json::parse(number)};
        EXPECT_NE(why(maker), "") << number;
    }
}
