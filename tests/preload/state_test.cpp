// Everything that a context can be asked, before and after its frames are cast.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

using Lines = std::vector<std::string>;

Lines read_lines(const std::string& path) {
    std::ifstream file(path);
    Lines lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// Lines that only one of them has; the first few.
std::string difference(const Lines& a, const Lines& b) {
    std::string text;
    int shown = 0;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()) && shown < 12; ++i) {
        const std::string left = i < a.size() ? a[i] : "(none)", right = i < b.size() ? b[i] : "(none)";
        if (left == right) continue;
        text += left + "\n    " + right + "\n";
        ++shown;
    }
    return text;
}

struct StateRun {
    Outcome outcome;
    Lines before, after, second, stacks, names;
};
StateRun run_state_program(const std::string& system, bool preload, const std::string& layers = "auto",
                           const std::vector<std::string>& options = {}) {
    const TemporaryFolder folder;
    const Environment casts = {{"GLCAST_OUT", folder / "cast%f.exr"},
                               {"GLCAST_N", "16"},
                               {"GLCAST_EVERY", "1"},
                               {"GLCAST_LAYERS", layers}};
    std::vector<std::string> arguments = {STATE_PROGRAM, system, folder.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    StateRun result;
    result.outcome = run_program(arguments, preload ? casts : Environment(), preload);
    result.before = read_lines(folder / "before");
    result.after = read_lines(folder / "after");
    result.second = read_lines(folder / "second");
    result.stacks = read_lines(folder / "stacks");
    result.names = read_lines(folder / "names");
    return result;
}

/// The lines of the window system and of pending errors, which come first.
constexpr std::size_t head = 4;
Lines state_of(const Lines& lines) { return {lines.begin() + std::min(head, lines.size()), lines.end()}; }

class State : public testing::TestWithParam<const char*> {};

TEST_P(State, is_the_same_before_and_after_a_capture) {
    const StateRun plain = run_state_program(GetParam(), false);
    const StateRun cast = run_state_program(GetParam(), true);
    ASSERT_EQ(plain.outcome.exit_code, 0) << plain.outcome.err;
    ASSERT_EQ(cast.outcome.exit_code, 0) << cast.outcome.err;
    const auto lines = glcast_lines(cast.outcome);
    EXPECT_EQ(
        std::count_if(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("captured"); }), 2)
        << cast.outcome.err;
    EXPECT_GT(plain.before.size(), 10'000u) << "hardly anything was asked";
    EXPECT_EQ(difference(state_of(cast.before), state_of(cast.after)), "") << "before and after the capture";
    EXPECT_EQ(difference(plain.before, cast.before), "") << "before, without and with us";
    EXPECT_EQ(difference(plain.after, cast.after), "") << "after, without and with us";
    EXPECT_EQ(difference(plain.second, cast.second), "") << "after the second frame, without and with us";
    EXPECT_EQ(difference(plain.stacks, cast.stacks), "") << "the stacks, without and with us";
}

// Mesa never gives a deleted name again. Peeling needs a texture, a shader and a program that live with the program's own
// objects, and a texture named 0 that has an image needs one beside it (docs/guide/limits.md). Without these no name is used up.
TEST_P(State, hands_out_the_same_names_after_a_capture) {
    const StateRun plain = run_state_program(GetParam(), false, "auto", {"empty_0"}),
                   outer = run_state_program(GetParam(), true, "1", {"empty_0"});
    ASSERT_EQ(outer.outcome.exit_code, 0) << outer.outcome.err;
    EXPECT_FALSE(plain.names.empty());
    EXPECT_EQ(difference(plain.names, outer.names), "") << "the names that come next, without and with us";
}
INSTANTIATE_TEST_SUITE_P(Systems, State, testing::Values("glx", "egl"),
                         [](const auto& info) { return info.param; });

} // namespace
} // namespace glcast::test
