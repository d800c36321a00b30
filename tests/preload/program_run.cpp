#include "tests/preload/program_run.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

namespace glcast::test {
namespace {

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The sanitizers want to be loaded first.
std::string preload_list() {
    const std::string runtime = GLCAST_SANITIZER_RUNTIME;
    return runtime.empty() ? GLCAST_SHIM : runtime + " " GLCAST_SHIM;
}

void add_difference(const ViewImage& a, const ViewImage& b, CaptureDifference& d) {
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        if (a.covered(i) != b.covered(i)) ++d.coverage;
        if (!a.covered(i) || !b.covered(i)) continue;
        ++d.covered;
        d.depth = std::max(d.depth, double(std::abs(a.depth[i] - b.depth[i])));
        d.colour = std::max(d.colour, double(glm::length(glm::vec3(a.colour[i]) - glm::vec3(b.colour[i]))));
        if (a.normal[i].w > 0 && b.normal[i].w > 0)
            d.normal =
                std::max(d.normal, double(glm::length(glm::vec3(a.normal[i]) - glm::vec3(b.normal[i]))));
    }
}

} // namespace

const Xvfb& x_server() {
    static const Xvfb server;
    return server;
}

Outcome run_program(const std::vector<std::string>& arguments, const Environment& environment, bool preload) {
    Command command;
    command.arguments = arguments;
    command.environment = {{"DISPLAY", x_server().display()},
                           {"LIBGL_ALWAYS_SOFTWARE", "1"},
                           {"LP_NUM_THREADS", "1"},
                           {"ASAN_OPTIONS", "detect_leaks=0:suppressions=" GLCAST_SUPPRESSIONS ".asan"},
                           {"UBSAN_OPTIONS", "halt_on_error=1:print_stacktrace=1"},
                           {"TSAN_OPTIONS", "halt_on_error=1:second_deadlock_stack=1:die_after_fork=0:"
                                            "suppressions=" GLCAST_SUPPRESSIONS ".tsan"}};
    command.environment.insert(command.environment.end(), environment.begin(), environment.end());
    if (preload) command.environment.emplace_back("LD_PRELOAD", preload_list());
    return run(command);
}

FixtureRun run_fixture(std::vector<std::string> arguments, const Environment& environment, bool preload) {
    const TemporaryFolder folder;
    for (const char* file : {"pixels", "errors", "state"})
        arguments.insert(arguments.end(), {std::string("--") + file, folder / file});
    FixtureRun result;
    result.outcome = run_program(arguments, environment, preload);
    result.pixels = read_file(folder / "pixels");
    result.errors = read_file(folder / "errors");
    result.state = read_file(folder / "state");
    return result;
}

FixtureRun cast_fixture(const std::vector<std::string>& arguments, const Environment& environment) {
    const TemporaryFolder folder;
    Environment all = {{"GLCAST_OUT", folder / "cast.exr"}, {"GLCAST_N", "64"}};
    for (const auto& [name, value] : environment) all[name] = value;
    FixtureRun result = run_fixture(arguments, all, true);
    const std::string out = all["GLCAST_OUT"];
    if (!out.empty() && std::filesystem::exists(out)) result.capture = read_capture(out);
    return result;
}

CastRun cast_program(const std::vector<std::string>& command, int n, Environment environment) {
    const TemporaryFolder folder;
    environment["GLCAST_OUT"] = folder / "cast.exr";
    environment["GLCAST_N"] = std::to_string(n);
    CastRun run;
    run.outcome = run_program(command, environment, true);
    if (std::filesystem::exists(folder / "cast.exr")) run.capture = read_capture(folder / "cast.exr");
    return run;
}

std::vector<std::string> glcast_lines(const Outcome& outcome) {
    const std::string prefix = "glcast: ";
    std::vector<std::string> lines;
    std::istringstream text(outcome.err);
    for (std::string line; std::getline(text, line);)
        if (line.starts_with(prefix)) lines.push_back(line.substr(prefix.size()));
    return lines;
}

CaptureDifference compare(const Capture& a, const Capture& b) {
    CaptureDifference difference;
    for (const ViewImage& image : a.images)
        for (const ViewImage& other : b.images)
            if (image.view == other.view && image.n == other.n) add_difference(image, other, difference);
    return difference;
}

double volume(const Capture& capture) {
    const int n = capture.info.n;
    double sum = 0;
    for (const ViewImage& image : capture.images) {
        if (image.view.axis != Axis::z || image.view.layer != 0) continue;
        const double sign = image.view.side == Side::plus ? 1 : -1;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const std::size_t at = std::size_t(j) * n + i;
                if (image.covered(at))
                    sum += sign * lattice_point(capture.info.box, n, Axis::z, i, j, image.depth[at]).z;
            }
    }
    return std::abs(sum) * std::pow(capture.info.box.size / n, 2);
}

} // namespace glcast::test
