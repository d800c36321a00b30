// What the program's thread has is as before when a frame of it was cast: its stack, its arithmetic, its signals.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

const bool sanitized = *GLCAST_SANITIZER_RUNTIME != 0;

/// Bytes of the thread's stack that were touched; 0 when the program did not end well.
long stack_used(const Environment& environment, bool preload, const char* kib) {
    const Outcome outcome = run_program({HOSTS, "stack", kib}, environment, preload);
    EXPECT_EQ(outcome.exit_code, 0) << "signal " << outcome.signal << "\n" << outcome.err;
    const auto at = outcome.err.find("used ");
    return at == std::string::npos ? 0 : std::atol(outcome.err.c_str() + at + 5);
}

constexpr long few_hundred = 768;

TEST(Stack, an_idle_library_takes_a_few_hundred_bytes) {
    if (sanitized) GTEST_SKIP() << "the sanitizer's own frames are larger";
    const TemporaryFolder folder;
    const long plain = stack_used({}, false, "64");
    EXPECT_LT(stack_used({}, true, "64"), plain + few_hundred);
    EXPECT_LT(stack_used({{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_FRAME", "1000"}}, true, "64"),
              plain + few_hundred);
}

TEST(Stack, a_cast_has_its_own) {
    if (sanitized) GTEST_SKIP() << "the sanitizer's own frames are larger";
    const TemporaryFolder folder;
    const long plain = stack_used({}, false, "64");
    const Environment environment = {{"GLCAST_OUT", folder / "cast-%f.exr"}, {"GLCAST_N", "16"}, {"GLCAST_EVERY", "2"}};
    EXPECT_LT(stack_used(environment, true, "64"), plain + few_hundred);
    EXPECT_TRUE(std::filesystem::exists(folder / "cast-5.exr"));
}

TEST(Stack, of_32_kib_is_enough) {
    if (sanitized) GTEST_SKIP() << "the sanitizer's own frames are larger";
    const TemporaryFolder folder;
    EXPECT_GT(stack_used({{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "16"}}, true, "32"), 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "cast.exr"));
}

class Thread : public testing::TestWithParam<const char*> {};
TEST_P(Thread, is_as_before) {
    const TemporaryFolder folder;
    const Outcome plain = run_program({HOSTS, GetParam()}, {}, false);
    ASSERT_EQ(plain.exit_code, 0) << plain.out << plain.err;
    const Outcome outcome = run_program(
        {HOSTS, GetParam()}, {{"GLCAST_OUT", folder / "cast-%f.exr"}, {"GLCAST_N", "16"}, {"GLCAST_EVERY", "2"}}, true);
    EXPECT_EQ(outcome.signal, 0) << outcome.err;
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, plain.out);
    EXPECT_TRUE(std::filesystem::exists(folder / "cast-1.exr")) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "cast-5.exr")) << outcome.err;
}
INSTANTIATE_TEST_SUITE_P(Host, Thread,
                         testing::Values("always_trap", "trap", "up", "to_zero", "flushing", "single", "flags",
                                         "interrupted"),
                         [](const auto& info) { return info.param; });

/// Inside a cast arithmetic is what it always is: the bytes do not depend on the program's.
TEST(Arithmetic, of_the_program_does_not_show_in_the_capture) {
    const TemporaryFolder folder;
    const auto cast = [&](const char* what) {
        const std::string file = folder / std::string(what) + ".exr";
        run_program({HOSTS, what}, {{"GLCAST_OUT", file}, {"GLCAST_N", "32"}}, true);
        return read_capture(file);
    };
    const Capture plain = cast("flags");
    for (const char* what : {"up", "to_zero", "flushing", "single"}) {
        const Capture other = cast(what);
        EXPECT_EQ(other.info.box.lo, plain.info.box.lo) << what;
        EXPECT_EQ(other.info.box.size, plain.info.box.size) << what;
        const CaptureDifference difference = compare(plain, other);
        EXPECT_GT(difference.covered, 500) << what;
        EXPECT_EQ(difference.coverage, 0) << what;
        EXPECT_EQ(difference.depth, 0) << what;
        EXPECT_EQ(difference.colour, 0) << what;
        EXPECT_EQ(difference.normal, 0) << what;
    }
}

} // namespace
} // namespace glcast::test
