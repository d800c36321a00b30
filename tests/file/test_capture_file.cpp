// The capture file: round trip, other people's readers, and everything that must be refused.
#include <gtest/gtest.h>

#include <dlfcn.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "tests/file/capture_oracle.h"
#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/capture_reader.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

bool threads_are_refused = false;
} // namespace

/// Stands before the C library's.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                              void* argument) {
    if (threads_are_refused) return EAGAIN;
    using Create = decltype(&pthread_create);
    static const auto real = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
    return real(thread, attributes, run, argument);
}

class CaptureFileRoundTrip : public testing::TestWithParam<int> {};

TEST_P(CaptureFileRoundTrip, PixelsAndAttributes) {
    const int n = GetParam();
    const Folder folder;
    const auto path = folder / "sphere.exr";
    ASSERT_EQ(write_sphere(path, n), "");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"sphere.exr"});
    const Capture capture = read_capture(path);
    const CaptureInfo info = sphere_info(n);
    EXPECT_EQ(capture.info.n, n);
    EXPECT_EQ(capture.info.box.lo, info.box.lo);
    EXPECT_EQ(capture.info.box.size, info.box.size);
    EXPECT_EQ(capture.info.eye_to_capture, info.eye_to_capture);
    EXPECT_EQ(capture.info.eye, info.eye);
    EXPECT_EQ(capture.info.seen_places, info.seen_places);
    EXPECT_EQ(capture.info.program, info.program);
    EXPECT_EQ(capture.info.frame, info.frame);
    EXPECT_EQ(capture.info.renderer, info.renderer);
    EXPECT_EQ(capture.info.normals, info.normals);
    EXPECT_EQ(capture.info.glcast_version, info.glcast_version);
    EXPECT_EQ(capture.info.not_understood, info.not_understood);
    EXPECT_EQ(capture.file_bytes, std::filesystem::file_size(path));
    ASSERT_EQ(capture.images.size(), 6u);
    double worst_angle = 0, worst_colour = 0;
    for (const View& view : six_views()) {
        const ViewImage wanted = sphere_view(n, view.axis, view.side);
        const ViewImage& image = view_of(capture, view);
        EXPECT_EQ(image.depth, wanted.depth) << "depth is exact";
        for (std::size_t p = 0; p < wanted.depth.size(); ++p) {
            ASSERT_EQ(image.colour[p].a, wanted.colour[p].a);
            ASSERT_EQ(image.normal[p].w, wanted.normal[p].w);
            for (int c = 0; c < 3; ++c)
                worst_colour =
                    std::max<double>(worst_colour, std::abs(image.colour[p][c] - wanted.colour[p][c]));
            if (wanted.normal[p].w > 0)
                worst_angle = std::max(
                    worst_angle, angle_degrees(glm::vec3(image.normal[p]), glm::vec3(wanted.normal[p])));
        }
    }
    EXPECT_LT(worst_angle, 0.002);
    EXPECT_LT(worst_colour, 0.5 / 1023);
}

// 17, 33 and 100: chunks and bands that are not full
INSTANTIATE_TEST_SUITE_P(Sizes, CaptureFileRoundTrip, testing::Values(8, 17, 32, 33, 100));

