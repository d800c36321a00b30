// Programs whose contexts share objects (programs/shared.c), with every frame cast: what is deleted, changed
// or destroyed while something holds it is the same as without us.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

class SharedObjects : public testing::TestWithParam<const char*> {};

TEST_P(SharedObjects, are_as_they_would_be_without_us) {
    const TemporaryFolder folder;
    const std::pair<const std::string, std::string> freed_is_filled{"MALLOC_PERTURB_", "90"};
    const Outcome plain = run_program({SHARED, GetParam()}, {freed_is_filled}, false);
    const Outcome cast = run_program({SHARED, GetParam()},
                                     {freed_is_filled,
                                      {"GLCAST_OUT", folder / "%f.exr"},
                                      {"GLCAST_N", "16"},
                                      {"GLCAST_EVERY", "1"},
                                      {"GLCAST_CAPTURES", "0"}},
                                     true);
    ASSERT_EQ(plain.exit_code, 0) << plain.err;
    EXPECT_EQ(cast.exit_code, 0) << cast.signal << " " << cast.err;
    EXPECT_EQ(cast.out, plain.out);
    EXPECT_FALSE(std::filesystem::is_empty(folder / ".")) << cast.err;
}
INSTANTIATE_TEST_SUITE_P(Kinds, SharedObjects, testing::Values("pushed", "destroyed", "nameless"),
                         [](const auto& info) { return info.param; });

} // namespace
} // namespace glcast::test
