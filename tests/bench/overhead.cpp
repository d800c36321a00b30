// Nanoseconds per immediate-mode call under software GL: plain, with the least that a preload can do, with
// glcast idle and armed, and under apitrace where it is installed. All in one run, the kinds taken in turn,
// medians over the rounds.
//
// ROUNDS 0: only the memory that a display list of a million vertices takes.
//
//     overhead [ROUNDS] [--glxgears] [--capture] [--only]
//
// --only: what is asked for by such words, and not the cost of calls and the memory of lists.
//
// --glxgears: also glxgears, plain and with idle glcast: frames a second, processor time a frame, and the
// median of their ratios over rounds of both (21 s each), which a noisy machine disturbs least.
// --capture: also a capture of glxgears (n = 512) against its own frame in a window of 512 x 512.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <regex>

#include "tests/bench/overhead_gears.h"
#include "tests/support/xvfb.h"

namespace {

using namespace glcast::test;
using Variables = std::vector<std::pair<std::string, std::string>>;

struct Kind {
    const char* name;
    std::vector<std::string> launcher; ///< put before the program
    Variables variables;
    std::vector<double> results = {};
};

constexpr const char* far_frame = "1000000000";

std::vector<Kind> make_kinds(const TemporaryFolder& folder) {
    const std::string out = folder / "never.exr";
    const std::pair<std::string, std::string> shim = {"LD_PRELOAD", GLCAST_SHIM};
    std::vector<Kind> kinds = {
        {"plain", {}, {}},
        {"two-line preload", {}, {{"LD_PRELOAD", OVERHEAD_PASS_THROUGH}}},
        {"glcast, nothing asked", {}, {shim}},
        {"glcast idle (waits for a far frame)", {}, {shim, {"GLCAST_OUT", out}, {"GLCAST_FRAME", far_frame}}},
        // Every frame is recorded and then refused, because it has no such group.
        {"glcast armed (records each frame)", {}, {shim, {"GLCAST_OUT", out}, {"GLCAST_GROUP", "999"}}},
    };
    if (access("/usr/bin/apitrace", X_OK) == 0)
        kinds.push_back({"apitrace trace", {"apitrace", "trace", "-o", folder / "calls.trace"}, {}});
    return kinds;
}

Outcome run_kind(const Kind& kind, const Xvfb& server, const std::vector<std::string>& program,
                 double seconds) {
    Command command;
    command.arguments = kind.launcher;
    command.arguments.insert(command.arguments.end(), program.begin(), program.end());
    command.environment = {
        {"DISPLAY", server.display()}, {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"vblank_mode", "0"}};
    command.environment.insert(command.environment.end(), kind.variables.begin(), kind.variables.end());
    command.timeout_seconds = seconds;
    return run(command);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

void measure_calls(const Xvfb& server, const TemporaryFolder& folder, int rounds) {
    std::vector<Kind> kinds = make_kinds(folder);
    for (int round = 0; round < rounds; ++round)
        for (Kind& kind : kinds) {
            const Outcome outcome = run_kind(kind, server, {OVERHEAD_CALLS, "60"}, 120);
            const double result = std::strtod(outcome.out.c_str(), nullptr);
            if (result > 0) kind.results.push_back(result);
        }
    std::printf("%-40s %10s %10s %10s   %d rounds\n", "ns per call, software GL", "median", "least", "most",
                rounds);
    for (const Kind& kind : kinds) {
        if (kind.results.empty()) {
            std::printf("%-40s does not run\n", kind.name);
            continue;
        }
        const auto [least, most] = std::minmax_element(kind.results.begin(), kind.results.end());
        std::printf("%-40s %10.1f %10.1f %10.1f\n", kind.name, median(kind.results), *least, *most);
    }
}

/// All kinds one after the other in each round, each in turn first. The two-line preload tells what is noise.
void measure_glxgears(const Xvfb& server, const TemporaryFolder& folder, int rounds) {
    const std::vector<Kind> all = make_kinds(folder);
    const std::vector<const Kind*> kinds = {&all[0], &all[1], &all[3]};
    std::vector<std::vector<double>> wall(kinds.size()), processor(kinds.size());
    for (std::size_t round = 0; round < std::size_t(rounds); ++round)
        for (std::size_t turn = 0; turn < kinds.size(); ++turn) {
            const std::size_t k = (round + turn) % kinds.size();
            Variables environment = {{"DISPLAY", server.display()},
                                     {"LIBGL_ALWAYS_SOFTWARE", "1"},
                                     {"LP_NUM_THREADS", "1"},
                                     {"vblank_mode", "0"}};
            environment.insert(environment.end(), kinds[k]->variables.begin(), kinds[k]->variables.end());
            const GearsFrame frame = measure_gears(environment);
            wall[k].push_back(frame.wall_seconds);
            processor[k].push_back(frame.processor_seconds);
        }
    std::printf("%-40s %12s %12s %26s %26s   %d rounds\n", "glxgears, a frame, medians", "wall ms",
                "processor ms", "plain / it, wall", "plain / it, processor", rounds);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const Ratio speed = ratio_of(wall[k], wall[0]), work = ratio_of(processor[k], processor[0]);
        std::printf("%-40s %12.4f %12.4f     %.3f (%.3f to %.3f)     %.3f (%.3f to %.3f)\n", kinds[k]->name,
                    1e3 * median(wall[k]), 1e3 * median(processor[k]), speed.median, speed.lower, speed.upper,
                    work.median, work.lower, work.upper);
    }
}

double number_in(const std::string& text, const char* pattern) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(pattern)) ? std::strtod(match[1].str().c_str(), nullptr)
                                                               : 0;
}

