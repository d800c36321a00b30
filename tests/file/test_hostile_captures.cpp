// Captures made to do harm: two readings of one header, sizes that nothing backs, contradictions, names that
// lead a terminal. Each is refused with one line, within memory that the file explains.
#include <gtest/gtest.h>

#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <zlib.h>

#include "tests/file/exr_edit.h"
#include "tests/file/file_tools.h"
#include "tests/file/memory_limit.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/capture_reader.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

class HostileCapture : public testing::Test {
  protected:
    /// Why it is refused, or nothing.
    std::string why(const std::filesystem::path& path) {
        const test::MemoryLimit limit;
        try {
            read_capture(path);
        } catch (const std::runtime_error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "one line: " << e.what();
            EXPECT_EQ(std::string(e.what()).find("bad_alloc"), std::string::npos);
            return e.what();
        }
        return "";
    }
    std::string why_bytes(const std::string& bytes) {
        write_text(folder / "h.exr", bytes);
        return why(folder / "h.exr");
    }
    std::string why(const RawCapture& capture) { return why_bytes(capture.bytes()); }
    bool has(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << '"' << text << "\" has no \"" << part << '"';
        return text.find(part) != std::string::npos;
    }
    std::string whole(int n = 8) {
        EXPECT_EQ(write_sphere(folder / "whole.exr", n), "");
        return read_text(folder / "whole.exr");
    }
    Folder folder;
};

/// Attributes of one name, type and value of that many bytes.
std::string attribute_bytes(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + raw(std::uint32_t(value.size())) + value;
}

} // namespace

TEST_F(HostileCapture, WhatWasFoundIsRefused) {
    const std::filesystem::path files = GLCAST_HOSTILE_FILES;
    has(why(files / "capture-header-read-two-ways-writes-past-buffer.exr"), "as long as its type");
    has(why(files / "capture-header-read-two-ways-asks-130-gb.exr"), "as long as its type");
    has(why(files / "capture-box-of-1e-320-makes-mesh-that-is-refused.exr"), "box");
    has(why(files / "capture-first-hit-behind-last-hit-accepted.exr"), "in front of the first");
    EXPECT_EQ(why(files / "capture-program-name-with-terminal-escapes.exr"), "") << "info writes it safely";
}

/// The file taken apart and put together is still a capture: so what is refused below is refused for its
/// change.
TEST_F(HostileCapture, UnchangedIsRead) { EXPECT_EQ(why(RawCapture(whole())), ""); }

struct Fixed {
    const char* type;
    std::size_t bytes;
};
constexpr Fixed fixed_types[] = {{"box2f", 16},   {"box2i", 16},   {"chromaticities", 32},
                                 {"double", 8},   {"envmap", 1},   {"float", 4},
                                 {"int", 4},      {"keycode", 28}, {"m33d", 72},
                                 {"m33f", 36},    {"m44d", 128},   {"m44f", 64},
                                 {"rational", 8}, {"timecode", 8}, {"v2d", 16},
                                 {"v2f", 8},      {"v2i", 8},      {"v3d", 24},
                                 {"v3f", 12},     {"v3i", 12},     {"compression", 1},
                                 {"lineOrder", 1}};

TEST_F(HostileCapture, AnAttributeIsAsLongAsItsType) {
    const RawCapture good(whole());
    // What a reader that goes by types finds behind the true end of the value.
    const std::string smuggled = attribute_bytes("dataWindow", "box2i", raw(0, 0, 59999, 59999));
    for (const Fixed& type : fixed_types) {
        for (const long more : {-1L, 0L, 1L, 4L, long(smuggled.size())}) {
            RawCapture bad = good;
            std::string value(type.bytes, 0);
            value.resize(type.bytes + std::size_t(more));
            if (more == long(smuggled.size())) value.replace(type.bytes, smuggled.size(), smuggled);
            bad.add("zz", type.type, value);
            EXPECT_EQ(why(bad).empty(), more == 0) << type.type << " " << more;
        }
    }
}

