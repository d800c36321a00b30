// The stream: what is written comes back bit for bit; what is cut off is a coarser mesh; what is damaged is
// refused.
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

#include "tests/file/file_tools.h"
#include "tests/mesh/bodies.h"
#include "tests/progressive/bodies.h"
#include "tools/progressive/packing.h"
#include "tools/progressive/stream.h"

namespace glcast::test {
namespace {

using samples::Folder;
using samples::read_text;

std::string written(const Folder& folder, ProgressiveMesh& mesh, const ProgressiveInfo& info = {}) {
    const auto path = folder / "x.glpm";
    OutputFile file(path.string());
    write_progressive(file, mesh, info);
    EXPECT_TRUE(file.commit()) << file.error();
    return read_text(path);
}

std::string stream_of(const LoggedBody& body, const ProgressiveInfo& info = {}) {
    const Folder folder;
    ProgressiveMesh mesh(body.mesh, body.log);
    return written(folder, mesh, info);
}

/// A copy that ends where its memory ends, so that a sanitizer sees what is read beyond.
class Exactly : public std::streambuf {
  public:
    Exactly(const char* bytes, std::size_t size) : memory(new char[size]) {
        std::memcpy(memory.get(), bytes, size);
        setg(memory.get(), memory.get(), memory.get() + size);
    }

  private:
    std::unique_ptr<char[]> memory;
};

TEST(Stream, RoundTripsBitForBit) {
    for (const LoggedBody& body : logged_bodies()) {
        const Folder folder;
        ProgressiveMesh mesh(body.mesh, body.log);
        mesh.refine_to(mesh.splits() / 2);
        ProgressiveInfo info;
        info.name = "körper \"1\"", info.sample = 0.1;
        written(folder, mesh, info);
        EXPECT_EQ(mesh.level(), mesh.splits() / 2) << "left as it was";
        ProgressiveFile back = read_progressive(folder / "x.glpm");
        EXPECT_TRUE(looks_like_progressive(folder / "x.glpm"));
        EXPECT_TRUE(back.complete);
        EXPECT_EQ(back.info.name, info.name);
        EXPECT_EQ(back.info.sample, 0.1);
        EXPECT_EQ(back.info.triangles, body.mesh.triangles.size());
        EXPECT_TRUE(same(back.mesh.mesh(), body.mesh)) << body.name;
        for (const std::size_t level : {mesh.splits() / 3, std::size_t(0), 2 * mesh.splits() / 3}) {
            back.mesh.refine_to(level);
            EXPECT_TRUE(same(back.mesh.mesh(), collapsed(body.mesh, body.log, body.log.size() - level)))
                << body.name;
            EXPECT_EQ(back.mesh.edges(level), mesh.edges(level));
        }
        EXPECT_TRUE(written(folder, back.mesh, info) == read_text(folder / "x.glpm"))
            << "the same bytes again";
    }
}

TEST(Stream, KeepsEveryBitPatternOfFiniteNumbers) {
    LoggedBody body = small_body();
    std::mt19937_64 random(9);
    for (glm::dvec3& p : body.mesh.positions)
        for (int k = 0; k < 3; ++k) {
            const auto bits = random();
            std::memcpy(&p[k], &bits, 8);
            if (!std::isfinite(p[k])) p[k] = -0.0;
        }
    body.mesh.positions[3] = {5e-324, -5e-324, 1.7976931348623157e308};
    ProgressiveMesh mesh(body.mesh, body.log); // placed where the log has it; what it comes from is noise
    const Folder folder;
    written(folder, mesh);
    EXPECT_TRUE(same(read_progressive(folder / "x.glpm").mesh.mesh(), body.mesh));
}

TEST(Stream, GrowsBlockByBlock) {
    Mesh mesh = sphere(1, 4);
    const CollapseLog log = shortest_edges(mesh, 60, Placement::middle).log;
    const LoggedBody body{"sphere", mesh, log};
    std::istringstream in(stream_of(body) + "what follows is not read");
    ProgressiveReader reader(in);
    EXPECT_EQ(reader.mesh().splits(), 0u);
    EXPECT_TRUE(same(reader.mesh().mesh(), collapsed(mesh, log, log.size())));
    std::size_t blocks = 0;
    while (reader.next()) {
        ++blocks;
        const std::size_t level = reader.mesh().level();
        EXPECT_EQ(level, reader.mesh().splits());
        EXPECT_TRUE(same(reader.mesh().mesh(), collapsed(mesh, log, log.size() - level)));
        reader.mesh().refine_to(level / 2); // the reader refines it again
    }
    EXPECT_GT(blocks, 3u);
    EXPECT_TRUE(reader.complete());
    EXPECT_FALSE(reader.next());
    std::string rest;
    std::getline(in, rest);
    EXPECT_EQ(rest, "what follows is not read");
}

TEST(Stream, EveryTruncationIsACoarserMeshOrAClearError) {
    LoggedBody body{"torus", torus(2, 0.6, 40, 18), {}};
    body.mesh.normals.clear();
    body.log = shortest_edges(body.mesh, 40, Placement::half).log; // more than one block
    const std::string whole = stream_of(body);
    std::set<std::size_t> levels;
    std::size_t errors = 0;
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        Exactly bytes(whole.data(), size);
        std::istream in(&bytes);
        try {
            ProgressiveReader reader(in);
            while (reader.next()) {
            }
            ASSERT_EQ(reader.complete(), size == whole.size()) << size;
            const std::size_t level = reader.mesh().level();
            if (levels.insert(level).second) {
                ASSERT_TRUE(
                    same(reader.mesh().mesh(), collapsed(body.mesh, body.log, body.log.size() - level)));
            }
            ASSERT_EQ(level, *levels.rbegin()) << "more bytes, no coarser mesh";
        } catch (const std::runtime_error& e) {
            ++errors;
            ASSERT_TRUE(levels.empty()) << "no error once there is a mesh: " << e.what();
            const std::string why = e.what();
            ASSERT_TRUE(why.find("cut off before its base mesh") != std::string::npos || size == 0) << why;
        }
    }
    EXPECT_GT(levels.size(), 3u);
    EXPECT_EQ(*levels.begin(), 0u);
    EXPECT_GT(errors, 50u);
}

TEST(Stream, EveryFlippedBitIsNoticed) {
    const std::string whole = stream_of(small_body());
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const int bit : {0, 3, 7}) {
            std::string damaged = whole;
            damaged[at] = char(damaged[at] ^ 1 << bit);
            Exactly bytes(damaged.data(), damaged.size());
            std::istream in(&bytes);
            try {
                ProgressiveReader reader(in);
                while (reader.next()) {
                }
                FAIL() << "byte " << at << ", bit " << bit;
            } catch (const std::runtime_error& e) {
                ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
            }
        }
}

