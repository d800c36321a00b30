// What the library says stays out of everything that is not the stderr which the program began with.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct Case {
    const char* name;
    const char* unsaid;     ///< why its lines are lost, as told in GLCAST_STATUS; null: they are not lost
    bool passes_on = false; ///< prints what came to its stderr
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

constexpr const char* full = "it is full, or stopped";
constexpr const char* no_reader = "nobody reads it any more";
constexpr const char* none = "started without one that is a terminal, a pipe or a file";
constexpr const char* replaced = "the program has closed or replaced it";
constexpr const char* pending = "a SIGPIPE or SIGXFSZ of the program's own waits";
constexpr Case cases[] = {
    {"closed", none},
    {"full_pipe", full},
    {"small_full_pipe", full},
    {"non_blocking_full_pipe", full},
    {"pipe", nullptr, true},
    {"pipe_of_another_user", nullptr, true},
    {"full_pipe_of_another_user", full},
    {"pipe_before_6_4", nullptr, true},
    {"full_pipe_before_6_4", full},
    {"terminal", nullptr, true},
    {"file", nullptr, true},
    {"pipe_without_reader", no_reader},
    {"pipe_without_reader_handler", no_reader},
    {"pipe_without_reader_ignored", no_reader},
    {"pipe_without_reader_blocked", no_reader},
    {"pipe_without_reader_pending", no_reader},
    {"pipe_pending", pending},
    {"pipe_without_reader_of_another_user", no_reader},
    {"socket", none},
    {"socket_without_peer", none},
    {"full_terminal", full},
    {"stopped_terminal", full},
    {"terminal_of_another_user", nullptr, true},
    {"background_terminal", nullptr, true},
    {"full_device", nullptr},
    {"only_readable", none},
    {"file_at_its_limit", "it may not grow"},
    {"file_at_its_limit_handler", "it may not grow"},
    {"locked_file", nullptr},
    {"data_file", replaced},
    {"data_file_behind_stdio", replaced},
    {"data_file_for_file", replaced},
    {"data_pipe", replaced},
    {"data_pipe_for_pipe", replaced},
    {"data_socket", replaced},
    {"data_terminal", replaced},
};

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Stderr : public testing::TestWithParam<Case> {};