TEST_F(HostileCapture, PlacesAreNumbersOrNotThere) {
    const RawCapture good(whole());
    for (const char* name : {"glcast.eye", "glcast.seenPlace.0"}) {
        RawCapture bad = good;
        bad.set(name, raw(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0));
        has(why(bad), std::string(name) + " is not finite");
        RawCapture without = good;
        for (auto& part : without.parts) std::erase_if(part, [&](const auto& a) { return a.name == name; });
        EXPECT_EQ(why(without), "") << name;
    }
    RawCapture many = good; // those beyond the most are not read
    for (int k = 2; k < 100; ++k)
        many.add("glcast.seenPlace." + std::to_string(k), "v3d", raw(1.0, 2.0, 3.0));
    EXPECT_EQ(why(many), "");
    EXPECT_EQ(read_capture_info(folder / "h.exr").seen_places.size(), std::size_t(most_seen_places));
}

TEST_F(HostileCapture, EveryAttributeOfACaptureOfAnotherLength) {
    const RawCapture good(whole());
    for (const RawAttribute& a : good.parts[1])
        for (const int more : {-4, -1, 1, 4, 1 << 30}) {
            if (int(a.value.size()) + more < 0) continue;
            RawCapture bad = good; // the value as it was, another length said
            bad.attribute(1, a.name).stated += std::uint32_t(more);
            EXPECT_NE(why(bad), "") << a.name << " " << more;
            bad = good; // the value cut or padded to it
            if (more > 4 || a.type == "string") continue;
            RawAttribute& changed = bad.attribute(1, a.name);
            changed.value.resize(changed.value.size() + std::size_t(more));
            changed.stated = std::uint32_t(changed.value.size());
            EXPECT_NE(why(bad), "") << a.name << " " << more;
        }
}

TEST_F(HostileCapture, StringsAndChannelsFillTheirLength) {
    const RawCapture good(whole());
    for (const std::string& value : {raw(5) + "1 a", raw(3) + "1 a" + raw(1), raw(-1) + "1 a",
                                     raw(3) + "1 ab", raw(1 << 31), std::string("abc")}) {
        RawCapture bad = good;
        bad.set("glcast.notUnderstood", value);
        has(why(bad), "as long as its type");
    }
    const std::string channels = RawCapture(good).attribute(0, "channels").value;
    const std::string first = channels.substr(0, 18); // "A", 0, and its numbers
    for (const std::string& value : {channels + '\0', channels.substr(0, channels.size() - 1), std::string(),
                                     channels.substr(0, 10), channels + first}) {
        RawCapture bad = good;
        bad.set("channels", value);
        has(why(bad), "as long as its type");
    }
    std::string uint = channels, sampled = channels, order = channels;
    uint[2] = 0, sampled[10] = 2, std::swap(order[0], order[18]);
    for (const std::string& value :
         {first + channels, channels.substr(18), uint, sampled, order, std::string(1, 0)}) {
        RawCapture bad = good;
        bad.set("channels", value);
        has(why(bad), "channels");
    }
}

TEST_F(HostileCapture, WhatMakesAPartSomethingElse) {
    const RawCapture good(whole());
    const auto with = [&](const std::string& name, const std::string& type, const std::string& value) {
        RawCapture bad = good;
        bad.add(name, type, value);
        return why(bad);
    };
    EXPECT_NE(with("tiles", "tiledesc", std::string(9, 1)), "");
    EXPECT_NE(with("preview", "preview", raw(1, 1, 0)), "");
    EXPECT_NE(with("zz", "preview", raw(1 << 15, 1 << 15)), "");
    EXPECT_NE(with("version", "int", raw(1)), "");
    EXPECT_NE(with("maxSamplesPerPixel", "int", raw(1)), "");
    EXPECT_NE(with("multiView", "stringvector", raw(4) + "left"), "");
    EXPECT_NE(with("zz", "mine", "1234"), "") << "a type that nobody knows";
    EXPECT_NE(with("dataWindow", "box2i", raw(0, 0, 7, 7)), "") << "twice";
    EXPECT_NE(with(std::string(32, 'z'), "int", raw(1)), "") << "a name too long for the version";
    EXPECT_EQ(with(std::string(31, 'z'), "int", raw(1)), "");
    EXPECT_EQ(with("owner", "string", "somebody"), "") << "what others write beside is no harm";
    RawCapture bad = good;
    bad.set("type", "tiledimage");
    EXPECT_NE(why(bad), "");
    bad = good;
    bad.set("compression", raw(char(4)));
    EXPECT_NE(why(bad), "");
    bad = good;
    bad.attribute(3, "glcast.program").value[0] ^= 1;
    has(why(bad), "differ in glcast.program");
}

