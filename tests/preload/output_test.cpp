// Where a capture goes, and what is said when it cannot.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "capture/output_file.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

namespace fs = std::filesystem;
const std::string cube = FIXTURE_GLX " --shape cube --frames 2";

/// A program that begins in `folder`/start, where it is told to write `out`.
Outcome run_in(const TemporaryFolder& folder, const std::string& program, const Environment& more) {
    fs::create_directories(folder / "start");
    Environment environment = {{"GLCAST_N", "16"}};
    environment.insert(more.begin(), more.end());
    std::string command = "cd " + folder / "start" + " && exec env LD_PRELOAD=" GLCAST_SHIM;
    for (const auto& [name, value] : environment) command += " " + name + "='" + value + "'";
    return run_program({"bash", "-c", command + " " + program}, {}, false);
}

TEST(Output, is_where_the_program_began) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "start/elsewhere");
    const Outcome outcome = run_in(folder, std::string(HOSTS) + " moves", {{"GLCAST_OUT", "rel.exr"}});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder / "start/rel.exr")) << outcome.err;
    EXPECT_FALSE(fs::exists("/rel.exr"));
}

TEST(Output, of_a_folder_that_is_not_there_is_refused) {
    const TemporaryFolder folder;
    const Outcome by_hand = run_in(folder, cube, {{"GLCAST_OUT", "nofolder/../b.exr"}});
    EXPECT_NE(by_hand.err.find("no folder"), std::string::npos) << by_hand.err;
    const Outcome run = run_program(
        {"bash", "-c", "cd " + folder / "start" + " && exec " GLCAST_RUN " -o nofolder/../b.exr -- true"}, {},
        false);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("No such file or directory"), std::string::npos) << run.err;
    EXPECT_TRUE(fs::is_empty(folder / "start"));
}

TEST(Output, behind_a_link_is_where_the_kernel_goes) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "start");
    fs::create_directories(folder / "far/away");
    fs::create_directory_symlink(folder / "far/away", folder / "start/link");
    const Outcome run = run_program(
        {"bash", "-c",
         "cd " + folder / "start" + " && exec " GLCAST_RUN " -o ./link/../b.exr -n 16 --quit -- " + cube},
        {}, false);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(fs::exists(folder / "far/b.exr"));
    EXPECT_FALSE(fs::exists(folder / "start/b.exr"));
}

struct Odd {
    const char* name;
    Environment environment;
    const char* says;
};
void PrintTo(const Odd& odd, std::ostream* out) { *out << odd.name; }
const Odd odds[] = {
    {"device", {{"GLCAST_OUT", "/dev/full"}}, "it is a device, a pipe or a socket"},
    {"pipe", {{"GLCAST_OUT", "pipe"}}, "it is a device, a pipe or a socket"},
    {"box_beside_everything",
     {{"GLCAST_OUT", "a.exr"}, {"GLCAST_BOX", "100,100,100,101,101,101"}},
     "nothing solid was drawn inside the box that was asked for, from (100, 100, 100) to (101, 101, 101)"},
    {"box_of_all_numbers",
     {{"GLCAST_OUT", "a.exr"}, {"GLCAST_BOX", "-1e308,-1e308,-1e308,1e308,1e308,1e308"}},
     "none beyond 1e30"},
    {"box_far_away",
     {{"GLCAST_OUT", "a.exr"}, {"GLCAST_BOX", "1e17,0,0,100000000000000016,1,1"}},
     "a millionth of that apart"},
};
class OddOutput : public testing::TestWithParam<Odd> {};
TEST_P(OddOutput, is_refused_in_words_that_help) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "start");
    ASSERT_EQ(mkfifo((folder / "start/pipe").c_str(), 0600), 0);
    const Outcome outcome = run_in(folder, cube, GetParam().environment);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find(GetParam().says), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder / "start/a.exr"));
}
INSTANTIATE_TEST_SUITE_P(Output, OddOutput, testing::ValuesIn(odds),
                         [](const auto& info) { return info.param.name; });

TEST(Output, glcast_run_refuses_devices_and_boxes_alike) {
    const auto says = [](const std::vector<std::string>& options, const char* what) {
        std::vector<std::string> command = {GLCAST_RUN};
        command.insert(command.end(), options.begin(), options.end());
        command.insert(command.end(), {"--", "true"});
        const Outcome outcome = run_program(command, {}, false);
        EXPECT_NE(outcome.exit_code, 0);
        EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    };
    says({"-o", "/dev/full"}, "name it .exr"); // no device has such an ending, unless a link gives it one
    const TemporaryFolder folder;
    fs::create_symlink("/dev/full", folder / "full.exr");
    says({"-o", folder / "full.exr"}, "it is no regular file");
    says({"--box=-1e308,-1e308,-1e308,1e308,1e308,1e308"}, "beyond 1e30");
    says({"--max-seconds", "0"}, "--max-seconds");
    says({"--fov", "nan"}, "needs degrees from");
}

TEST(Output, glcast_run_says_when_its_own_words_are_lost) {
    for (const char* option : {"--help", "--version"}) {
        const std::string command = std::string(GLCAST_RUN) + " " + option + " >/dev/full";
        const Outcome outcome = run_program({"/bin/sh", "-c", command}, {}, false);
        EXPECT_EQ(outcome.exit_code, 1) << option;
        EXPECT_NE(outcome.err.find("cannot write to standard output"), std::string::npos) << outcome.err;
    }
}

/// Nobody else may see a name that comes and goes, nor find it after a kill.
TEST(Output, gets_its_name_in_one_step_where_there_was_none) {
    const TemporaryFolder folder;
    const int nameless = open((folder / ".").c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    if (nameless < 0) GTEST_SKIP() << "no O_TMPFILE here";
    close(nameless);
    const int watch = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    ASSERT_GE(inotify_add_watch(watch, (folder / ".").c_str(), IN_CREATE | IN_MOVED_TO), 0);
    {
        OutputFile file(folder / "a.exr");
        ASSERT_TRUE(file.append("whole", 5) && file.commit()) << file.error();
    }
    alignas(inotify_event) char events[4096];
    const ssize_t got = read(watch, events, sizeof events);
    close(watch);
    ASSERT_GT(got, 0);
    const auto* first = reinterpret_cast<const inotify_event*>(events);
    EXPECT_STREQ(first->name, "a.exr");
    EXPECT_EQ(std::size_t(got), sizeof(inotify_event) + first->len);
}

} // namespace
} // namespace glcast::test
