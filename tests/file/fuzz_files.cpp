// Damaged files: whatever is in them, a reader reads or throws std::runtime_error, within memory that the
// file's size explains. Fixed seeds, so that a failure comes again.
#include <gtest/gtest.h>

#include <random>
#include <sys/resource.h>

#include "tests/file/file_tools.h"
#include "tests/file/sample_meshes.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/capture_reader.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

constexpr bool with_sanitizer =
#ifdef __SANITIZE_ADDRESS__
    true;
#else
    false;
#endif

/// An allocation beyond a gigabyte fails, which the readers must never need for small files.
class MemoryLimit {
  public:
    MemoryLimit() {
        getrlimit(RLIMIT_AS, &before);
        rlimit small = before;
        small.rlim_cur = 1u << 30;
        if (!with_sanitizer) setrlimit(RLIMIT_AS, &small); // shadow memory is larger than that
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &before); }

  private:
    rlimit before{};
};

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

class FuzzMesh : public testing::TestWithParam<const char*> {};

TEST_P(FuzzMesh, FlippedBytes) {
    const Folder folder;
    const std::string extension = GetParam();
    const std::vector levels{Level{torus(12, 9), "level 0"}, Level{torus(6, 5), "level 1"}};
    write_levels(folder / ("whole" + extension), levels);
    const std::string whole = read_text(folder / ("whole" + extension));
    const MemoryLimit limit;
    refusals(folder, whole, ("damaged" + extension).c_str(), 300,
             [](const auto& path) { read_levels(path); });
}

INSTANTIATE_TEST_SUITE_P(Formats, FuzzMesh, testing::Values(".glb", ".obj", ".ply", ".off"),
                         [](const auto& info) { return std::string(info.param + 1); });