TEST_F(HostileCapture, SizesThatTheFileDoesNotBack) {
    const RawCapture good(whole());
    for (const int n : {7, 9, 60000, 8192, -8, 0, std::numeric_limits<int>::max()}) {
        RawCapture bad = good;
        bad.set("glcast.n", raw(n));
        EXPECT_NE(why(bad), "") << n;
        bad.set("dataWindow", raw(0, 0, n - 1, n - 1));
        bad.set("displayWindow", raw(0, 0, n - 1, n - 1));
        EXPECT_NE(why(bad), "") << n;
        bad.set("chunkCount", raw((n + 15) / 16));
        EXPECT_NE(why(bad), "") << n;
    }
    RawCapture many = good;
    while (many.parts.size() < 800) many.parts.push_back(many.parts[0]);
    has(why(many), "too many parts");
    RawCapture wide = good;
    for (int k = 0; k < 300; ++k) wide.add("z" + std::to_string(k), "int", raw(k));
    has(why(wide), "too many attributes");
}

TEST_F(HostileCapture, ChunksDoNotOverlapAndUnpackToTheirLines) {
    const RawCapture good(whole(32)); // two chunks a part
    RawCapture bad = good;
    // The first chunk of part 0 holds the second, head and all.
    const std::size_t second = good.offsets[1];
    const std::string inner = good.chunks.substr(second, 12 + good.chunk_size(1));
    bad.replace_chunk(0, inner);
    bad.offsets[1] = bad.offsets[0] + 12;
    has(why(bad), "begins in another");

    const std::size_t size = 16 * 32 * 26;
    const auto packed = [](const std::string& bytes) {
        std::string out(compressBound(bytes.size()), 0);
        uLongf made = out.size();
        compress(reinterpret_cast<Bytef*>(out.data()), &made, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size());
        out.resize(made);
        return out;
    };
    for (const std::string& data :
         {packed(std::string(size - 1, '\x80')), packed(std::string(size + 1, '\x80')),
          packed(std::string(8 << 20, 0)), std::string("no zlib"), std::string(), std::string(size + 1, 0)}) {
        bad = good;
        bad.replace_chunk(2, data);
        has(why(bad), "does not unpack to its lines");
    }
    RawCapture runs(whole(8)); // one line a chunk, as ZIP has one chunk of these eight
    bad = runs;
    bad.set("compression", raw(char(1)));
    EXPECT_NE(why(bad), "") << "chunkCount is not that of RLE";
}

TEST_F(HostileCapture, BoxesInWhichNoMeshCanBeMade) {
    const RawCapture good(whole());
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const auto with = [&](double lo, double size) {
        RawCapture bad = good;
        bad.set("glcast.boxLo", raw(lo, 0.0, -lo));
        bad.set("glcast.boxSize", raw(size));
        return why(bad);
    };
    for (const double size : {1e-320, 1e-30, 0.0, -0.0, -1.0, 1e19, 1e308, nan, inf})
        has(with(0, size), "box");
    for (const double lo : {1e17, -1e30, 1e308, nan, inf}) has(with(lo, 1), "box");
    has(with(1e308, 1e308), "box");
    for (const double size : {1e-17, 1.0, 1e17}) EXPECT_EQ(with(-size / 2, size), "");
    EXPECT_EQ(with(4.5e6, 2), "") << "map coordinates";
    // The writer refuses them too: no cast makes a capture that nobody can read.
    CaptureInfo info = sphere_info(8);
    info.box = {glm::dvec3(0), 1e-320};
    EXPECT_NE(CaptureWriter(folder / "w.exr", info, 6).error(), "");
    info.box = {glm::dvec3(1e17), 1};
    EXPECT_NE(CaptureWriter(folder / "w.exr", info, 6).error(), "");
}

