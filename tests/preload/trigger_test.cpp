// When frames are cast: every so many-th, so many in all, at a key, at a signal; and what the files are called.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "capture/output_name.h"
#include "tests/preload/key_presser.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

std::vector<std::string> cube(const std::string& frames) {
    return {FIXTURE_GLX, "--shape", "cube", "--frames", frames, "--size", "160x120"};
}

std::set<std::string> files_in(const TemporaryFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.string()))
        names.insert(entry.path().filename());
    return names;
}

TEST(OutputName, is_filled_in) {
    EXPECT_EQ(output_name("a.exr", 7, 9), "a.exr");
    EXPECT_EQ(output_name("%p-%f.exr", 7, 9), "7-9.exr");
    EXPECT_EQ(output_name("100%%%f%", 7, 9), "100%9%");
    EXPECT_EQ(output_name("%x", 7, 9), "%x");
}

struct Several {
    const char* name;
    Environment environment;
    std::set<std::string> files;
};
const Several severals[] = {
    {"every_frame", {{"GLCAST_EVERY", "1"}}, {"1.exr", "2.exr", "3.exr", "4.exr", "5.exr", "6.exr", "7.exr"}},
    {"every_third_from_the_second",
     {{"GLCAST_EVERY", "3"}, {"GLCAST_FRAME", "2"}},
     {"2.exr", "5.exr"}},
    {"two_in_a_row", {{"GLCAST_CAPTURES", "2"}}, {"1.exr", "2.exr"}},
    {"two_of_every_second", {{"GLCAST_EVERY", "2"}, {"GLCAST_CAPTURES", "2"}}, {"1.exr", "3.exr"}},
};

TEST(Several, are_cast_and_the_program_sees_nothing) {
    const FixtureRun plain = run_fixture(cube("7"), {}, false);
    for (const Several& several : severals) {
        SCOPED_TRACE(several.name);
        const TemporaryFolder folder;
        Environment environment = several.environment;
        environment["GLCAST_OUT"] = folder / "%f.exr";
        environment["GLCAST_N"] = "16";
        const FixtureRun cast = run_fixture(cube("7"), environment, true);
        EXPECT_EQ(files_in(folder), several.files) << cast.outcome.err;
        for (const std::string& name : files_in(folder)) {
            const Capture capture = read_capture(folder / name);
            EXPECT_EQ(capture.images.size(), 6u);
            EXPECT_EQ(std::to_string(capture.info.frame) + ".exr", name);
        }
        EXPECT_EQ(plain.outcome.out, cast.outcome.out);
        EXPECT_TRUE(plain.pixels == cast.pixels);
        EXPECT_EQ(plain.errors, cast.errors);
        EXPECT_EQ(plain.state, cast.state);
    }
}

TEST(Key, asks_for_a_frame_and_reaches_the_program) {
    const TemporaryFolder folder;
    x_server();
    const KeyPresser presser;
    const Outcome outcome = run_program(
        {SCENES, "keys"},
        {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "16"}, {"GLCAST_KEY", "F12"}, {"GLCAST_CAPTURES", "1"}},
        true);
    EXPECT_EQ(outcome.out, "pressed 1\n") << outcome.err;
    EXPECT_EQ(files_in(folder), std::set<std::string>{"cast.exr"}) << outcome.err;
}

TEST(Key, that_is_not_pressed_casts_nothing) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_program(cube("5"), {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_KEY", "F12"}}, true);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(files_in(folder).empty());
}

/// A program that draws only when its window is exposed gives one frame by itself.
TEST(Nudge, makes_frames_come) {
    const TemporaryFolder folder;
    const std::vector<std::string> program = {FIXTURE_GLX, "--shape", "cube", "--on-expose", "--frames", "4"};
    const Outcome outcome = run_program(program,
                                        {{"GLCAST_OUT", folder / "%f.exr"},
                                         {"GLCAST_N", "16"},
                                         {"GLCAST_FRAME", "3"},
                                         {"GLCAST_NUDGE", "1"},
                                         {"GLCAST_QUIT", "1"}},
                                        true);
    EXPECT_FALSE(outcome.timed_out);
    EXPECT_EQ(files_in(folder), std::set<std::string>{"3.exr"}) << outcome.err;
}

} // namespace
} // namespace glcast::test
