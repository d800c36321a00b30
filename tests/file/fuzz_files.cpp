// Damaged files: whatever is in them, a reader reads or throws std::runtime_error, within memory that the
// file's size explains. Fixed seeds, so that a failure comes again.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "tests/file/file_tools.h"
#include "tests/file/memory_limit.h"
#include "tests/file/sample_meshes.h"
#include "tests/file/sphere_capture.h"
#include "tests/file/textured_torus.h"
#include "tools/io/capture_reader.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;
using glcast::test::MemoryLimit;
using glcast::test::with_sanitizer;

namespace {

template <class Read>
int refusals(const Folder& folder, const std::string& whole, const char* name, int times, Read&& read) {
    std::mt19937 random(20061);
    int refused = 0;
    for (int k = 0; k < times; ++k) {
        std::string damaged = whole;
        // Half of the flips hit the start, where headers are.
        const std::size_t range = k % 2 ? damaged.size() : std::min<std::size_t>(damaged.size(), 4096);
        const std::size_t at = random() % range;
        const char value = static_cast<char>(random());
        damaged[at] = damaged[at] == value ? static_cast<char>(~value) : value;
        write_text(folder / name, damaged);
        try {
            read(folder / name);
        } catch (const std::runtime_error& e) {
            ++refused;
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
            EXPECT_EQ(std::string(e.what()).find("bad_alloc"), std::string::npos) << "byte " << at;
        }
    }
    return refused;
}

} // namespace

TEST(Fuzz, FlippedBytesInACapture) {
    const Folder folder;
    ASSERT_EQ(write_nested(folder / "whole.exr", 16), "");
    const std::string whole = read_text(folder / "whole.exr");
    const MemoryLimit limit;
    const int refused =
        refusals(folder, whole, "damaged.exr", 500, [](const auto& path) { read_capture(path); });
    EXPECT_GT(refused, 250) << "most damage shows";
}

struct Kind {
    const char *name, *extension;
    bool textured;
    Compression compression;
};

class FuzzMesh : public testing::TestWithParam<Kind> {
  protected:
    /// The file of two levels, as bytes.
    std::string whole_file() const {
        const auto [name, extension, textured, compression] = GetParam();
        std::vector levels{textured ? textured_torus(12, 9, 16) : Level{torus(12, 9), "level 0"},
                           textured ? textured_torus(6, 5, 16, "level 1") : Level{torus(6, 5), "level 1"}};
        const auto path = folder / (std::string("whole") + extension);
        write_levels(path, levels, {.compression = compression});
        return read_text(path);
    }
    std::string damaged_name() const { return std::string("damaged") + GetParam().extension; }
    Folder folder;
};

/// Has lengths and a description in JSON.
class FuzzGlb : public FuzzMesh {};

TEST_P(FuzzMesh, FlippedBytes) {
    const std::string whole = whole_file();
    const MemoryLimit limit;
    refusals(folder, whole, damaged_name().c_str(), 300, [](const auto& path) { read_levels(path); });
}

/// Cut off anywhere, with lengths that say so: what tells is inside, not the size of the file.
TEST_P(FuzzGlb, CutOffWithTheLengthsToIt) {
    const std::string whole = whole_file();
    const MemoryLimit limit;
    const auto word = [](const std::string& file, std::size_t at) {
        std::uint32_t value;
        std::memcpy(&value, file.data() + at, 4);
        return value;
    };
    const std::size_t bytes = 20 + word(whole, 12); // where the second chunk begins
    int refused = 0, tried = 0;
    for (std::size_t length = bytes + 8; length < whole.size(); length += 4 * (1 + whole.size() / 1000), ++tried) {
        std::string cut = whole.substr(0, length);
        const std::uint32_t all = std::uint32_t(length), rest = std::uint32_t(length - bytes - 8);
        std::memcpy(cut.data() + 8, &all, 4);
        std::memcpy(cut.data() + bytes, &rest, 4);
        write_text(folder / damaged_name(), cut);
        try {
            read_levels(folder / damaged_name());
        } catch (const std::runtime_error& e) {
            ++refused;
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        }
    }
    EXPECT_EQ(refused, tried);
}

/// Numbers of the description become hostile ones.
TEST_P(FuzzGlb, HostileNumbers) {
    const std::string whole = whole_file();
    const MemoryLimit limit;
    std::mt19937 random(20062);
    const std::uint32_t length = [&] { std::uint32_t l; std::memcpy(&l, whole.data() + 12, 4); return l; }();
    for (int k = 0; k < 400; ++k) {
        std::string json = whole.substr(20, length);
        std::size_t at = random() % json.size();
        while (at < json.size() && !std::isdigit(static_cast<unsigned char>(json[at]))) ++at;
        std::size_t end = at;
        while (end < json.size() && std::isdigit(static_cast<unsigned char>(json[end]))) ++end;
        static const char* hostile[] = {"0", "1", "3", "255", "65537", "4294967295", "4294967296",
                                        "18446744073709551615", "-1", "1e300", "null", "[]"};
        json.replace(at, end - at, hostile[random() % std::size(hostile)]);
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string file = whole.substr(0, 20) + json + whole.substr(20 + length);
        const std::uint32_t all = std::uint32_t(file.size()), own = std::uint32_t(json.size());
        std::memcpy(file.data() + 8, &all, 4);
        std::memcpy(file.data() + 12, &own, 4);
        write_text(folder / damaged_name(), file);
        try {
            read_levels(folder / damaged_name());
        } catch (const std::runtime_error& e) {
            EXPECT_EQ(std::string(e.what()).find("bad_alloc"), std::string::npos) << json;
        }
    }
}

constexpr Kind glb_kinds[] = {{"glb", ".glb", false, Compression::none},
                              {"textured", ".glb", true, Compression::none},
                              {"quantized", ".glb", true, Compression::quantize},
                              {"meshopt", ".glb", true, Compression::meshopt}};
constexpr Kind text_kinds[] = {{"obj", ".obj", true, Compression::none},
                               {"ply", ".ply", true, Compression::none},
                               {"off", ".off", false, Compression::none}};
const auto kind_name = [](const auto& info) { return std::string(info.param.name); };

INSTANTIATE_TEST_SUITE_P(Glb, FuzzMesh, testing::ValuesIn(glb_kinds), kind_name);
INSTANTIATE_TEST_SUITE_P(Others, FuzzMesh, testing::ValuesIn(text_kinds), kind_name);
INSTANTIATE_TEST_SUITE_P(Glb, FuzzGlb, testing::ValuesIn(glb_kinds), kind_name);