TEST(CaptureFile, WhatGlMayLeaveOddIsMadePlain) {
    const Folder folder;
    CaptureWriter writer(folder / "odd.exr", sphere_info(8), 6);
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    for (const View& view : six_views()) {
        ViewImage image = sphere_view(8, view.axis, view.side);
        std::fill(image.colour.begin(), image.colour.end(), glm::vec4(0.5, 0.5, 0.5, 1));
        std::fill(image.depth.begin(), image.depth.end(), 0.5f);
        image.colour[0] = {nan, 7, -1, 1};
        image.depth[1] = nan;
        image.depth[2] = view.side == Side::minus ? -0.25f : 1.25f;
        image.normal[3] = {nan, 0, 0, 1};
        image.normal[4] = {infinity, 0, 0, 1};
        ASSERT_TRUE(writer.add(image)) << writer.error();
    }
    ASSERT_TRUE(writer.finish()) << writer.error();
    const Capture capture = read_capture(folder / "odd.exr");
    const ViewImage& image = view_of(capture, {Axis::x, Side::minus, 0});
    EXPECT_EQ(image.colour[0], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(image.colour[1].a, 0) << "no depth, not covered";
    EXPECT_EQ(image.depth[1], 1);
    EXPECT_EQ(image.depth[2], 0);
    EXPECT_EQ(image.normal[3].w, 0);
    EXPECT_EQ(image.normal[4].w, 0);
}

TEST(CaptureFile, LayersRoundTrip) {
    const Folder folder;
    ASSERT_EQ(write_nested(folder / "nested.exr", 33), "");
    const Capture capture = read_capture(folder / "nested.exr");
    EXPECT_EQ(capture.info.layers, Layers::complete);
    EXPECT_EQ(capture.info.layer_method, LayerMethod::peel);
    EXPECT_EQ(capture.info.layer_count, (std::array<int, 3>{5, 5, 5}));
    ASSERT_EQ(capture.images.size(), 18u);
    for (int axis = 0; axis < 3; ++axis)
        for (int layer = 1; layer <= 4; ++layer) {
            const ViewImage wanted = inner_view(33, Axis(axis), layer);
            const ViewImage& image = view_of(capture, wanted.view);
            EXPECT_EQ(image.depth, wanted.depth);
            EXPECT_GT(std::count(image.depth.begin(), image.depth.end(), 1.0f), 0);
        }
}

TEST(CaptureFile, PartsComeOneByOneInOrder) {
    const Folder folder;
    ASSERT_EQ(write_nested(folder / "nested.exr", 16), "");
    std::string order;
    const CaptureInfo info = read_capture(folder / "nested.exr", [&](ViewImage&& image) {
        order += part_name(image.view) + " ";
        EXPECT_EQ(image.depth.size(), 256u);
    });
    EXPECT_EQ(order,
              "-x.0 +x.0 -x.1 -x.2 -x.3 -x.4 -y.0 +y.0 -y.1 -y.2 -y.3 -y.4 -z.0 +z.0 -z.1 -z.2 -z.3 -z.4 ");
    EXPECT_EQ(info.layers, Layers::complete);
    EXPECT_EQ(read_capture_info(folder / "nested.exr").layer_count, info.layer_count);
}

TEST(CaptureFile, RoomForTheMostLayersThatMayCome) {
    const Folder folder;
    const CaptureInfo info = sphere_info(8);
    CaptureWriter writer(folder / "many.exr", info, 3 * (max_layers + 1));
    for (int axis = 0; axis < 3; ++axis) {
        ViewImage image = sphere_view(8, Axis(axis), Side::plus);
        ASSERT_TRUE(writer.add(image));
        image.view.side = Side::minus;
        for (image.view.layer = 0; image.view.layer < max_layers; ++image.view.layer) {
            const bool outer = image.view.layer == 0;
            image.depth.assign(64, outer ? 0 : image.view.layer / 1000.0f);
            image.depth.resize(32), image.depth.resize(64, 1.0f);
            for (int p = 0; p < 64; ++p) image.colour[p] = glm::vec4(p < 32);
            image.normal.assign(64, glm::vec4(0));
            ASSERT_TRUE(writer.add(image)) << writer.error();
        }
    }
    EXPECT_TRUE(writer.finish(Layers::incomplete, LayerMethod::slab)) << writer.error();
    // The last hits of these pixels are those of a sphere: most layers lie behind them.
    EXPECT_NE(why_refused(folder / "many.exr").find("does not lie between"), std::string::npos);
    EXPECT_EQ(read_capture_info(folder / "many.exr").layer_count[2], max_layers);
}

/// A capture whose pixels are all hit first at 1/8 and last at 7/8, with layers at the depths given.
std::string write_flat(const std::filesystem::path& path, const std::vector<std::vector<float>>& layers) {
    CaptureWriter writer(path, sphere_info(8), 6 + int(layers.size()));
    ViewImage image = sphere_view(8, Axis::x, Side::minus);
    image.colour.assign(64, glm::vec4(1));
    image.normal.assign(64, glm::vec4(0));
    for (const View& view : six_views()) {
        image.view = view;
        image.depth.assign(64, view.side == Side::minus ? 0.125f : 0.875f);
        writer.add(image);
    }
    image.view = {Axis::y, Side::minus, 0};
    for (const std::vector<float>& depths : layers) {
        ++image.view.layer;
        for (std::size_t p = 0; p < 64; ++p) {
            image.depth[p] = depths[p % depths.size()];
            image.colour[p] = glm::vec4(image.depth[p] < 1);
        }
        writer.add(image);
    }
    writer.finish(layers.empty() ? Layers::outer : Layers::complete,
                  layers.empty() ? LayerMethod::none : LayerMethod::peel);
    return writer.error();
}

TEST(CaptureFile, LayersOfAPixelMustGrowBetweenFirstAndLast) {
    const Folder folder;
    const auto why = [&](const std::vector<std::vector<float>>& layers) {
        EXPECT_EQ(write_flat(folder / "flat.exr", layers), "");
        return why_refused(folder / "flat.exr");
    };
    EXPECT_EQ(why({}), "");
    EXPECT_EQ(why({{0.25f, 1}, {0.5f, 1}}), "");
    EXPECT_EQ(why({{0.5f}, {0.75f, 1, 1}}), "");
    for (const auto& layers :
         std::vector<std::vector<std::vector<float>>>{{{0.125f}},            // the first hit again
                                                      {{0.875f}},            // the last
                                                      {{0.0625f}},           // in front of the first
                                                      {{0.9375f}},           // behind the last
                                                      {{0.5f}, {0.5f}},      // twice
                                                      {{0.5f}, {0.25f}},     // in the wrong order
                                                      {{0.5f, 1}, {0.75f}}}) // a layer left out
        EXPECT_NE(why(layers).find("does not lie between the layers around it"), std::string::npos);
}

TEST(CaptureFile, FilesOfFormat1AreRead) {
    const Capture capture = read_capture(GLCAST_TEST_FILES "/format1.exr");
    EXPECT_EQ(capture.info.layers, Layers::outer);
    EXPECT_EQ(capture.info.layer_method, LayerMethod::none);
    EXPECT_EQ(capture.info.layer_count, (std::array<int, 3>{1, 1, 1}));
    ASSERT_EQ(capture.images.size(), 6u);
    for (const View& view : six_views())
        EXPECT_EQ(view_of(capture, view).depth, sphere_view(8, view.axis, view.side).depth);
}

TEST(CaptureFile, WriterRefusesAndLeavesNothing) {
    const Folder folder;
    const auto refused = [&](const CaptureInfo& info, int parts, const std::vector<ViewImage>& images,
                             const char* why) {
        {
            CaptureWriter writer(folder / "x.exr", info, parts);
            bool ok = writer.error().empty();
            for (const ViewImage& image : images) ok = ok && writer.add(image);
            EXPECT_FALSE(ok && writer.finish());
            EXPECT_NE(writer.error().find(why), std::string::npos) << writer.error() << " / " << why;
        }
        EXPECT_TRUE(folder.names().empty()) << why;
    };
    const ViewImage image = sphere_view(8, Axis::x, Side::minus);
    CaptureInfo flat = sphere_info(8);
    flat.box.size = 0;
    refused(sphere_info(7), 6, {}, "8 to 8192");
    refused(sphere_info(8193), 6, {}, "8 to 8192");
    refused(flat, 6, {}, "box");
    refused(sphere_info(8), 5, {}, "six views");
    refused(sphere_info(8), 100000, {}, "too many");
    refused(sphere_info(8), 6, {image}, "view +x.0 is missing");
    refused(sphere_info(8), 6, {image, image}, "twice");
    const auto layer = [&](Side side, int number) {
        ViewImage deeper = image;
        deeper.view = {Axis::x, side, number};
        return deeper;
    };
    refused(sphere_info(8), 9, {image, layer(Side::minus, 2)}, "-x.2 comes before -x.1");
    refused(sphere_info(8), 9, {image, layer(Side::plus, 1)}, "no layer +x.1");
    refused(sphere_info(8), 9, {image, layer(Side::minus, -1)}, "no layer");
    std::vector<ViewImage> seven{layer(Side::minus, 0), layer(Side::minus, 1), layer(Side::minus, 2),
                                 layer(Side::minus, 3), layer(Side::minus, 4), layer(Side::minus, 5),
                                 layer(Side::minus, 6)};
    refused(sphere_info(8), 6, seven, "more views");
    std::vector<ViewImage> six_and_one;
    for (const View& view : six_views()) six_and_one.push_back(sphere_view(8, view.axis, view.side));
    six_and_one.push_back(layer(Side::minus, 1));
    refused(sphere_info(8), 7, six_and_one, "does not go with them"); // finished without a word on layers
    refused(sphere_info(16), 6, {image}, "wrong size");
}

TEST(CaptureFile, UnwritableTargets) {
    const Folder folder;
    EXPECT_NE(write_sphere(folder / "no" / "such" / "folder.exr", 8).find("No such file"), std::string::npos);
    EXPECT_NE(write_sphere(folder / "", 8).find("not a file name"), std::string::npos);
    EXPECT_NE(write_sphere("/dev/null", 8), "") << "a device must stay what it is";
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    std::filesystem::create_directory(folder / "folder.exr");
    EXPECT_NE(write_sphere(folder / "folder.exr", 8).find("directory"), std::string::npos);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"folder.exr"});
}

