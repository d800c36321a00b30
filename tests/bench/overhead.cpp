// Nanoseconds per immediate-mode call under software GL: plain, with the least that a preload can do, with
// glcast idle and armed, and under apitrace where it is installed. All in one run, the kinds taken in turn,
// medians over the rounds.
//
// ROUNDS 0: only the memory that a display list of a million vertices takes.
//
//     overhead [ROUNDS] [--glxgears]     --glxgears: also frames a second of glxgears, plain and with idle
//     glcast
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <regex>

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

void measure_glxgears(const Xvfb& server, const TemporaryFolder& folder, int rounds) {
    std::vector<Kind> kinds = make_kinds(folder);
    kinds = {kinds[0], kinds[3]};
    const std::regex fps("= ([0-9.]+) FPS");
    for (int round = 0; round < rounds; ++round)
        for (Kind& kind : kinds) {
            const Outcome outcome = run_kind(kind, server, {"glxgears"}, 11);
            std::smatch match;
            if (std::regex_search(outcome.out, match, fps))
                kind.results.push_back(std::strtod(match[1].str().c_str(), nullptr));
        }
    for (const Kind& kind : kinds)
        std::printf("glxgears, %-30s %10.1f frames a second\n", kind.name, median(kind.results));
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
    bool gears = false;
    for (int i = 1; i < argc; ++i)
        if (std::strcmp(argv[i], "--glxgears") == 0)
            gears = true;
        else
            rounds = std::max(0, std::atoi(argv[i]));
    const Xvfb server;
    const TemporaryFolder folder;
    measure_list_memory(server, folder);
    if (rounds > 0) measure_calls(server, folder, rounds);
    if (gears) measure_glxgears(server, folder, rounds);
}
