// Programs of other languages, whose bindings find GL in ways of their own: cast as what they draw.
#include <gtest/gtest.h>

#include "tests/preload/chiral_truth.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct Binding {
    const char* name;
    std::vector<std::string> command;
};
void PrintTo(const Binding& binding, std::ostream* out) { *out << binding.name; }
const Binding all_bindings[] = {{"python", {PYTHON, BINDING_PROGRAMS "/boxes.py"}},
                                {"perl", {PERL, BINDING_PROGRAMS "/boxes.pl"}}};

class Language : public testing::TestWithParam<Binding> {};
TEST_P(Language, is_cast_as_it_draws) {
    if (std::string(BINDINGS).find(GetParam().name) == std::string::npos)
        GTEST_SKIP() << "its binding is not here";
    const TemporaryFolder folder;
    Command command;
    command.arguments = {GLCAST_RUN, "--headless", "--quit", "--timeout",         "50",
                         "-n",       "48",         "-o",     folder / "cast.exr", "--"};
    command.arguments.insert(command.arguments.end(), GetParam().command.begin(), GetParam().command.end());
    const Outcome outcome = run(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_chiral_boxes(read_capture(folder / "cast.exr"), {1, 1, 1});
}
INSTANTIATE_TEST_SUITE_P(Bindings, Language, testing::ValuesIn(all_bindings),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