TEST(CaptureFile, AnOldFileStaysUntilTheNewOneIsWhole) {
    const Folder folder;
    write_text(folder / "old.exr", "old");
    {
        CaptureWriter writer(folder / "old.exr", sphere_info(8), 6);
        writer.add(sphere_view(8, Axis::x, Side::minus));
    }
    EXPECT_EQ(read_text(folder / "old.exr"), "old");
    EXPECT_EQ(write_sphere(folder / "old.exr", 8), "");
    EXPECT_EQ(read_capture(folder / "old.exr").info.n, 8);
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(CaptureFile, DiskFull) {
    const Folder folder;
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    rlimit small = before;
    small.rlim_cur = 20000; // write() beyond it fails as on a full disk
    const auto handler = signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string why = write_sphere(folder / "big.exr", 64);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, handler);
    EXPECT_NE(why.find("big.exr"), std::string::npos) << why;
    EXPECT_TRUE(folder.names().empty());
}

TEST(CaptureFile, TheSameBytesWhereNoThreadCanBeHad) {
    const Folder folder;
    threads_are_refused = true;
    const std::string why = write_sphere(folder / "alone.exr", 100);
    threads_are_refused = false;
    ASSERT_EQ(why, "");
    ASSERT_EQ(write_sphere(folder / "beside.exr", 100), "");
    EXPECT_TRUE(read_text(folder / "alone.exr") == read_text(folder / "beside.exr"));
}

