// The axes of a cast: the model's own, and what is seen is never mirrored, however the program sets up its
// view.
#include <gtest/gtest.h>

#include "tests/preload/chiral_truth.h"
#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct Way {
    const char* name;
    glm::dvec3 scale; ///< capture coordinates of a model point: this times it
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

// Where model and screen differ in handedness, z is turned round. The stretched one keeps its volume.
const Way ways[] = {
    {"look_at", {1, 1, 1}},
    {"look_at_pushed", {1, 1, 1}},
    {"own_product", {1, 1, 1}},
    {"view_in_projection", {1, 1, 1}},
    {"stretched", {1, 2, 0.5}},
    {"mirrored_modelview", {1, 1, -1}},
    {"mirrored_projection", {1, 1, -1}},
    {"left_handed", {1, 1, -1}},
};

class ViewAxes : public testing::TestWithParam<Way> {};

TEST_P(ViewAxes, are_the_models_own_and_not_mirrored) {
    const TemporaryFolder folder;
    const std::string file = folder / "cast.exr";
    const Outcome outcome =
        run_program({VIEWS, GetParam().name}, {{"GLCAST_OUT", file}, {"GLCAST_N", "48"}}, true);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Capture capture = read_capture(file);
    expect_chiral_boxes(capture, GetParam().scale);
}
INSTANTIATE_TEST_SUITE_P(Ways, ViewAxes, testing::ValuesIn(ways),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
