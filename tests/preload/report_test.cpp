// What people are told when there is nothing to capture: one clear line, no file, and the program runs as
// always.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct Refusal {
    const char* name;
    std::vector<std::string> arguments;
    Environment environment;
    const char* says;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

const std::vector<std::string> cube = {FIXTURE_GLX, "--shape", "cube", "--frames", "2"};

const Refusal refusals[] = {
    {"no_gl", {FIXTURE_GLX, "--no-gl", "--frames", "2"}, {}, "no GL seen"},
    {"empty_frames", {FIXTURE_GLX, "--empty", "--frames", "3"}, {}, "3 frames, none with solid geometry"},
    {"frame_that_never_comes", cube, {{"GLCAST_FRAME", "7"}}, "ended after 2 frames"},
    {"n_too_small", cube, {{"GLCAST_N", "7"}}, "GLCAST_N=7: expected a whole number from 8 to 8192"},
    {"n_too_large", cube, {{"GLCAST_N", "8193"}}, "GLCAST_N=8193"},
    {"n_is_no_number", cube, {{"GLCAST_N", "64x"}}, "GLCAST_N=64x"},
    {"layers_unknown",
     cube,
     {{"GLCAST_LAYERS", "many"}},
     "expected auto, slab, or a whole number from 1 to 256"},
    {"layers_none", cube, {{"GLCAST_LAYERS", "0"}}, "expected auto, slab, or a whole number from 1 to 256"},
    {"normals_unknown", cube, {{"GLCAST_NORMALS", "seven"}}, "expected signed or six"},
    {"box_inside_out", cube, {{"GLCAST_BOX", "1,1,1,0,0,0"}}, "GLCAST_BOX"},
    {"matrix_of_three", cube, {{"GLCAST_FRAME_MATRIX", "1 2 3"}}, "GLCAST_FRAME_MATRIX"},
    {"no_such_folder", cube, {{"GLCAST_OUT", "/no/such/folder/cast.exr"}}, "no folder /no/such/folder"},
    {"folder_for_a_file", cube, {{"GLCAST_OUT", "/"}}, "it is a folder"},
    {"mesh_for_a_capture", cube, {{"GLCAST_OUT", "/tmp/a.glb"}}, "a capture is named .exr"},
    {"no_such_group",
     cube,
     {{"GLCAST_GROUP", "9"}},
     "there is no group 9, the frame has 1 group: 1 12 triangles in 6 draws, perspective, viewport"},
    {"no_such_group_where_all_is_flat",
     {FIXTURE_GLX, "--empty", "--overlay", "--frames", "2"},
     {{"GLCAST_GROUP", "9"}},
     "there is no group 9, the frame has 1 group: 1 "},
    {"no_such_key", cube, {{"GLCAST_KEY", "F99"}}, "GLCAST_KEY=F99: expected a key"},
    {"no_such_signal", cube, {{"GLCAST_SIGNAL", "KILL"}}, "GLCAST_SIGNAL=KILL: expected a signal"},
    {"include_unknown", cube, {{"GLCAST_INCLUDE", "text"}}, "expected lines, points or lines,points"},
};

class Refused : public testing::TestWithParam<Refusal> {};

TEST_P(Refused, in_one_clear_line) {
    const TemporaryFolder folder;
    Environment environment = {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}};
    for (const auto& [name, value] : GetParam().environment) environment[name] = value;
    const Outcome outcome = run_program(GetParam().arguments, environment, true);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto lines = glcast_lines(outcome);
    const auto complaints = std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(GetParam().says) != std::string::npos;
    });
    EXPECT_EQ(complaints, 1) << outcome.err;
    EXPECT_LE(lines.size(), 2u) << outcome.err; // "hooked ..." is the other
    EXPECT_TRUE(std::filesystem::is_empty(folder.string()));
}
INSTANTIATE_TEST_SUITE_P(Reports, Refused, testing::ValuesIn(refusals),
                         [](const auto& info) { return info.param.name; });