TEST(Stream, SaysWhatIsWrong) {
    const Folder folder;
    const auto error = [&](const std::string& bytes) -> std::string {
        samples::write_text(folder / "bad.glpm", bytes);
        try {
            read_progressive(folder / "bad.glpm");
        } catch (const std::runtime_error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_NE(error("").find("is no progressive mesh of glcast"), std::string::npos) << error("");
    EXPECT_NE(error("ProgMesh").find("is no progressive mesh of glcast"), std::string::npos);
    std::string whole = stream_of(small_body());
    EXPECT_NE(error(whole.substr(0, 200)).find("cut off before its base mesh"), std::string::npos);
    EXPECT_EQ(error(whole.substr(0, whole.size() - 1)), "");
    EXPECT_FALSE(read_progressive(folder / "bad.glpm").complete);
    whole[8] = 2;
    EXPECT_NE(error(whole).find("is of format 2; this glcast reads up to 1"), std::string::npos)
        << error(whole);
    EXPECT_THROW(read_progressive(folder / "nowhere.glpm"), std::runtime_error);
    EXPECT_THROW(read_progressive(folder.path()), std::runtime_error);
    EXPECT_FALSE(looks_like_progressive(folder / "nowhere.glpm"));
}

template <class Float> void differences_come_back() {
    std::mt19937_64 random(3);
    using progressive::Bits;
    for (int k = 0; k < 100000; ++k) {
        const auto a = std::bit_cast<Float>(Bits<Float>(random())),
                   b = std::bit_cast<Float>(Bits<Float>(random()));
        const Float c = progressive::with_difference<Float>(progressive::difference<Float>(a, b), b);
        ASSERT_EQ(std::bit_cast<Bits<Float>>(a), std::bit_cast<Bits<Float>>(c));
    }
    const Float one = 1, next = std::nextafter(one, Float(2));
    EXPECT_EQ(progressive::difference<Float>(next, one), 2u);
    EXPECT_EQ(progressive::difference<Float>(one, next), 1u);
    EXPECT_EQ(progressive::difference<Float>(0, Float(-0.0)), 2u);
}

TEST(Packing, DifferencesComeBack) {
    differences_come_back<double>();
    differences_come_back<float>();
}

TEST(Packing, PacksAndRefusesWhatIsNotThatLong) {
    using namespace progressive;
    std::string bytes(3'000'000, 'a');
    for (std::size_t k = 0; k < bytes.size(); k += 3) bytes[k] = char(k * 2654435761u >> 7);
    for (const std::string& text : {std::string(), std::string("x"), bytes}) {
        const std::string small = packed({text, {text.size() / 2, text.size()}});
        EXPECT_TRUE(unpacked(small, text.size()) == text);
        EXPECT_THROW(unpacked(small, text.size() + 1), std::runtime_error);
        if (!text.empty()) {
            EXPECT_THROW(unpacked(small, text.size() - 1), std::runtime_error);
        }
        EXPECT_THROW(unpacked(small + "x", text.size()), std::runtime_error);
        EXPECT_THROW(unpacked(small.substr(0, small.size() - 1), text.size()), std::runtime_error);
    }
    EXPECT_EQ(checksum("123456789"), 0xCBF43926u); // CRC-32's check value
}

} // namespace
} // namespace glcast::test
