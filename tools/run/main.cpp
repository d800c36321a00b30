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
#include "tools/run/options.h"
#include "tools/run/process.h"
#include "tools/run/status.h"

namespace {
using namespace glcast::run;
namespace fs = std::filesystem;

constexpr int end_grace_ms = 3'000;

int fail(const std::string& why) {
    std::cerr << "glcast-run: " << why << '\n';
    return 1;
}

std::string check_all(const Options& options, const fs::path& program, const fs::path& shim) {
    if (shim.empty()) {
        return "cannot find libglcast.so beside glcast-run nor in the library folder; GLCAST_LIBRARY can "
               "name it";
    }
    if (program.empty()) {
        return "cannot run " + options.program[0] + ": no such program in PATH";
    }
    if (const std::string trouble = check_program(program); !trouble.empty()) {
        return trouble;
    }
    if (!options.list_picture.empty()) {
        return check_output(options.list_picture);
    }
    return options.output.empty() ? "" : check_output(options.output);
}

/// Other preloads are kept, behind ours. The loader splits at spaces and colons, so a path with one goes
/// through a link.
std::string compose_preload(fs::path shim, const fs::path& scratch) {
    if (shim.string().find_first_of(" :") != std::string::npos) {
        fs::create_symlink(shim, scratch / "libglcast.so");
        shim = scratch / "libglcast.so";
    }
    const char* others = std::getenv("LD_PRELOAD");
    return shim.string() + (others != nullptr && *others != '\0' ? ":" + std::string(others) : "");
}

Environment environment(const Options& options, const StatusPipe& pipe, const fs::path& shim,
                        const Display& display) {
    Environment changes = shim_variables(options, pipe.path());
    changes.emplace_back("LD_PRELOAD", compose_preload(shim, pipe.scratch()));
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

/// Waits for whichever is first: the cast (with --quit), the program's end, the time limit, a signal to us.
/// Returns how it ended, to be said when there was no cast.
std::string wait_for_cast(const Options& options, Program& program, StatusPipe& pipe, int signals, Seen& seen,
                          const std::function<void()>& finished) {
    const auto started = std::chrono::steady_clock::now();
    for (;;) {
        const bool waiting = !seen.finished(options.captures); // the time limit is for the cast, not for the program
        pollfd events[] = {{pipe.file_descriptor(), POLLIN, 0}, {signals, POLLIN, 0}};
        const int ready = poll(events, 2, waiting ? poll_timeout(options, started) : -1);
        signalfd_siginfo signal{};
        while (read(signals, &signal, sizeof signal) == sizeof signal) {
            if (signal.ssi_signo != SIGCHLD) {
                program.signal(static_cast<int>(signal.ssi_signo));
                pipe.read_into(seen);
                return "interrupted";
            }
        }
        program.reap();
        const bool alive = program.alive(); // before the last look at the pipe, so that no line is missed
        pipe.read_into(seen);
        if (waiting && seen.finished(options.captures)) {
            finished();
        }
        if (options.quit && seen.finished(options.captures)) {
            return "done";
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

/// What the library could not say itself.
void report_unsaid(const Seen& seen) {
    if (seen.unsaid > 0) {
        std::cerr << "glcast-run: " << seen.unsaid << (seen.unsaid == 1 ? " line" : " lines")
                  << " of the library did not go to the program's stderr: " << seen.unsaid_why << '\n';
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
std::string find_obstacle(const Program& program) {
    for (const fs::path& file : program.running()) {
        if (const std::string trouble = check_program(file); !trouble.empty()) {
            return "; " + trouble;
        }
    }
    return {};
}

int report(const Options& options, const Seen& seen, const std::string& ending) {
    if (options.list && seen.listed) {
        for (const std::string& group : seen.groups) {
            std::cout << group << '\n';
        }
        return 0;
    }
    if (seen.captures == 0) {
        return fail(describe_failure(seen, ending));
    }
    const std::string name = fs::path(options.program[0]).filename().string();
    if (seen.captures == 1) {
        std::cerr << "glcast-run: frame " << seen.captured_frame << " of " << name << " is cast in "
                  << seen.captured_file << '\n';
    } else {
        std::cerr << "glcast-run: " << seen.captures << " frames of " << name << " are cast, the last in "
                  << seen.captured_file << '\n';
    }
    if (options.captures > seen.captures) {
        return fail("only " + std::to_string(seen.captures) + " of " + std::to_string(options.captures) +
                    " captures: " + ending);
    }
    return 0;
}

int run(const Options& options) {
    occupy_standard_descriptors();
    const fs::path program_file = find_program(options.program[0]), shim = find_shim();
    if (const std::string trouble = check_all(options, program_file, shim); !trouble.empty()) {
        return fail(trouble);
    }
    const int signals = take_signals();
    StatusPipe pipe;
    if (!pipe.ok()) {
        return fail("cannot make a pipe in the folder for temporary files");
    }
    Display display;
    if (options.headless) {
        if (const std::string trouble = display.start(); !trouble.empty()) {
            return fail(trouble);
        }
    }
    Program program(options.quit || options.headless);
    program.spare(display.pid());
    const Environment changes = environment(options, pipe, shim, display);
    if (const std::string trouble = program.start(program_file, options.program, changes); !trouble.empty()) {
        return fail(trouble);
    }
    Seen seen;
    std::optional<int> result;
    const auto finished = [&] { result = report(options, seen, ""); };
    std::string ending = wait_for_cast(options, program, pipe, signals, seen, finished);
    if (seen.api.empty()) {
        ending += find_obstacle(program);
    }
    program.end(end_grace_ms);
    pipe.read_into(seen); // a capture that was finished while the program was being ended counts
    report_unsaid(seen);
    return result ? *result : report(options, seen, ending);
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    try {
        switch (parse_options(argc, argv, options)) {
        case Parsed::done:
            return 0;
        case Parsed::usage_error:
            return 2;
        case Parsed::run:
            return run(options);
        }
    } catch (const std::exception& error) {
        return fail(error.what());
    }
    return 1;
}