TEST_P(Stderr, is_left_alone) {
    const Case& one = GetParam();
    const TemporaryFolder folder;
    std::filesystem::permissions(folder.string(), std::filesystem::perms::all); // some become another user
    std::ofstream(folder / "status").close();
    std::filesystem::permissions(folder / "status", std::filesystem::perms::all);
    const Environment environment = {
        {"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "16"}, {"GLCAST_STATUS", folder / "status"},
        {"GLCAST_VERBOSE", "1"}}; // with a status file it speaks only then
    const Outcome plain = run_program({STDERRS, one.name}, {}, false);
    ASSERT_EQ(plain.exit_code, 0) << plain.out << plain.err;
    const Outcome outcome = run_program({STDERRS, one.name}, environment, true);
    EXPECT_FALSE(outcome.timed_out);
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
    EXPECT_TRUE(std::filesystem::exists(folder / "cast.exr"));
    const std::string status = read_text(folder / "status");
    if (one.passes_on) {
        EXPECT_NE(outcome.out.find("glcast: hooked GLX in stderrs"), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find("glcast: captured frame 1 of"), std::string::npos) << outcome.out;
    } else {
        EXPECT_EQ(outcome.out, plain.out);
    }
    if (one.unsaid)
        EXPECT_NE(status.find(one.unsaid), std::string::npos) << status;
    else
        EXPECT_EQ(status.find("unsaid"), std::string::npos) << status;
}
INSTANTIATE_TEST_SUITE_P(Messages, Stderr, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

const std::vector<std::string> cube = {FIXTURE_GLX, "--shape", "cube", "--frames", "2"};

struct StatusFile {
    const char* name;
    std::string (*make)(const TemporaryFolder& folder);
};
void PrintTo(const StatusFile& file, std::ostream* out) { *out << file.name; }

std::string make_pipe(const TemporaryFolder& folder) {
    const std::string path = folder / "pipe";
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    return path;
}
/// Full, with a reader that does not read: left open until the test program ends.
std::string make_full_pipe(const TemporaryFolder& folder) {
    const std::string path = make_pipe(folder);
    const int both = open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    const std::string page(4096, 'x');
    while (write(both, page.data(), page.size()) > 0 || write(both, "x", 1) > 0) {
    }
    return path;
}
const StatusFile status_files[] = {
    {"pipe_without_reader", make_pipe},
    {"full_pipe", make_full_pipe},
    {"missing", [](const TemporaryFolder& folder) { return folder / "missing"; }},
    {"folder", [](const TemporaryFolder& folder) { return folder.string(); }},
    {"device", [](const TemporaryFolder&) { return std::string("/dev/full"); }},
};

class OddStatusFile : public testing::TestWithParam<StatusFile> {};
TEST_P(OddStatusFile, does_no_harm) {
    const TemporaryFolder folder;
    const FixtureRun run = cast_fixture(cube, {{"GLCAST_STATUS", GetParam().make(folder)}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(run.capture) << run.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Messages, OddStatusFile, testing::ValuesIn(status_files),
                         [](const auto& info) { return info.param.name; });

TEST(Messages, control_characters_do_not_reach_the_terminal) {
    const TemporaryFolder folder;
    const std::string odd = folder / "a\x1b[31m\nfailed all.exr";
    const Outcome outcome = run_program(cube, {{"GLCAST_OUT", odd}, {"GLCAST_N", "16"}}, true);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(odd));
    EXPECT_NE(outcome.err.find("a\\x1b[31m\\x0afailed all.exr"), std::string::npos) << outcome.err;
}

TEST(Messages, glcast_run_without_standard_descriptors) {
    const TemporaryFolder folder;
    const std::string command = GLCAST_RUN " -o " + folder / "cast.exr" +
                                " -n 16 --quit -- " FIXTURE_GLX " --shape cube <&- >&- 2>&-";
    const Outcome outcome = run_program({"bash", "-c", command}, {}, false);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "cast.exr"));
}

TEST(Messages, glcast_run_says_what_could_not_be_said) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program(
        {GLCAST_RUN, "-o", folder / "cast.exr", "-n", "16", "--verbose", "--", STDERRS, "full_pipe"}, {}, false);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(
        outcome.err.find("glcast-run: 2 lines of the library did not go to the program's stderr: it is full"),
        std::string::npos)
        << outcome.err;
}

struct Started {
    const char* name;
    std::string command; ///< of bash (which, unlike dash, ends by exit), with the preload
    int complaints;      ///< lines that say "no GL seen"
};
void PrintTo(const Started& one, std::ostream* out) { *out << one.name; }
const Started started[] = {
    {"program_itself", "exec sed -n p /dev/null", 1},
    {"child", "sed -n p /dev/null; exec " FIXTURE_GLX " --shape cube --frames 2", 0},
    {"child_of_a_child", "sh -c 'sed -n p /dev/null; true'; exec " FIXTURE_GLX " --shape cube --frames 2", 0},
    {"orphan", "(sh -c 'sleep 0.2; sed -n p /dev/null' &) ; exec " FIXTURE_GLX " --shape cube --frames 20",
     0},
    {"script_whose_child_is_cast", FIXTURE_GLX " --shape cube --frames 2; true", 0},
    {"script_whose_child_is_not", "sed -n p /dev/null; true", 1},
};

class Children : public testing::TestWithParam<Started> {};
TEST_P(Children, do_not_complain_that_they_draw_nothing) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"bash", "-c", GetParam().command},
                                        {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "16"}}, true);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    int complaints = 0;
    for (const std::string& line : glcast_lines(outcome))
        complaints += line.find("no GL seen") != std::string::npos;
    EXPECT_EQ(complaints, GetParam().complaints) << outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Messages, Children, testing::ValuesIn(started),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
