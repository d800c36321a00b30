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
/// JOGL asks for a core profile first, and then finds no GL2 in Mesa, with or without us.
std::vector<std::string> java(const char* way) {
    return {JAVA,
            "--add-opens",
            "java.desktop/sun.awt=ALL-UNNAMED",
            "-Djogl.disable.openglcore",
            "-Djava.library.path=/usr/lib/jni",
            "-cp",
            JAVA_CLASSES,
            "Boxes",
            way};
}
const Binding all_bindings[] = {{"python", {PYTHON, BINDING_PROGRAMS "/boxes.py"}},
                                {"perl", {PERL, BINDING_PROGRAMS "/boxes.pl"}},
                                {"java_canvas", java("canvas")},
                                {"java_panel", java("panel")}};

class Language : public testing::TestWithParam<Binding> {};
TEST_P(Language, is_cast_as_it_draws) {
    const std::string name = GetParam().name;
    if (std::string(BINDINGS).find(name.substr(0, name.find('_'))) == std::string::npos)
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