/// Chunks of background alone are made once: between others, of both sides, and of the last lines, which are
/// fewer.
TEST(CaptureFile, BackgroundBetweenWhatIsSeen) {
    constexpr int n = 100;
    const Folder folder;
    std::vector<ViewImage> images;
    CaptureWriter writer(folder / "rows.exr", sphere_info(n), 6);
    for (const View& view : six_views()) {
        ViewImage image = blank_image(view, n);
        for (const int row : {3, 50, int(view.axis) == 1 ? 99 : 51})
            image.colour[std::size_t(row) * n + 7] = glm::vec4(1),
                                                image.depth[std::size_t(row) * n + 7] = 0.25f;
        ASSERT_TRUE(writer.add(image)) << writer.error();
        images.push_back(std::move(image));
    }
    ASSERT_TRUE(writer.finish()) << writer.error();
    const Capture capture = read_capture(folder / "rows.exr");
    for (const ViewImage& image : images) {
        EXPECT_EQ(view_of(capture, image.view).depth, image.depth);
        EXPECT_EQ(view_of(capture, image.view).colour, image.colour);
    }
}

TEST(CaptureFile, EveryTruncationIsRefused) {
    const Folder folder;
    ASSERT_EQ(write_nested(folder / "whole.exr", 8), "");
    const std::string whole = read_text(folder / "whole.exr");
    write_text(folder / "cut.exr", whole);
    // Every byte of the headers and of the last chunks; the hole between, and the other chunks, in steps.
    const auto step = [&](std::size_t at) { return at < 4096 || at + 4096 > whole.size() ? 1 : 41; };
    for (long length = long(whole.size()) - 1; length >= 0; length -= step(length)) {
        std::filesystem::resize_file(folder / "cut.exr", length);
        ASSERT_NE(why_refused(folder / "cut.exr"), "") << length << " of " << whole.size();
    }
    write_text(folder / "cut.exr", whole + "x");
    EXPECT_NE(why_refused(folder / "cut.exr"), "") << "more than a capture is none either";
    write_text(folder / "cut.exr", whole);
    EXPECT_EQ(why_refused(folder / "cut.exr"), "");
}

TEST(CaptureFile, ForeignAndMissingFilesAreRefused) {
    const Folder folder;
    EXPECT_NE(why_refused(folder / "none.exr").find("No such file"), std::string::npos);
    std::filesystem::create_directory(folder / "folder.exr");
    EXPECT_NE(why_refused(folder / "folder.exr").find("folder"), std::string::npos);
    write_text(folder / "text.exr", "this is some text, not a picture");
    EXPECT_NE(why_refused(folder / "text.exr").find("no OpenEXR"), std::string::npos);
    EXPECT_FALSE(looks_like_exr(folder / "text.exr"));
    write_text(folder / "empty.exr", "");
    EXPECT_NE(why_refused(folder / "empty.exr").find("empty"), std::string::npos);
    EXPECT_FALSE(looks_like_exr(folder / "empty.exr"));
}

