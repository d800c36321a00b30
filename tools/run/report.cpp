#include "tools/run/report.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tools/run/wine.h"
#include "tools/words/closing.h"
#include "tools/words/text.h"

namespace glcast::run {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void say(const std::string& line) { std::cerr << printable("glcast-run: " + line) << '\n'; }

int print_json(const Json& object) {
    std::cout << object.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
    return std::cout ? 0 : fail("cannot write to standard output");
}

/// Of Windows programs that which draws: Wine's command, or a launcher, was started.
std::string program_name(const Options& options, const Seen& seen) {
    const std::string drawing = is_wine(options) ? principal(seen).name : "";
    return drawing.empty() ? shown_program(options) : drawing;
}

/// As one would type it from here.
std::string from_here(const fs::path& file) {
    std::error_code ignored;
    const fs::path here = fs::current_path(ignored);
    return file.parent_path() == here ? file.filename().string() : file.string();
}

/// A capture that is not kept has no file.
Json describe(const Capture& capture) {
    Json json = {{"frame", capture.frame}};
    if (!capture.file.empty()) json["capture"] = capture.file;
    if (!capture.figures.empty()) json["figures"] = capture.figures;
    return json;
}

void say_figures(const Options& options, const Capture& capture) {
    if (options.verbose && !options.json && !capture.figures.empty())
        say("frame " + std::to_string(capture.frame) + ": " + capture.figures);
}

int too_few(const Options& options, const Seen& seen, const std::string& ending) {
    return fail("only " + std::to_string(seen.captures.size()) + " of " + std::to_string(options.captures) +
                " captures: " + ending);
}

/// A frame that could not be captured, beside others that could.
void say_failure(const Seen& seen) {
    if (!seen.failed.empty()) say(seen.failed);
}

bool are_too_few(const Options& options, const Seen& seen) {
    return options.captures > static_cast<long>(seen.captures.size());
}

/// A server on this machine that does not answer; those on others are not asked.
bool is_dead(const std::string& display) {
    if (display[0] != ':') return false;
    const std::string number = display.substr(1, display.find('.') - 1);
    if (number.empty() ||
        !std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c); }))
        return false;
    const int client = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const auto answers = [&](const std::string& path, bool abstract) {
        sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
        const std::size_t first = abstract ? 1 : 0;
        if (path.size() + 2 > sizeof address.sun_path) return false;
        std::copy(path.begin(), path.end(), address.sun_path + first);
        const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + first + path.size());
        return connect(client, reinterpret_cast<const sockaddr*>(&address), length) == 0;
    };
    const std::string path = "/tmp/.X11-unix/X" + number;
    const bool dead = client >= 0 && !answers(path, true) && !answers(path, false);
    if (client >= 0) close(client);
    return dead;
}

} // namespace

int fail(const std::string& why) {
    say(why);
    return 1;
}

void report_unsaid(const Seen& seen) {
    if (seen.unsaid > 0)
        say(std::to_string(seen.unsaid) + (seen.unsaid == 1 ? " line" : " lines") +
            " of the library did not go to the program's stderr: " + seen.unsaid_why);
}

std::string missing_display() {
    const char* display = std::getenv("DISPLAY");
    if (display == nullptr || *display == '\0')
        return "; DISPLAY is not set, so a program that needs a screen has none: --headless gives it one of "
               "its own";
    if (is_dead(display))
        return "; no X server answers at DISPLAY=" + std::string(display) +
               ": --headless gives it one of its own";
    return {};
}

int report_list(const Options& options, const Seen& seen) {
    if (options.json) return print_json({{"program", program_name(options, seen)}, {"groups", seen.groups}});
    for (const std::string& group : seen.groups) std::cout << printable(group) << '\n';
    return std::cout.flush() ? 0 : fail("cannot write to standard output");
}

int report_captures(const Options& options, const Seen& seen, const std::string& ending) {
    for (const Capture& capture : seen.captures) say_figures(options, capture);
    say_failure(seen);
    if (options.json) {
        Json json = {{"program", program_name(options, seen)}, {"captures", Json::array()}};
        for (const Capture& capture : seen.captures) json["captures"].push_back(describe(capture));
        if (const int trouble = print_json(json)) return trouble;
    } else {
        const Capture& last = seen.captures.back();
        const std::string file = from_here(last.file), name = program_name(options, seen);
        say((seen.captures.size() == 1
                 ? "frame " + std::to_string(last.frame) + " of " + name + " is cast in " + file
                 : std::to_string(seen.captures.size()) + " frames of " + name + " are cast, the last in " +
                       file) +
            "; to look at it: " + how_to_look(file));
    }
    return are_too_few(options, seen) ? too_few(options, seen, ending) : 0;
}

int report_meshes(const Options& options, const Seen& seen, const MeshStep& meshes,
                  const std::string& ending) {
    Json json = {{"program", program_name(options, seen)}, {"captures", Json::array()}};
    int made = 0, status = 0;
    say_failure(seen);
    for (const MeshStep::Result& result : meshes.results()) {
        made += result.status == 0;
        say_figures(options, result.capture);
        Json one = describe(result.capture);
        if (result.status == 0) one["mesh"] = Json::parse(result.json, nullptr, false);
        json["captures"].push_back(std::move(one));
    }
    if (options.json) status = print_json(json);
    for (const MeshStep::Result& result : meshes.results()) {
        const std::string mesh = from_here(result.mesh), frame = std::to_string(result.capture.frame);
        const std::string kept = "its capture is kept in " + from_here(result.capture.file);
        if (result.status != 0)
            status = fail("frame " + frame + " is captured, but " + mesh + " is not made; " +
                          (options.keep_capture ? kept : "with --keep-capture its capture would be kept"));
        else if (options.keep_capture && !options.json)
            say(mesh + ": " + kept);
    }
    if (are_too_few(options, seen)) return too_few(options, seen, ending);
    return made > 0 || status != 0 ? status : fail("no mesh is made: " + ending);
}

} // namespace glcast::run
