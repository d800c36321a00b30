// The capture file where the two sides of what is drawn differ.
#include <gtest/gtest.h>

#include "tests/file/capture_oracle.h"
#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/capture_reader.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

/// From the other side everything has its colours turned round, and its normal.
ViewImage with_other_side(ViewImage image) {
    for (const glm::vec4& c : image.colour) image.other_colour.push_back({c.b, c.r, c.g, c.a});
    for (const glm::vec4& n : image.normal) image.other_normal.push_back({-glm::vec3(n), n.w});
    return image;
}

std::string write_both_sides(const std::filesystem::path& path, int n, std::size_t without) {
    CaptureInfo info = sphere_info(n);
    info.both_sides = true;
    CaptureWriter writer(path.string(), info, 6);
    for (std::size_t i = 0; i < six_views().size(); ++i) {
        const ViewImage image = sphere_view(n, six_views()[i].axis, six_views()[i].side);
        writer.add(i == without ? image : with_other_side(image));
    }
    writer.finish();
    return writer.error();
}

} // namespace

// What is not said of the other side is alike there.
TEST(CaptureFile, BothSidesRoundTrip) {
    constexpr int n = 33;
    const Folder folder;
    ASSERT_EQ(write_both_sides(folder / "both.exr", n, 2), "");
    rewrite_by_openexr(folder / "both.exr", folder / "theirs.exr", Imf::ZIPS_COMPRESSION);
    const Capture capture = read_capture(folder / "both.exr"), theirs = read_capture(folder / "theirs.exr");
    EXPECT_TRUE(capture.info.both_sides);
    double worst_angle = 0, worst_colour = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        const View& view = six_views()[i];
        const ViewImage plain = sphere_view(n, view.axis, view.side), other = with_other_side(plain);
        const ViewImage& image = view_of(capture, view);
        EXPECT_EQ(image.depth, plain.depth);
        EXPECT_EQ(view_of(theirs, view).other_colour, image.other_colour);
        EXPECT_EQ(view_of(theirs, view).other_normal, image.other_normal);
        for (std::size_t p = 0; p < plain.depth.size(); ++p) {
            const glm::vec4 colour = i == 2 ? plain.colour[p] : other.other_colour[p];
            const glm::vec4 normal = i == 2 ? plain.normal[p] : other.other_normal[p];
            ASSERT_EQ(image.other_colour[p].a, colour.a);
            ASSERT_EQ(image.other_normal[p].w, normal.w);
            for (int c = 0; c < 3; ++c)
                worst_colour = std::max<double>(worst_colour, std::abs(image.other_colour[p][c] - colour[c]));
            if (normal.w > 0)
                worst_angle =
                    std::max(worst_angle, angle_degrees(glm::vec3(image.other_normal[p]), glm::vec3(normal)));
        }
    }
    EXPECT_LT(worst_angle, 0.002);
    EXPECT_LT(worst_colour, 0.5 / 1023);
}

TEST(CaptureFile, OfOneSideIsOfFormat2) {
    const Folder folder;
    ASSERT_EQ(write_sphere(folder / "one.exr", 8), "");
    EXPECT_FALSE(read_capture(folder / "one.exr").info.both_sides);
    EXPECT_TRUE(read_capture(folder / "one.exr").images[0].other_colour.empty());
    // The channels of the one are not those of the other.
    std::string bytes = read_text(folder / "one.exr");
    const std::string name("glcast.format\0int\0\4\0\0\0", 22);
    for (std::size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1))
        bytes[at + name.size()] = 3;
    write_text(folder / "one.exr", bytes);
    EXPECT_NE(why_refused(folder / "one.exr").find("channels"), std::string::npos);
}
