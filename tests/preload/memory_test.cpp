// GLCAST_MEMORY is kept, and what a cast took is given back.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

const bool sanitized = *GLCAST_SANITIZER_RUNTIME != 0;

struct Memory {
    long most = 0, left = 0; ///< MiB of the process, at most and when it has cast
    bool has_captured = false;
};
Memory memory_of(const char* what, const char* count, const char* limit_mib) {
    const TemporaryFolder folder;
    Environment environment;
    if (limit_mib)
        environment = {{"GLCAST_OUT", folder / "cast.exr"},
                       {"GLCAST_N", "16"},
                       {"GLCAST_LAYERS", "1"},
                       {"GLCAST_MEMORY", limit_mib}};
    const Outcome outcome = run_program({HOSTS, what, count}, environment, limit_mib != nullptr);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    Memory memory;
    EXPECT_EQ(std::sscanf(outcome.out.c_str(), "memory %ld %ld", &memory.most, &memory.left), 2)
        << outcome.out;
    memory.most /= 1024, memory.left /= 1024;
    memory.has_captured = outcome.err.find("captured frame") != std::string::npos;
    return memory;
}

constexpr long room = 24; ///< MiB: a second context and the images

/// Textures that change: kept by us, and by the driver again.
TEST(Memory, of_copies_of_textures_is_bounded) {
    if (sanitized) GTEST_SKIP() << "the sanitizer keeps what is freed";
    const Memory plain = memory_of("fillings", "120", nullptr), small = memory_of("fillings", "120", "64"),
                 large = memory_of("fillings", "120", "364");
    EXPECT_TRUE(small.has_captured);
    EXPECT_TRUE(large.has_captured);
    EXPECT_LT(small.most, plain.most + 64 * 11 / 10 + room);
    EXPECT_LT(large.most, plain.most + 364 * 11 / 10 + room);
    EXPECT_GT(large.most, small.most + 200); // it does take what it may
    EXPECT_LT(small.left, plain.left + room);
    EXPECT_LT(large.left, plain.left + room);
}

/// The texture named 0: each filling is a call in the frame.
TEST(Memory, of_recorded_calls_is_given_back) {
    if (sanitized) GTEST_SKIP() << "the sanitizer keeps what is freed";
    const Memory plain = memory_of("unnamed_fillings", "120", nullptr),
                 cast = memory_of("unnamed_fillings", "120", "1000"),
                 refused = memory_of("unnamed_fillings", "120", "64");
    EXPECT_TRUE(cast.has_captured);
    EXPECT_GT(cast.most, plain.most + 100);
    EXPECT_LT(cast.left, plain.left + room);
    EXPECT_FALSE(refused.has_captured);
    EXPECT_LT(refused.most, plain.most + 64 * 11 / 10 + room);
    EXPECT_LT(refused.left, plain.left + room);
}

} // namespace
} // namespace glcast::test