/// All pixels of all views at these depths; y alone for the first and last hits in question.
TEST_F(HostileCapture, TheFirstHitIsNotBehindTheLast) {
    const auto written = [&](float first, float last, std::size_t pixels) {
        CaptureWriter writer(folder / "d.exr", sphere_info(8), 6);
        for (const View& view : six_views()) {
            ViewImage image = blank_image(view, 8);
            for (std::size_t p = 64 - pixels; p < 64; ++p) {
                const bool asked = view.axis == Axis::y;
                image.colour[p] = glm::vec4(1);
                image.depth[p] = view.side == Side::minus ? (asked ? first : 0.25f) : (asked ? last : 0.75f);
            }
            writer.add(image);
        }
        EXPECT_TRUE(writer.finish()) << writer.error();
        return why(folder / "d.exr");
    };
    EXPECT_EQ(written(0.25f, 0.75f, 64), "");
    EXPECT_EQ(written(0.5f, 0.5f, 1), "") << "a sheet";
    has(written(0.75f, 0.25f, 64), "part +y.0 has a last hit in front of the first");
    has(written(std::nextafter(0.5f, 1.0f), 0.5f, 1), "+y.0");
    has(written(1, 0, 1), "+y.0");
}

TEST_F(HostileCapture, NothingButARegularFileIsOpened) {
    ASSERT_EQ(mkfifo((folder / "fifo.exr").c_str(), 0600), 0);
    has(why(folder / "fifo.exr"), "no regular file"); // and does not wait for a writer
    has(why("/dev/zero"), "no regular file");
}

// What the command prints of names in files, and of files.

namespace {

bool is_plain(const std::string& text) {
    return std::none_of(text.begin(), text.end(),
                        [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == 0x7f; });
}

} // namespace

TEST_F(HostileCapture, InfoWritesNoControlCharacters) {
    const std::string command = GLCAST_COMMAND;
    const Ran found =
        run(command + " info " GLCAST_HOSTILE_FILES "/capture-program-name-with-terminal-escapes.exr");
    EXPECT_EQ(found.status, 0);
    EXPECT_TRUE(is_plain(found.output)) << found.output;
    has(found.output, "\\x1b");

    RawCapture bad(whole());
    const std::string evil = "\033]0;title\007\r\nview  -x.0 all is well\n\x9b"
                             "2J\xc2\x9b"
                             "1m\x7f";
    for (const char* name : {"glcast.program", "glcast.renderer", "glcast.normals", "glcast.version"})
        bad.set(name, evil);
    bad.set("glcast.notUnderstood", raw(std::uint32_t(evil.size() + 2)) + "3 " + evil);
    write_text(folder / "evil.exr", bad.bytes());
    const Ran evil_run = run(command + " info " + (folder / "evil.exr").string());
    EXPECT_EQ(evil_run.status, 0);
    EXPECT_TRUE(is_plain(evil_run.output)) << evil_run.output;
    EXPECT_EQ(evil_run.output.find("\x9b"), std::string::npos) << "C1 controls";
    EXPECT_EQ(evil_run.output.find("\nview  -x.0 all"), std::string::npos) << "no line of its own";
    const Ran missing = run(command + " info \"$(printf \"no\\033[31m\\nfile.exr\")\"");
    EXPECT_EQ(missing.status, 1);
    EXPECT_TRUE(is_plain(missing.output)) << missing.output;
    EXPECT_EQ(std::count(missing.output.begin(), missing.output.end(), '\n'), 1) << missing.output;
}
