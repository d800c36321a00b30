// libglcast.so as a file: what it needs, what it exports, and the tail calls that interposition depends on.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "capture/gl/gl_table.h"
#include "tests/support/xvfb.h"

namespace glcast::test {
namespace {

std::string output_of(const std::vector<std::string>& arguments) {
    const Outcome outcome = run({arguments, {}, 60});
    EXPECT_EQ(outcome.exit_code, 0) << arguments[0] << ": " << outcome.err;
    return outcome.out;
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
        found.insert((*i)[1]);
    return found;
}

/// Instructions of one exported function.
std::string disassembly(const std::string& function, const std::string& library) {
    return output_of({"objdump", "-d", "--no-show-raw-insn", "--disassemble=" + function, library});
}

/// The library of each width that is built.
class Library : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Width, Library,
                         testing::Values(GLCAST_SHIM
#ifdef GLCAST_SHIM_I386
                                         ,
                                         GLCAST_SHIM_I386
#endif
                                         ));

TEST_P(Library, needs_only_the_c_library) {
    if (GLCAST_SANITIZED) GTEST_SKIP() << "a sanitizer brings libraries of its own";
    const auto needed = matches(output_of({"readelf", "-dW", GetParam()}), R"(\(NEEDED\).*\[(.*)\])");
    const std::set<std::string> allowed = {"libc.so.6",
                                           "libm.so.6",
                                           "libdl.so.2",
                                           "libpthread.so.0",
                                           "ld-linux.so.2",
                                           "ld-linux-x86-64.so.2",
                                           "ld-linux-aarch64.so.1"};
    EXPECT_FALSE(needed.empty());
    for (const std::string& library : needed) EXPECT_TRUE(allowed.contains(library)) << library;
    EXPECT_TRUE(matches(output_of({"readelf", "-dW", GetParam()}), R"(\((RPATH|RUNPATH)\))").empty());
}

TEST_P(Library, loads_with_glibc_2_17) {
    if (GLCAST_SANITIZED) GTEST_SKIP() << "a sanitizer brings symbols of its own";
    const std::string symbols = output_of({"objdump", "-T", GetParam()});
    const auto versions = matches(symbols, R"(\bGLIBC_([0-9.]+))");
    EXPECT_FALSE(versions.empty());
    for (const std::string& version : versions) {
        int major = 0;
        int minor = 0;
        ASSERT_GE(sscanf(version.c_str(), "%d.%d", &major, &minor), 2) << version;
        EXPECT_TRUE(major < 2 || (major == 2 && minor <= 17)) << version;
    }
    EXPECT_TRUE(matches(symbols, R"(\*UND\*.*((GLIBCXX|CXXABI|GCC)_[0-9.]+))").empty());
}

TEST_P(Library, exports_gl_and_its_loaders_only) {
    const std::string symbols = output_of({"nm", "-D", "--defined-only", GetParam()});
    const auto exported = matches(symbols, R"([0-9a-f]+ \w (\S+))");
    std::set<std::string> expected = {"dlsym", "dlopen"};
    expected.insert(gl_call_names, gl_call_names + gl_call_count);
    for (const std::string& name : exported)
        EXPECT_TRUE(expected.contains(name) || name.starts_with("glX") || name.starts_with("egl") ||
                    name.starts_with("OSMesa"))
            << name;
    for (const std::string& name : expected) EXPECT_TRUE(exported.contains(name)) << name;
    for (const char* name : {"glXSwapBuffers", "glXGetProcAddressARB", "eglSwapBuffers", "eglGetProcAddress"})
        EXPECT_TRUE(exported.contains(name)) << name;
}

TEST_P(Library, dlsym_and_dlopen_end_in_a_jump_to_the_real_ones) {
    for (const char* function : {"dlsym", "dlopen"}) {
        const std::string code = disassembly(function, GetParam());
        // The last call of a function that only returns would be `call *` and `ret`.
        EXPECT_TRUE(std::regex_search(code, std::regex(R"(\bjmp +\*|\bbr\s+x)"))) << code;
        EXPECT_FALSE(std::regex_search(code, std::regex(R"(\bcall +\*|\bblr\s+x)"))) << code;
    }
}

TEST(Stub, is_a_load_a_branch_and_a_jump_when_idle) {
    if (GLCAST_SANITIZED) GTEST_SKIP() << "sanitizers add checks";
    std::istringstream code(disassembly("glVertex3f", GLCAST_SHIM));
    std::vector<std::string> instructions;
    bool inside = false;
    for (std::string line; std::getline(code, line);) {
        if (line.find("<glVertex3f>:") != std::string::npos)
            inside = true;
        else if (inside && line.find('\t') != std::string::npos)
            instructions.push_back(line);
    }
    ASSERT_GE(instructions.size(), 4u);
    const bool jumps = instructions[3].find("jmp") != std::string::npos; // mov, test, jne, jmp
    EXPECT_TRUE(jumps) << instructions[0] << "\n"
                       << instructions[1] << "\n"
                       << instructions[2] << "\n"
                       << instructions[3];
}

} // namespace
} // namespace glcast::test
