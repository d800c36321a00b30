// GLCAST_PRETEND: what a program is told of the driver, wherever it asks, and what it then draws
// (programs/asks*.c).
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr double body = 6; ///< of three boxes: 3 + 2 + 1 (programs/chiral.c)

/// As of a driver that has this version: GL_MAJOR_VERSION is answered, since programs ask it without looking
/// at errors.
std::string told(const std::string& version, const std::string& language, const std::string& shaders) {
    const std::string major = version.substr(0, 1), minor = version.substr(2);
    const std::string has_minor = minor == "0" ? "0" : "1";
    return "version " + version + " of Mesa\nerror 0\nlanguage " + language + "\nnumbers " + major + " " +
           minor + " " + major + " " + minor + " " + minor + " " + has_minor +
           " error 0\nwhole: extensions some, shading none, buffers 1\n"
           "one by one: extensions some, shading none, buffers 1\nbeyond the last none error 501\n"
           "glCreateShader " +
           shaders + "\nglCreateShaderObjectARB not there\nglUniform1f " + shaders +
           "\nglProgramStringARB not there\nglVertexAttribPointerARB not there\nglAttachObjectARB not there\n"
           "glBindBuffer there\nglBindBufferARB there\nglActiveTexture there\nglGetStringi there\n"
           "glGenFramebuffers there\n";
}
const std::string told_1_5 = told("1.5", "none error 500", "not there");

const std::string glx_1_5 = "extension 0, of the client 0, of the server 0; of configurations 1\n"
                            "attributes not there, renderer not there\n"
                            "newer refused, errors 1\nold made, errors 0\n";

struct Told {
    const char* name;
    std::vector<std::string> program;
    const char* version;
    std::string expected;
};
void PrintTo(const Told& one, std::ostream* out) { *out << one.name; }

const Told all_told[] = {
    {"glx", {ASKS_GLX}, "1.5", glx_1_5 + told_1_5},
    {"threads", {ASKS_GLX, "threads"}, "1.5", glx_1_5 + told_1_5 + told_1_5},
    {"no_core_context", {ASKS_GLX, "core"}, "1.5", glx_1_5 + told_1_5},
    {"older", {ASKS_GLX}, "1.4", glx_1_5 + told("1.4", "none error 500", "not there")},
    {"egl", {ASKS_EGL}, "1.5", "newer refused error 3009\nold made\n" + told_1_5},
    {"newer",
     {ASKS_EGL},
     "2.1",
     "newer refused error 3009\nold made\n" + told("2.1", "1.20 error 0", "there")},
    {"es",
     {ASKS_EGL, "es"},
     "1.5",
     "newer made error 3000\nold made\nversion OpenGL ES 3.2\nshaders not there\n"},
};

class Pretence : public testing::TestWithParam<Told> {};
TEST_P(Pretence, is_the_same_wherever_one_asks) {
    const Outcome outcome = run_program(GetParam().program, {{"GLCAST_PRETEND", GetParam().version}}, true);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, GetParam().expected);
}
INSTANTIATE_TEST_SUITE_P(Preload, Pretence, testing::ValuesIn(all_told),
                         [](const auto& info) { return info.param.name; });

struct Program {
    const char* name;
    std::vector<std::string> words;
};
void PrintTo(const Program& one, std::ostream* out) { *out << one.name; }
const Program programs[] = {
    {"glx", {ASKS_GLX}}, {"threads", {ASKS_GLX, "threads"}}, {"egl", {ASKS_EGL}}, {"es", {ASKS_EGL, "es"}}};

class NoPretence : public testing::TestWithParam<Program> {};
TEST_P(NoPretence, tells_the_program_what_the_driver_says) {
    const TemporaryFolder folder;
    const Outcome plain = run_program(GetParam().words, {}, false);
    ASSERT_EQ(plain.exit_code, 0) << plain.err;
    const Environment armed = {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "16"}};
    for (const Environment& environment : {Environment{}, armed, Environment{{"GLCAST_PRETEND", ""}}}) {
        const Outcome outcome = run_program(GetParam().words, environment, true);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, plain.out);
    }
    EXPECT_NE(plain.out.find(" there"), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(Preload, NoPretence, testing::ValuesIn(programs),
                         [](const auto& info) { return info.param.name; });

struct Drawn {
    Outcome outcome;
    std::optional<Capture> capture;
};
Drawn cast(const std::vector<std::string>& program, const char* pretend) {
    const TemporaryFolder folder;
    Drawn drawn;
    drawn.outcome = run_program(
        program, {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "48"}, {"GLCAST_PRETEND", pretend}},
        true);
    EXPECT_EQ(drawn.outcome.exit_code, 0) << drawn.outcome.err;
    if (std::filesystem::exists(folder / "cast.exr")) drawn.capture = read_capture(folder / "cast.exr");
    return drawn;
}

class Shaders : public testing::TestWithParam<Program> {};
TEST_P(Shaders, are_left_alone_by_who_is_told_that_there_are_none) {
    const Drawn without = cast(GetParam().words, "");
    EXPECT_FALSE(without.capture);
    EXPECT_NE(without.outcome.err.find("--pretend 1.5 lets it draw without them"), std::string::npos)
        << without.outcome.err;
    const Drawn told = cast(GetParam().words, "1.5");
    ASSERT_TRUE(told.capture) << told.outcome.err;
    EXPECT_NEAR(volume(*told.capture), body, 0.05 * body);
    const Drawn newer = cast(GetParam().words, "2.1"); // which has them
    EXPECT_FALSE(newer.capture);
    EXPECT_NE(newer.outcome.err.find("whatever it is told"), std::string::npos) << newer.outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Preload, Shaders,
                         testing::Values(Program{"glx", {ASKS_GLX}}, Program{"egl", {ASKS_EGL}}),
                         [](const auto& info) { return info.param.name; });

TEST(CoreContext, is_cast_where_it_is_refused_to_the_program) {
    const Drawn without = cast({ASKS_GLX, "core"}, "");
    EXPECT_FALSE(without.capture);
    EXPECT_NE(without.outcome.err.find("--pretend 1.5 keeps such contexts from it"), std::string::npos)
        << without.outcome.err;
    const Drawn told = cast({ASKS_GLX, "core"}, "1.5");
    ASSERT_TRUE(told.capture) << told.outcome.err;
    EXPECT_NE(told.outcome.err.find("it asked for a context of OpenGL 3.2"), std::string::npos)
        << told.outcome.err;
}

TEST(Run, offers_the_pretence_and_takes_it) {
    const TemporaryFolder folder;
    const auto glcast_run = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {GLCAST_RUN, "-n", "32", "-o", folder / "cast.exr"});
        options.insert(options.end(), {"--", ASKS_GLX});
        return run_program(options, {}, false);
    };
    const Outcome offered = glcast_run({});
    EXPECT_EQ(offered.exit_code, 1);
    EXPECT_NE(offered.err.find("--pretend 1.5"), std::string::npos) << offered.err;
    const Outcome taken = glcast_run({"--pretend", "1.5"});
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "cast.exr"));
    const Outcome wrong = glcast_run({"--pretend", "3.0"});
    EXPECT_EQ(wrong.exit_code, 2) << wrong.err;
}

TEST(PretenceOption, of_no_version_is_refused_in_a_line) {
    const Drawn wrong = cast({ASKS_GLX}, "4.6");
    EXPECT_FALSE(wrong.capture);
    EXPECT_NE(wrong.outcome.err.find("GLCAST_PRETEND=4.6: expected a version of OpenGL"), std::string::npos)
        << wrong.outcome.err;
}

} // namespace
} // namespace glcast::test
