#include "tools/run/status.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

namespace glcast::run {

Drawing principal(const Seen& seen) {
    const auto key = [&](const auto& entry) {
        return std::tuple(!entry.second.api.empty(), entry.second.frames, entry.first == seen.started,
                          entry.second.order);
    };
    const auto most = std::max_element(seen.drawings.begin(), seen.drawings.end(),
                                       [&](const auto& a, const auto& b) { return key(a) < key(b); });
    return most == seen.drawings.end() ? Drawing{} : most->second;
}

namespace {

long number(const std::string& text) { return std::strtol(text.c_str(), nullptr, 10); }

/// What follows the first word.
std::string rest_of(const std::string& text) {
    return text.substr(std::min(text.find(' ') + 1, text.size()));
}

/// What a line tells of the drawing of its process, if it does.
void take_drawing(const std::string& kind, const std::string& rest, const std::string& process, Seen& seen) {
    using Take = std::function<void(const std::string&, Drawing&)>;
    static const std::map<std::string, Take> kinds = {
        {"hooked",
         [](const std::string& text, Drawing& d) {
             d.api = text.substr(0, text.find(' '));
             d.name = text == d.api ? "" : rest_of(text);
         }},
        {"frames", [](const std::string& text, Drawing& d) { d.frames = std::max(d.frames, number(text)); }},
        {"waits", [](const std::string& text, Drawing& d) { d.waits = text; }},
        {"seen", [](const std::string& text, Drawing& d) { d.seen = text; }},
        {"offscreen", [](const std::string& text, Drawing& d) { d.offscreen = text; }},
        {"refused", [](const std::string& text, Drawing& d) { d.refused = text; }},
    };
    const auto found = kinds.find(kind);
    if (found == kinds.end()) {
        return;
    }
    Drawing& drawing = seen.drawings[process];
    if (drawing.order == 0) drawing.order = static_cast<int>(seen.drawings.size());
    found->second(rest, drawing);
}

} // namespace

void take_line(const std::string& line, Seen& seen) {
    using Take = std::function<void(const std::string&, Seen&)>;
    const auto capture = [](const std::string& text, Seen& s) {
        return Capture{number(text), rest_of(text), std::exchange(s.figures, {})};
    };
    static const std::map<std::string, Take> kinds = {
        {"casting", [](const std::string& rest, Seen& s) { s.casting = number(rest); }},
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
         [](const std::string& rest, Seen& s) {
             s.unsaid = std::max(s.unsaid, number(rest));
             s.unsaid_why = rest_of(rest);
         }},
        {"group", [](const std::string& rest, Seen& s) { s.groups.push_back(rest); }},
        {"listed", [](const std::string&, Seen& s) { s.listed = true; }},
    };
    const std::string head = line.substr(0, line.find(' ')),
                      rest = line.substr(std::min(head.size() + 1, line.size()));
    const std::string word = head.substr(0, head.find('@')),
                      process = head.substr(std::min(word.size() + 1, head.size()));
    if (word == "captured" || word == "recaptured" || word == "failed" || word == "listed") {
        seen.progress.clear();
    }
    if (const auto kind = kinds.find(word); kind != kinds.end()) {
        kind->second(rest, seen);
    } else {
        take_drawing(word, rest, process, seen);
    }
}

std::string describe_failure(const Seen& seen, const std::string& ending) {
    if (!seen.failed.empty()) {
        return seen.failed;
    }
    const Drawing drawing = principal(seen);
    if (drawing.api.empty()) {
        return "no GL seen: " + ending + (drawing.refused.empty() ? "" : "; " + drawing.refused);
    }
    if (seen.casting > 0) {
        return "the capture of frame " + std::to_string(seen.casting) + " was not complete: " + ending +
               (seen.progress.empty() ? "" : ", at " + seen.progress) +
               " (a longer --timeout or a smaller -n helps)";
    }
    const auto is_it = [&](const auto& entry) { return entry.second.order == drawing.order; };
    const auto own = std::find_if(seen.drawings.begin(), seen.drawings.end(), is_it);
    const bool is_another = !seen.started.empty() && own->first != seen.started && !drawing.name.empty();
    const std::string where = is_another ? " in " + drawing.name : "";
    if (!drawing.waits.empty() && drawing.frames == 0) {
        return drawing.api + " seen" + where + ", but " + drawing.waits +
               ", or no frame came after: " + ending;
    }
    const std::string refused =
        drawing.refused.empty() ? "" : " (a frame could not be recorded: " + drawing.refused + ")";
    if (drawing.frames == 0 && !drawing.offscreen.empty()) {
        return drawing.api + " seen" + where + ", but no whole frame" + refused + ": it draws into " +
               drawing.offscreen + ", and neither swaps nor reads what it draws: " + ending;
    }
    if (drawing.frames == 0) {
        return drawing.api + " seen" + where + ", but no whole frame" + refused + ": " + ending +
               " (if it draws only when its window is touched, --nudge helps)";
    }
    return std::to_string(drawing.frames) + (drawing.frames == 1 ? " frame" : " frames or more") +
           " seen through " + drawing.api + where +
           ", none with solid geometry to cast: " + (drawing.seen.empty() ? "" : drawing.seen + "; ") +
           ending;
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
