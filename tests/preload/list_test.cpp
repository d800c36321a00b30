// Display lists to the letter, through the preload: what a cast of each program of programs/lists.c shows, in
// closed form. tests/record has the same cases against Mesa's own execution, without a program.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

constexpr int n = 32, cells = 4;

/// The grid, seen from the front, its upper row first: r, g, b, w or . for a cell.
struct Way {
    const char* name;
    const char* grid;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

const Way ways[] = {
    {"compile", ".... .... .r.. ...."},
    {"compile_in_frame", ".... .... .r.. ...."},
    {"compile_and_execute", ".... .... ..r. rr.."},
    {"execute_calls_inner", ".... .... .... ggg."},
    {"nested", ".... .... bbb. bbb."},
    {"late_bound", "...r .... .... ...."},
    {"redefined_between", ".... .... ..g. ...."},
    {"redefined_in_frame", ".... .... ..g. r..."},
    {"deleted_between", ".... .... .... .gg."},
    {"deleted_in_frame", ".... .... .r.. ...."},
    {"replaced_while_executed", ".... .... .r.. ...g"},
    {"calls_itself", ".... .... .... rrrr"},
    {"nested_64", ".... ..b. .... ...."},
    {"state_left", ".... ..g. .g.. ...."},
    {"attributes", ".... .... .... gr.."},
    {"list_base_in_list", ".... .... .... rbg."},
    {"list_base_is_bound_late", ".... .... .... rg.."},
    {"calls_byte", ".... .... .... rgbw"},
    {"calls_ubyte", ".... .... .... rgbw"},
    {"calls_short", ".... .... .... rgbw"},
    {"calls_ushort", ".... .... .... rgbw"},
    {"calls_int", ".... .... .... rgbw"},
    {"calls_uint", ".... .... .... rgbw"},
    {"calls_float", ".... .... .... rgbw"},
    {"calls_2_bytes", ".... .... .... rgbw"},
    {"calls_3_bytes", ".... .... .... rgbw"},
    {"calls_4_bytes", ".... .... .... rgbw"},
    {"arrays", ".... .... .... g..."},
    {"elements", ".... .... .... rg.."},
    {"buffer_that_goes", ".... .... .... b..."},
    {"vertices_inside", ".... .... .... r..."},
    {"begin_inside", ".... ..g. .... g..."},
    {"material", ".... .... .... b..."},
    {"made_elsewhere", ".... .g.. .... ...."},
    {"redefined_elsewhere", ".... .g.. .... ...."},
    {"deleted_elsewhere", "...b .... .... ...."},
    {"maker_is_gone", ".... .g.. .... ...."},
};

char letter(const glm::vec4& colour) {
    const auto on = [](float value) { return value > 0.99f; };
    const auto off = [](float value) { return value < 0.01f; };
    if (on(colour.r) && on(colour.g) && on(colour.b)) return 'w';
    if (on(colour.r) && off(colour.g) && off(colour.b)) return 'r';
    if (off(colour.r) && on(colour.g) && off(colour.b)) return 'g';
    if (off(colour.r) && off(colour.g) && on(colour.b)) return 'b';
    return '?';
}

/// Boxes are 0.8 of a cell wide, so all but the outer tenth of a cell is of one kind, and that tenth is
/// empty.
std::string grid_of(const ViewImage& image) {
    constexpr int per_cell = n / cells;
    std::string grid;
    for (int row = cells - 1; row >= 0; --row) {
        for (int column = 0; column < cells; ++column) {
            const auto at = [&](int x, int y) {
                const std::size_t p =
                    std::size_t(row * per_cell + y) * n + std::size_t(column * per_cell + x);
                return image.covered(p) ? letter(image.colour[p]) : '.';
            };
            char all = at(per_cell / 2, per_cell / 2);
            for (int y = 0; y < per_cell; ++y)
                for (int x = 0; x < per_cell; ++x) {
                    const bool outer = x == 0 || y == 0 || x == per_cell - 1 || y == per_cell - 1;
                    if (at(x, y) != (outer ? '.' : all)) all = '?';
                }
            grid += all;
        }
        if (row > 0) grid += ' ';
    }
    return grid;
}

class Lists : public testing::TestWithParam<Way> {};

TEST_P(Lists, show_what_gl_says) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({LISTS, GetParam().name},
                                        {{"GLCAST_OUT", folder / "cast.exr"},
                                         {"GLCAST_N", std::to_string(n)},
                                         {"GLCAST_LAYERS", "1"},
                                         {"GLCAST_FRAME_MATRIX", "eye"},
                                         {"GLCAST_BOX", "-2,-2,-12,2,2,-8"}},
                                        true);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_TRUE(std::filesystem::exists(folder / "cast.exr")) << outcome.err;
    const Capture capture = read_capture(folder / "cast.exr");
    EXPECT_TRUE(capture.info.not_understood.empty()) << outcome.err;
    for (const ViewImage& image : capture.images)
        if (image.view == View{Axis::z, Side::plus, 0}) {
            EXPECT_EQ(grid_of(image), GetParam().grid);
        }
}
INSTANTIATE_TEST_SUITE_P(Ways, Lists, testing::ValuesIn(ways),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
