#include "tools/run/status.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

namespace glcast::run {

void take_line(const std::string& line, Seen& seen) {
    using Take = std::function<void(const std::string&, Seen&)>;
    const auto number = [](const std::string& text) { return std::strtol(text.c_str(), nullptr, 10); };
    const auto capture = [=](const std::string& text, Seen& s) {
        return Capture{number(text), text.substr(std::min(text.find(' ') + 1, text.size())), std::exchange(s.figures, {})};
    };
    static const std::map<std::string, Take> kinds = {
        {"hooked", [](const std::string& rest, Seen& s) { s.api = rest; }},
        {"frames", [=](const std::string& rest, Seen& s) { s.frames = std::max(s.frames, number(rest)); }},
        {"waits", [](const std::string& rest, Seen& s) { s.waits = rest; }},
        {"seen", [](const std::string& rest, Seen& s) { s.seen = rest; }},
        {"offscreen", [](const std::string& rest, Seen& s) { s.offscreen = rest; }},
        {"refused", [](const std::string& rest, Seen& s) { s.refused = rest; }},
        {"casting", [=](const std::string& rest, Seen& s) { s.casting = number(rest); }},
        {"figures", [](const std::string& rest, Seen& s) { s.figures = rest; }},
        {"captured", [=](const std::string& rest, Seen& s) { s.captures.push_back(capture(rest, s)); }},
        {"recaptured",
         [=](const std::string& rest, Seen& s) {
             if (!s.captures.empty()) s.captures.pop_back();
             s.captures.push_back(capture(rest, s));
         }},
        {"looks", [](const std::string&, Seen& s) { s.looking = true; }},
        {"settled", [](const std::string&, Seen& s) { s.looking = false; }},
        {"failed",
         [](const std::string& rest, Seen& s) { s.failed = rest.empty() ? "the capture failed" : rest; }},
        {"slow", [](const std::string& rest, Seen& s) { s.slow = rest; }},
        {"progress", [](const std::string& rest, Seen& s) { s.progress = rest; }},
        {"unsaid",
         [=](const std::string& rest, Seen& s) {
             s.unsaid = std::max(s.unsaid, number(rest));
             s.unsaid_why = rest.substr(std::min(rest.find(' ') + 1, rest.size()));
         }},
        {"group", [](const std::string& rest, Seen& s) { s.groups.push_back(rest); }},
        {"listed", [](const std::string&, Seen& s) { s.listed = true; }},
    };
    const auto space = std::min(line.find(' '), line.size());
    const std::string_view word(line.data(), space);
    if (word == "captured" || word == "recaptured" || word == "failed" || word == "listed") {
        seen.progress.clear();
    }
    if (const auto kind = kinds.find(line.substr(0, space)); kind != kinds.end()) {
        kind->second(line.substr(std::min(space + 1, line.size())), seen);
    }
}

std::string describe_failure(const Seen& seen, const std::string& ending) {
    if (!seen.failed.empty()) {
        return seen.failed;
    }
    if (seen.api.empty()) {
        return "no GL seen: " + ending;
    }
    if (seen.casting > 0) {
        return "the capture of frame " + std::to_string(seen.casting) + " was not complete: " + ending +
               (seen.progress.empty() ? "" : ", at " + seen.progress) +
               " (a longer --timeout or a smaller -n helps)";
    }
    if (!seen.waits.empty() && seen.frames == 0) {
        return seen.api + " seen, but " + seen.waits + ", or no frame came after: " + ending;
    }
    const std::string refused =
        seen.refused.empty() ? "" : " (a frame could not be recorded: " + seen.refused + ")";
    if (seen.frames == 0 && !seen.offscreen.empty()) {
        return seen.api + " seen, but no whole frame" + refused + ": it draws into " + seen.offscreen +
               ", and neither swaps nor reads what it draws: " + ending;
    }
    if (seen.frames == 0) {
        return seen.api + " seen, but no whole frame" + refused + ": " + ending +
               " (if it draws only when its window is touched, --nudge helps)";
    }
    return std::to_string(seen.frames) + (seen.frames == 1 ? " frame" : " frames or more") +
           " seen through " + seen.api + ", none with solid geometry to cast: " +
           (seen.seen.empty() ? "" : seen.seen + "; ") + ending;
}

StatusPipe::StatusPipe() {
    const char* temporary = std::getenv("TMPDIR");
    std::string pattern =
        std::string(temporary != nullptr && *temporary != '\0' ? temporary : "/tmp") + "/glcast-run-XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) {
        return;
    }
    folder = pattern;
    if (mkfifo(path().c_str(), 0600) == 0) {
        // Open for both ways: the pipe then never reads as ended while no process of the program has it open.
        descriptor = open(path().c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    }
}

StatusPipe::~StatusPipe() {
    if (descriptor >= 0) {
        close(descriptor);
    }
    std::error_code ignored;
    if (!folder.empty()) {
        std::filesystem::remove_all(folder, ignored);
    }
}

void StatusPipe::read_into(Seen& seen) {
    char buffer[4096];
    for (ssize_t got; (got = read(descriptor, buffer, sizeof buffer)) > 0;) {
        unfinished.append(buffer, static_cast<std::size_t>(got));
    }
    for (auto end = unfinished.find('\n'); end != std::string::npos; end = unfinished.find('\n')) {
        take_line(unfinished.substr(0, end), seen);
        unfinished.erase(0, end + 1);
    }
}

} // namespace glcast::run
