// GLCAST_REFERENCE_VIEWS: further views of the frame that is cast, beside its capture.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "capture/reference_views.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

const std::vector<std::string> spheres = {FIXTURE_GLX, "--shape", "spheres",       "--frames",     "3",
                                          "--size",    "160x120", "--make-errors", "--angle-step", "10"};

std::set<std::string> files_in(const TemporaryFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.string()))
        names.insert(entry.path().filename());
    return names;
}

TEST(ReferenceViews, stand_beside_the_capture_and_the_program_sees_nothing) {
    const TemporaryFolder folder;
    const FixtureRun plain = run_fixture(spheres, {}, false);
    const FixtureRun cast = cast_fixture(
        spheres, {{"GLCAST_OUT", folder / "a.exr"}, {"GLCAST_REFERENCE_VIEWS", "7"}, {"GLCAST_FRAME", "2"}});
    EXPECT_EQ(plain.pixels, cast.pixels);
    EXPECT_EQ(plain.errors, cast.errors);
    EXPECT_EQ(plain.state, cast.state);
    EXPECT_EQ(files_in(folder), (std::set<std::string>{"a.exr", "a.reference-1.exr", "a.reference-2.exr"}))
        << cast.outcome.err;
    const CaptureInfo info = read_capture_info(folder / "a.exr");
    EXPECT_FALSE(info.from_capture);
    const std::vector<glm::dmat4> rotations = reference_rotations(7);
    for (int number = 1; number <= 2; ++number) {
        const Capture turned = read_capture(reference_name(folder / "a.exr", number));
        EXPECT_EQ(turned.images.size(), 6u) << "no layers";
        EXPECT_EQ(turned.info.n, info.n);
        EXPECT_EQ(turned.info.frame, 2);
        ASSERT_TRUE(turned.info.from_capture);
        EXPECT_EQ(*turned.info.from_capture, rotations[number - 1]);
        EXPECT_EQ(turned.info.eye_to_capture, rotations[number - 1] * info.eye_to_capture);
        for (const ViewImage& image : turned.images) {
            long covered = 0;
            for (std::size_t p = 0; p < image.depth.size(); ++p) covered += image.covered(p);
            EXPECT_GT(covered, 500) << part_name(image.view);
        }
    }
}

TEST(ReferenceViews, may_be_finer_than_the_capture) {
    const TemporaryFolder folder;
    cast_fixture(spheres, {{"GLCAST_OUT", folder / "a.exr"},
                           {"GLCAST_N", "32"},
                           {"GLCAST_REFERENCE_VIEWS", "12"},
                           {"GLCAST_REFERENCE_N", "64"}});
    const CaptureInfo info = read_capture_info(folder / "a.exr");
    EXPECT_EQ(info.n, 32);
    for (int number = 1; number <= 2; ++number) {
        const Capture turned = read_capture(reference_name(folder / "a.exr", number));
        EXPECT_EQ(turned.info.n, 64);
        ASSERT_EQ(turned.images.size(), 6u);
        EXPECT_EQ(turned.images[0].n, 64);
        EXPECT_EQ(turned.info.eye_to_capture, *turned.info.from_capture * info.eye_to_capture);
    }
}

TEST(ReferenceViews, other_values_are_refused) {
    for (const Environment& environment :
         {Environment{{"GLCAST_REFERENCE_VIEWS", "6"}, {"GLCAST_REFERENCE_N", "7"}},
          Environment{{"GLCAST_REFERENCE_VIEWS", "0"}}, Environment{{"GLCAST_REFERENCE_VIEWS", "37"}},
          Environment{{"GLCAST_REFERENCE_VIEWS", "many"}},
          Environment{{"GLCAST_REFERENCE_VIEWS", "6"}, {"GLCAST_BOX", "0,0,0,1,1,1"}}}) {
        const FixtureRun cast = cast_fixture(spheres, environment);
        EXPECT_FALSE(cast.capture);
        ASSERT_FALSE(glcast_lines(cast.outcome).empty());
        EXPECT_NE(cast.outcome.err.find("GLCAST_REFERENCE_"), std::string::npos) << cast.outcome.err;
    }
}

} // namespace
} // namespace glcast::test