TEST(Report, groups_are_listed_and_nothing_is_captured) {
    std::vector<std::string> arguments = cube;
    arguments.push_back("--overlay");
    const TemporaryFolder folder;
    const Outcome outcome =
        run_program(arguments, {{"GLCAST_LIST", "1"}, {"GLCAST_OUT", folder / "cast.exr"}}, true);
    EXPECT_EQ(outcome.exit_code, 0);
    const auto lines = glcast_lines(outcome);
    ASSERT_EQ(lines.size(), 4u) << outcome.err; // hooked, two groups, listed
    EXPECT_NE(lines[1].find("group 1 12 triangles"), std::string::npos) << lines[1];
    EXPECT_NE(lines[1].find("perspective"), std::string::npos) << lines[1];
    EXPECT_NE(lines[2].find("flat"), std::string::npos) << lines[2];
    EXPECT_TRUE(std::filesystem::is_empty(folder.string()));
}

TEST(Report, second_group_can_be_picked) {
    std::vector<std::string> arguments = cube;
    arguments.push_back("--overlay");
    const FixtureRun first = cast_fixture(arguments),
                     second = cast_fixture(arguments, {{"GLCAST_GROUP", "2"}});
    ASSERT_TRUE(first.capture && second.capture) << second.outcome.err;
    EXPECT_NE(first.capture->info.box.size, second.capture->info.box.size);
}

TEST(Report, without_an_output_the_shim_is_silent) {
    const Outcome outcome = run_program(cube, {}, true);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(glcast_lines(outcome).empty()) << outcome.err;
}

TEST(Report, program_is_ended_when_asked) {
    const TemporaryFolder folder;
    const std::vector<std::string> endless = {FIXTURE_GLX, "--shape", "cube"};
    const Outcome outcome = run_program(
        endless, {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}, {"GLCAST_QUIT", "1"}}, true);
    EXPECT_FALSE(outcome.timed_out);
    EXPECT_EQ(outcome.signal, 15);
    EXPECT_EQ(read_capture(folder / "cast.exr").images.size(), 6u);
}

TEST(Report, status_file_tells_the_events) {
    const TemporaryFolder folder;
    std::ofstream(folder / "status").close();
    const Environment environment = {
        {"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "32"}, {"GLCAST_STATUS", folder / "status"}};
    run_program(cube, environment, true);
    std::ifstream file(folder / "status");
    std::vector<std::string> events;
    std::set<std::string> processes;
    for (std::string line; std::getline(file, line);) {
        const std::size_t at = line.find('@'), space = line.find(' ');
        ASSERT_LT(at, space) << line;
        processes.insert(line.substr(at, space - at));
        events.push_back(line.erase(at, space - at));
    }
    ASSERT_EQ(events.size(), 4u);
    EXPECT_EQ(processes.size(), 1u);
    EXPECT_EQ(events[0], "hooked GLX fixture-glx");
    EXPECT_EQ(events[1], "casting 1");
    EXPECT_TRUE(events[2].starts_with("figures (n=32, ")) << events[2];
    EXPECT_EQ(events[3], "captured 1 " + (folder / "cast.exr"));
}

TEST(Report, box_and_frame_matrix_are_obeyed) {
    const FixtureRun cast =
        cast_fixture(cube, {{"GLCAST_BOX", "-8,-8,-40,8,8,0"}, {"GLCAST_FRAME_MATRIX", "eye"}});
    ASSERT_TRUE(cast.capture) << cast.outcome.err;
    EXPECT_EQ(cast.capture->info.box.size, 40);
    EXPECT_EQ(cast.capture->info.box.lo, glm::dvec3(-20, -20, -40));
    EXPECT_EQ(cast.capture->info.eye_to_capture, glm::dmat4(1.0));
}

} // namespace
} // namespace glcast::test
