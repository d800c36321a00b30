// Replays from arrays, which leave out what a pass cannot find, against replays call by call
// (GLCAST_REPLAY=calls): the same capture, byte for byte.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/preload/program_run.h"

namespace glcast::test {
namespace {

struct Program {
    std::string name;
    std::vector<std::string> arguments;
    Environment environment;
};
void PrintTo(const Program& program, std::ostream* out) { *out << program.name; }

std::vector<Program> programs() {
    std::vector<Program> all;
    const auto fixture = [&](const std::string& shape, const std::string& way, Environment environment = {}) {
        std::string name = shape + "_" + way;
        for (const auto& [variable, value] : environment) name += "_" + value;
        all.push_back({name,
                       {FIXTURE_GLX, "--shape", shape, "--way", way, "--frames", "2", "--size", "160x120"},
                       environment});
    };
    for (const char* shape : {"torus", "spheres", "cube", "knob", "teapot"}) fixture(shape, "immediate");
    for (const char* way : {"nested_lists", "client_arrays", "buffers"}) fixture("torus", way);
    fixture("spheres", "immediate", {{"GLCAST_LAYERS", "slab"}});
    // Faces smaller than a pixel: most cover the centre of none.
    for (const char* way : {"immediate", "nested_lists", "buffers"})
        for (const char* shape : {"teapot", "knob"}) fixture(shape, way, {{"GLCAST_N", "12"}});
    fixture("spheres", "immediate", {{"GLCAST_NORMALS", "six"}});
    for (const char* kind : {"cad", "sky", "glass", "decals", "refilled"})
        all.push_back({std::string("scene_") + kind, {SCENES, kind}, {}});
    all.push_back({"scene_wires", {SCENES, "wires"}, {{"GLCAST_INCLUDE", "lines"}}});
    for (const char* way : {"look_at_pushed", "look_at"})
        all.push_back({std::string("view_") + way, {VIEWS, way}, {}});
    for (const char* way : {"tint", "opaque_by_constant", "transparency"})
        all.push_back({std::string("blend_") + way, {BLENDS, way}, {}});
    for (const char* way : {"state_left", "attributes", "elements"})
        all.push_back({std::string("list_") + way, {LISTS, way}, {}});
    return all;
}

class Replay : public testing::TestWithParam<Program> {};

TEST_P(Replay, from_arrays_captures_the_same_bytes_as_call_by_call) {
    const TemporaryFolder folder;
    const auto cast = [&](const char* how) {
        Environment environment = GetParam().environment;
        const std::string file = folder / (std::string(how) + ".exr");
        environment.insert({{"GLCAST_OUT", file}, {"GLCAST_N", "48"}, {"GLCAST_REPLAY", how}});
        const Outcome outcome = run_program(GetParam().arguments, environment, true);
        EXPECT_NE(outcome.err.find("captured frame"), std::string::npos) << outcome.err;
        std::ifstream in(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string by_calls = cast("calls"), from_arrays = cast("arrays");
    EXPECT_GT(by_calls.size(), 1000u);
    EXPECT_TRUE(by_calls == from_arrays);
}
INSTANTIATE_TEST_SUITE_P(Programs, Replay, testing::ValuesIn(programs()),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace glcast::test