TEST(CaptureFile, ANewerFormatSaysSo) {
    const Folder folder;
    ASSERT_EQ(write_sphere(folder / "new.exr", 8), "");
    std::string bytes = read_text(folder / "new.exr");
    const std::string name("glcast.format\0int\0\4\0\0\0", 22);
    for (std::size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1))
        bytes[at + name.size()] = capture_format_version + 1;
    write_text(folder / "new.exr", bytes);
    EXPECT_NE(why_refused(folder / "new.exr").find("newer glcast"), std::string::npos);
}

// Other people's readers and writers: Debian's package openexr.

TEST(CaptureFileTools, ExrheaderShowsNamesChannelsAndAttributes) {
    const Folder folder;
    ASSERT_EQ(write_sphere(folder / "s.exr", 16), "");
    const Ran ran = run("exrheader " + (folder / "s.exr").string());
    ASSERT_EQ(ran.status, 0) << ran.output;
    for (const char* text :
         {"\"-x.0\"", "\"+x.0\"", "\"-y.0\"", "\"+y.0\"", "\"-z.0\"", "\"+z.0\"", "Z, 32-bit floating-point",
          "A, 16-bit floating-point", "N.X, 32-bit floating-point", "glcast.boxLo", "glcast.eyeToCapture",
          "glcast.program (type string): \"sphere\"", "glcast.format (type int): 2", "glcast.notUnderstood",
          "zip, multi-scanline blocks"})
        EXPECT_NE(ran.output.find(text), std::string::npos) << text << "\n" << ran.output;
}

/// OpenEXR is the oracle: what it writes in any compression that is read, and what it reads of ours.
TEST(CaptureFileTools, OpenExrReadsAndWritesTheSamePixels) {
    constexpr int n = 33; // chunks that are not full
    const Folder folder;
    ASSERT_EQ(write_nested(folder / "ours.exr", n), "");
    const Capture ours = read_capture(folder / "ours.exr");
    for (const auto compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION}) {
        rewrite_by_openexr(folder / "ours.exr", folder / "theirs.exr", compression);
        const Capture theirs = read_capture(folder / "theirs.exr");
        ASSERT_EQ(theirs.images.size(), ours.images.size());
        for (std::size_t k = 0; k < ours.images.size(); ++k) {
            EXPECT_EQ(theirs.images[k].view, ours.images[k].view);
            EXPECT_EQ(theirs.images[k].depth, ours.images[k].depth) << compression;
            EXPECT_EQ(theirs.images[k].colour, ours.images[k].colour) << compression;
            EXPECT_EQ(theirs.images[k].normal, ours.images[k].normal) << compression;
        }
    }
    rewrite_by_openexr(folder / "ours.exr", folder / "theirs.exr", Imf::PIZ_COMPRESSION);
    EXPECT_NE(why_refused(folder / "theirs.exr").find("compression"), std::string::npos);
}

TEST(CaptureFileTools, ExrinfoAndExrmultipartOpenIt) {
    const Folder folder;
    ASSERT_EQ(write_sphere(folder / "s.exr", 16), "");
    const std::string file = (folder / "s.exr").string();
    const Ran info = run("exrinfo -s " + file);
    // Debian's exrinfo 3.1.5 ends with a random status, whatever it reads; so only what it prints counts.
    EXPECT_NE(info.output.find("part 6: +z.0"), std::string::npos) << info.output;
    EXPECT_NE(info.output.find("16 x 16"), std::string::npos) << info.output;
    EXPECT_EQ(info.output.find("ERROR"), std::string::npos) << info.output;
    const Ran split = run("cd " + folder.path().string() + " && exrmultipart -separate -i s.exr -o part");
    EXPECT_EQ(split.status, 0) << split.output;
    EXPECT_EQ(folder.names().size(), 7u);
    for (const std::string& name : folder.names()) {
        if (name == "s.exr") continue;
        EXPECT_TRUE(looks_like_exr(folder / name));
        EXPECT_NE(why_refused(folder / name), "") << "a single part is no capture";
    }
    const Ran joined =
        run("cd " + folder.path().string() + " && exrmultipart -combine -i part*.exr -o back.exr");
    ASSERT_EQ(joined.status, 0) << joined.output;
    EXPECT_EQ(read_capture(folder / "back.exr").images.size(), 6u)
        << "written by OpenEXR itself, and still a capture";
    const std::string five = "part.1.exr part.2.exr part.3.exr part.4.exr part.5.exr";
    ASSERT_EQ(
        run("cd " + folder.path().string() + " && exrmultipart -combine -i " + five + " -o five.exr").status,
        0);
    EXPECT_NE(why_refused(folder / "five.exr").find("view +z.0 is missing"), std::string::npos);
}
