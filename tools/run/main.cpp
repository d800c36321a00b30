// glcast-run: start a program with the shim preloaded, wait for its cast, and leave nothing behind.
#include <fcntl.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>

#include "tools/run/checks.h"
#include "tools/run/display.h"
#include "tools/run/mesh_step.h"
#include "tools/run/options.h"
#include "tools/run/process.h"
#include "tools/run/progress.h"
#include "tools/run/report.h"
#include "tools/run/status.h"
#include "tools/run/wine.h"
#include "tools/words/text.h"

namespace {
using namespace glcast::run;
namespace fs = std::filesystem;

constexpr int start_again = -1; ///< of run(), no exit status
constexpr int end_grace_ms = 3'000;
constexpr const char* interrupted = "interrupted";
constexpr const char* wants_direct3d = "it draws by Direct3D";

/// What is wrong, and the exit status that it means.
struct Trouble {
    std::string why;
    int status = 1;
};

Trouble check_program_and_shim(const Options& options, const fs::path& program, const Library& library) {
    if (library.file.empty()) {
        return {"cannot find libglcast.so beside glcast-run nor in the library folder; GLCAST_LIBRARY can "
                "name it"};
    }
    if (program.empty()) {
        return {"cannot run " + options.program[0] + ": no such program in PATH"};
    }
    return {check_program(program, library)};
}

/// Of a mesh `glcast mesh` is asked, with all its options.
Trouble check_outputs(const Options& options, const std::string& capture, const MeshStep* meshes) {
    if (options.list) {
        return {options.list_picture.empty() ? "" : check_output(options.list_picture)};
    }
    Trouble trouble;
    if (meshes != nullptr) {
        trouble.status = meshes->rehearse(trouble.why);
        if (trouble.status != 0) return trouble;
    }
    return {meshes == nullptr || options.keep_capture ? check_output(capture) : ""};
}

/// Other preloads are kept, behind ours.
std::string compose_preload(const Library& library, const fs::path& scratch) {
    const char* others = std::getenv("LD_PRELOAD");
    return library.preload(scratch) + (others != nullptr && *others != '\0' ? ":" + std::string(others) : "");
}

Environment environment(const Options& options, const std::string& capture, const StatusPipe& pipe,
                        const Library& library, const Display& display) {
    Environment changes = shim_variables(options, capture, pipe.path());
    changes.emplace_back("LD_PRELOAD", compose_preload(library, pipe.scratch()));
    if (options.direct3d) {
        for (auto& [name, value] : direct3d_variables(options)) changes.emplace_back(name, value);
    }
    if (options.headless) {
        changes.insert(
            changes.end(),
            {{"DISPLAY", display.name()}, {"WAYLAND_DISPLAY", ""}, {"LIBGL_ALWAYS_SOFTWARE", "1"}});
    }
    return changes;
}

/// Milliseconds for poll(), rounded up; -1 for no limit.
int poll_timeout(const Options& options, std::chrono::steady_clock::time_point started) {
    if (options.timeout_seconds <= 0) {
        return -1;
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - started;
    return static_cast<int>(std::max(0.0, (options.timeout_seconds - spent.count()) * 1000 + 1));
}

/// A signal that came to us, other than of children; 0: none.
int read_signals(int signals) {
    int number = 0;
    signalfd_siginfo signal{};
    while (read(signals, &signal, sizeof signal) == sizeof signal) {
        if (signal.ssi_signo != SIGCHLD) number = static_cast<int>(signal.ssi_signo);
    }
    return number;
}

/// wined3d asks for a core profile unless it is told otherwise when it starts; a program of ours may start
/// again.
bool draws_by_direct3d(const Options& options, const Seen& seen) {
    return is_wine(options) && (options.quit || options.headless) && !options.direct3d &&
           options.pretend.empty() && seen.captures.empty() &&
           principal(seen).refused.starts_with("a core profile");
}

/// Wine's folder, which takes its time to be made, does not use up the program's.
std::string make_prefix(const Options& options, const fs::path& wine, const Display& display, int signals) {
    const fs::path prefix = missing_prefix(options);
    if (prefix.empty()) return {};
    std::cerr << glcast::printable("glcast-run: making Wine's folder " + prefix.string() + " first")
              << std::endl;
    Program boot(false);
    boot.spare(display.pid());
    const std::vector<std::string> command = {options.program[0], "wineboot", "-i"};
    if (const std::string trouble = boot.start(
            wine, command, prefix_variables(options.headless ? display.name() : ""), STDERR_FILENO);
        !trouble.empty())
        return trouble;
    for (boot.reap(); boot.wait_status() < 0; boot.reap()) {
        pollfd event{signals, POLLIN, 0};
        poll(&event, 1, -1);
        if (read_signals(signals) != 0) return interrupted;
    }
    return {};
}

/// Waits for whichever is first: the cast (with --quit), the program's end, the time limit, a signal to us.
/// Returns how it ended, to be said when there was no cast. `progress`: called after whatever happened.
std::string wait_for_cast(const Options& options, Program& program, StatusPipe& pipe, int signals, Seen& seen,
                          const std::function<void()>& progress) {
    const auto started = std::chrono::steady_clock::now();
    ProgressLine line;
    for (;;) {
        line.show(seen);
        const bool waiting =
            !seen.finished(options.captures); // the time limit is for the cast, not for the program
        pollfd events[] = {{pipe.file_descriptor(), POLLIN, 0}, {signals, POLLIN, 0}};
        const int ready = poll(events, 2, waiting ? poll_timeout(options, started) : -1);
        if (const int signal = read_signals(signals)) {
            program.signal(signal);
            pipe.read_into(seen);
            return interrupted;
        }
        program.reap();
        const bool alive = program.alive(); // before the last look at the pipe, so that no line is missed
        pipe.read_into(seen);
        line.clear();
        progress();
        if (options.quit && seen.finished(options.captures)) {
            return "done";
        }
        if (draws_by_direct3d(options, seen)) {
            return wants_direct3d;
        }
        if (!alive) {
            return "the program ended";
        }
        if (ready == 0) {
            std::ostringstream limit;
            limit << "gave up after " << options.timeout_seconds << " s";
            return limit.str();
        }
    }
}

/// The program has gone; what is captured becomes meshes, unless a signal comes.
void wait_for_meshes(MeshStep& meshes, Program& program, int signals) {
    for (meshes.advance(program); meshes.busy(); meshes.advance(program)) {
        pollfd event{signals, POLLIN, 0};
        poll(&event, 1, -1);
        if (read_signals(signals) != 0) return meshes.give_up();
        program.reap();
    }
}

/// Descriptors 0 to 2 that are closed would become a pipe of ours. A child has them closed again.
void occupy_standard_descriptors() {
    for (int descriptor = 0; descriptor <= STDERR_FILENO; ++descriptor) {
        if (fcntl(descriptor, F_GETFD) < 0) {
            open("/dev/null", O_RDWR | O_CLOEXEC); // the lowest that is free: this one
        }
    }
}

/// Why a program that was started by another, by a shell script say, may not have the library in it.
std::string find_obstacle(const Program& program, const Library& library) {
    for (const fs::path& file : program.running()) {
        if (const std::string trouble = check_program(file, library); !trouble.empty()) {
            return "; " + trouble;
        }
    }
    return {};
}

int report(const Options& options, const Seen& seen, const MeshStep* meshes, const std::string& ending) {
    if (options.list && seen.listed) return report_list(options, seen);
    if (seen.captures.empty()) return fail(describe_failure(seen, ending));
    return meshes != nullptr ? report_meshes(options, seen, *meshes, ending)
                             : report_captures(options, seen, ending);
}

int run(const Options& options) {
    occupy_standard_descriptors();
    const fs::path program_file = find_program(options.program[0]), glcast = find_glcast();
    const Library library = find_library();
    const bool makes_mesh = options.makes_mesh && !options.list;
    if (makes_mesh && glcast.empty())
        return fail("cannot find glcast beside glcast-run, which makes the mesh");
    if (const Trouble trouble = check_program_and_shim(options, program_file, library);
        !trouble.why.empty()) {
        return fail(trouble.why);
    }
    const int signals = take_signals();
    StatusPipe pipe;
    if (!pipe.ok()) {
        return fail("cannot make a pipe in the folder for temporary files");
    }
    const std::string capture =
        makes_mesh ? capture_pattern(options, pipe.scratch()).string() : options.output;
    std::optional<MeshStep> meshes;
    if (makes_mesh) meshes.emplace(options, glcast, pipe.scratch());
    if (const Trouble trouble = check_outputs(options, capture, meshes ? &*meshes : nullptr);
        !trouble.why.empty()) {
        fail(trouble.why);
        return trouble.status;
    }
    Display display;
    if (options.headless) {
        if (const std::string trouble = display.start(); !trouble.empty()) {
            return fail(trouble);
        }
    }
    if (const std::string trouble = make_prefix(options, program_file, display, signals); !trouble.empty()) {
        return fail(trouble);
    }
    Program program(options.quit || options.headless);
    program.spare(display.pid());
    const Environment changes = environment(options, capture, pipe, library, display);
    const int program_output = options.json ? STDERR_FILENO : -1;
    if (const std::string trouble = program.start(program_file, options.program, changes, program_output);
        !trouble.empty()) {
        return fail(trouble);
    }
    Seen seen;
    seen.started = std::to_string(program.id());
    std::optional<int> result;
    std::string ending = wait_for_cast(options, program, pipe, signals, seen, [&] {
        if (meshes && !seen.looking) {
            meshes->take(seen);
            meshes->advance(program);
        }
        if (!meshes && !result && seen.finished(options.captures))
            result = report(options, seen, nullptr, "");
    });
    if (ending == wants_direct3d) {
        program.end(end_grace_ms);
        return start_again;
    }
    if (principal(seen).api.empty()) {
        ending += find_obstacle(program, library);
        if (!options.headless) ending += missing_display();
    }
    if (meshes && ending == interrupted) meshes->give_up();
    program.end(end_grace_ms);
    pipe.read_into(seen); // a capture that was finished while the program was being ended counts
    report_unsaid(seen);
    if (meshes) {
        meshes->take(seen);
        if (ending == interrupted) meshes->give_up();
        wait_for_meshes(*meshes, program, signals);
    }
    return result ? *result : report(options, seen, meshes ? &*meshes : nullptr, ending);
}

int run_as_it_draws(Options options) {
    const int status = run(options);
    if (status != start_again) return status;
    std::cerr << "glcast-run: it draws by a core profile, as Direct3D does under Wine: starting it again "
                 "with --direct3d"
              << std::endl;
    options.direct3d = true;
    return run(options);
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    try {
        switch (parse_options(argc, argv, options)) {
        case Parsed::done:
            return std::cout.flush() ? 0 : fail("cannot write to standard output");
        case Parsed::usage_error:
            return 2;
        case Parsed::run:
            return run_as_it_draws(options);
        }
    } catch (const std::exception& error) {
        return fail(error.what());
    }
    return 1;
}
