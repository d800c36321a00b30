#include "tools/run/mesh_step.h"

#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "capture/output_name.h"

namespace glcast::run {
namespace fs = std::filesystem;
namespace {

constexpr int end_grace_ms = 5'000;
constexpr int given_up = 128 + SIGTERM, not_started = 127;

} // namespace

fs::path find_glcast() {
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    for (const char* folder : {"", GLCAST_COMMAND_FROM_BUILD}) {
        const fs::path candidate = (here / folder / "glcast").lexically_normal();
        if (fs::is_regular_file(candidate) && access(candidate.c_str(), X_OK) == 0) {
            return candidate;
        }
    }
    return {};
}

fs::path capture_pattern(const Options& options, const fs::path& scratch) {
    // Process and frame: each capture has a name of its own, and none that could need escaping.
    return options.keep_capture ? fs::path(options.output).replace_extension(".exr") : scratch / "%p.%f.exr";
}

MeshStep::MeshStep(const Options& options, fs::path glcast, fs::path scratch)
    : options(options), glcast(std::move(glcast)), scratch(std::move(scratch)) {}

std::vector<std::string> MeshStep::command(const fs::path& capture, const fs::path& mesh) const {
    std::vector<std::string> words = {glcast, "mesh", capture, "-o", mesh};
    words.insert(words.end(), options.mesh_arguments.begin(), options.mesh_arguments.end());
    if (options.json) words.emplace_back("--json");
    if (options.verbose) words.emplace_back("--verbose");
    return words;
}

int MeshStep::rehearse(std::string& why) const {
    std::vector<std::string> words = command(scratch / "capture.exr", options.output);
    words.emplace_back("--rehearse");
    const Answer answer = ask(words);
    why = answer.errors.substr(0, answer.errors.find('\n'));
    if (why.starts_with("glcast: ")) why = why.substr(8);
    if (why.empty()) why = glcast.string() + " ended with " + std::to_string(answer.status);
    return answer.status;
}

fs::path MeshStep::mesh_of(const Capture& capture) const {
    const fs::path output(options.output), name = fs::path(capture.file).filename();
    if (options.keep_capture) return fs::path(capture.file).replace_extension(output.extension());
    return output_name(output, std::strtol(name.c_str(), nullptr, 10), capture.frame);
}

void MeshStep::take(const Seen& seen) {
    for (; taken < seen.captures.size(); ++taken) {
        const Job job{seen.captures[taken], mesh_of(seen.captures[taken])};
        // A mesh without %f in its name is made again and again: the last is what counts.
        std::erase_if(waiting, [&](const Job& other) {
            if (other.mesh != job.mesh) return false;
            if (other.capture.file != job.capture.file) let_go(other);
            return true;
        });
        waiting.push_back(job);
    }
}

void MeshStep::advance(Program& program) {
    if (running >= 0) {
        if (const auto ended = program.take_ended(running)) finish(exit_status(*ended));
    }
    if (running < 0 && !waiting.empty()) begin(program);
}

void MeshStep::begin(Program& program) {
    current = waiting.front();
    waiting.pop_front();
    if (options.json) output = memfd_create("json", MFD_CLOEXEC);
    running = start_command(command(current.capture.file, current.mesh), output);
    if (running < 0) return finish(not_started);
    program.spare(running);
}

void MeshStep::finish(int status) {
    running = -1;
    const std::string json = output >= 0 ? take_text(output) : std::string();
    output = -1;
    finish(current, status, json);
}

void MeshStep::finish(const Job& job, int status, std::string json) {
    let_go(job);
    Capture capture = job.capture;
    if (!options.keep_capture) capture.file.clear();
    done.push_back({capture, job.mesh, status, std::move(json)});
}

void MeshStep::let_go(const Job& job) const {
    std::error_code ignored;
    const fs::path file = job.capture.file;
    if (!options.keep_capture && file.parent_path() == scratch) fs::remove(file, ignored);
}

void MeshStep::give_up() {
    if (running >= 0) {
        end_process(running, end_grace_ms);
        finish(given_up);
    }
    for (const Job& job : waiting) finish(job, given_up, {});
    waiting.clear();
}

} // namespace glcast::run
