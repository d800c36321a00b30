// Streams that somebody means ill with: damage behind the checksums, which are made right again. Whatever is
// in them, the reader reads or throws std::runtime_error, within memory that the stream's size explains.
// Fixed seeds.
#include <sstream>

#include "tests/file/file_tools.h"
#include "tests/file/memory_limit.h"
#include "tests/mesh/bodies.h"
#include "tests/progressive/apart.h"
#include "tests/progressive/bodies.h"
#include "tools/progressive/geomorph.h"
#include "tools/progressive/packing.h"
#include "tools/progressive/stream.h"

namespace glcast::test {
namespace {

using namespace progressive;

std::string stream_of(const LoggedBody& body) {
    const samples::Folder folder;
    ProgressiveMesh mesh(body.mesh, body.log);
    OutputFile file((folder / "x.glpm").string());
    write_progressive(file, mesh, {});
    EXPECT_TRUE(file.commit());
    return samples::read_text(folder / "x.glpm");
}

/// Reads all, and uses what came: back to the base, a geomorph, its mesh. True when it was refused.
bool refused(const std::string& stream) {
    std::istringstream in(stream);
    try {
        ProgressiveReader reader(in);
        while (reader.next()) {
        }
        ProgressiveMesh& mesh = reader.mesh();
        mesh.refine_to(mesh.splits() / 2);
        const Mesh level = mesh.mesh();
        for (const Triangle& t : level.triangles)
            for (const std::uint32_t v : t) EXPECT_LT(v, level.positions.size());
        mesh.refine_to(0);
        Geomorph(mesh, 0, mesh.splits()).at(0.5);
        return false;
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        return true;
    }
}

TEST(FuzzStream, ComesApartAndTogether) {
    const std::string stream = stream_of(small_body());
    const Apart whole(stream), again(whole.together());
    EXPECT_EQ(again.header, whole.header);
    ASSERT_EQ(again.chunks.size(), whole.chunks.size());
    for (std::size_t k = 0; k < whole.chunks.size(); ++k)
        EXPECT_EQ(again.chunks[k].bytes, whole.chunks[k].bytes);
    EXPECT_FALSE(refused(whole.together()));
    EXPECT_FALSE(refused(stream));
}

TEST(FuzzStream, DamageBehindTheChecksums) {
    const Apart whole(stream_of(small_body()));
    const MemoryLimit limit;
    std::mt19937 random(7);
    int refusals = 0;
    for (int k = 0; k < 3000; ++k) {
        Apart damaged = whole;
        std::string& bytes = damaged.chunks[random() % damaged.chunks.size()].bytes;
        for (int flips = 1 + k % 3; flips > 0; --flips) {
            const std::size_t range =
                k % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 1500); // connectivity first
            bytes[random() % range] ^= char(1 << random() % 8);
        }
        refusals += refused(damaged.together());
    }
    EXPECT_GT(refusals, 500);
}

TEST(FuzzStream, LyingCounts) {
    const Apart whole(stream_of(small_body()));
    const MemoryLimit limit;
    for (const std::size_t at : {12, 16, 20, 24}) // vertices, triangles, those of the base
        for (const std::uint32_t value : {0u, 1u, 1000u, 100'000'000u, UINT32_MAX - 1, UINT32_MAX}) {
            Apart damaged = whole;
            put(damaged.header, at, value);
            EXPECT_TRUE(refused(damaged.together()) || (at < 20 && value > 100)) << at << " " << value;
        }
    for (std::size_t chunk = 0; chunk < whole.chunks.size(); ++chunk)
        for (const std::uint32_t value : {0u, 1u, 65536u, 65537u, UINT32_MAX}) {
            Apart damaged = whole;
            damaged.chunks[chunk].count = value;
            EXPECT_TRUE(refused(damaged.together()) || value == whole.chunks[chunk].count)
                << chunk << " " << value;
        }
    std::string stream = whole.together(); // a block that says it is enormous, with a head that is right
    const std::size_t base = 38 + 4;
    for (const std::size_t field : {4, 12}) {
        std::string damaged = stream;
        put(damaged, base + field, std::uint64_t(1) << 60);
        put(damaged, base + 24, checksum(damaged.substr(base, 24)));
        EXPECT_TRUE(refused(damaged)) << field;
    }
}

TEST(FuzzStream, RandomBytes) {
    const std::string start = stream_of(small_body()).substr(0, 12);
    const MemoryLimit limit;
    std::mt19937 random(11);
    for (int k = 0; k < 2000; ++k) {
        std::string bytes = k % 2 ? start : "";
        for (unsigned size = random() % 300; size > 0; --size) bytes.push_back(char(random()));
        EXPECT_TRUE(refused(bytes));
    }
}

} // namespace
} // namespace glcast::test