/// Both at 512 x 512 pixels. The capture's draws and seconds are those that the shim tells: all passes with
/// their reading, compression and writing, but not the search for the box.
void measure_capture(const Xvfb& server, const TemporaryFolder& folder, int rounds) {
    const std::vector<std::string> program = {"glxgears", "-geometry", "512x512+0+0"};
    const Kind plain{"plain", {}, {}};
    std::vector<double> frames;
    for (int round = 0; round < rounds; ++round) {
        const double fps = number_in(run_kind(plain, server, program, 11).out, "= ([0-9.]+) FPS");
        if (fps > 0) frames.push_back(1 / fps);
    }
    const double least = frames.empty() ? 0 : *std::min_element(frames.begin(), frames.end());
    std::printf("own frame, 512 x 512 pixels: median %.2f ms, least %.2f ms, %zu rounds\n",
                1e3 * median(frames), 1e3 * least, frames.size());
    for (const char* layers : {"1", "auto"}) {
        const Kind kind{"capture",
                        {},
                        {{"LD_PRELOAD", GLCAST_SHIM},
                         {"GLCAST_OUT", folder / "gears.exr"},
                         {"GLCAST_N", "512"},
                         {"GLCAST_LAYERS", layers},
                         {"GLCAST_FRAME", "10"},
                         {"GLCAST_QUIT", "1"}}};
        std::vector<double> seconds;
        double draws = 0;
        for (int round = 0; round < rounds; ++round) {
            const std::string said = run_kind(kind, server, program, 60).err;
            draws = number_in(said, " ([0-9]+) draws,");
            if (draws > 0) seconds.push_back(number_in(said, "draws, ([0-9.]+) s"));
        }
        const double least = seconds.empty() ? 0 : *std::min_element(seconds.begin(), seconds.end());
        std::printf("capture, layers %-5s %3.0f draws, median %.2f s, least %.2f s\n", layers, draws,
                    median(seconds), least);
    }
}

/// What is shadowed always, even by an idle glcast: display lists.
void measure_list_memory(const Xvfb& server, const TemporaryFolder& folder) {
    const std::vector<Kind> kinds = make_kinds(folder);
    for (const Kind* kind : {&kinds[0], &kinds[2], &kinds[3]}) {
        const Outcome outcome = run_kind(*kind, server, {OVERHEAD_CALLS, "list"}, 120);
        std::printf("a list of 1,000,000 vertices with normals, %-36s %8.1f MiB more\n", kind->name,
                    std::strtod(outcome.out.c_str(), nullptr) / (1 << 20));
    }
}

} // namespace

int main(int argc, char** argv) {
    int rounds = 5;
    bool gears = false, capture = false, only = false;
    for (int i = 1; i < argc; ++i)
        if (std::strcmp(argv[i], "--glxgears") == 0)
            gears = true;
        else if (std::strcmp(argv[i], "--capture") == 0)
            capture = true;
        else if (std::strcmp(argv[i], "--only") == 0)
            only = true;
        else
            rounds = std::max(0, std::atoi(argv[i]));
    const Xvfb server;
    const TemporaryFolder folder;
    if (!only) measure_list_memory(server, folder);
    if (rounds > 0 && !only) measure_calls(server, folder, rounds);
    if (gears) measure_glxgears(server, folder, rounds);
    if (capture) measure_capture(server, folder, std::max(1, rounds));
}
