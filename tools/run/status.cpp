#include "tools/run/status.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <sstream>

namespace glcast::run {

void take_line(const std::string& line, Seen& seen) {
    struct Event {
        long pid;
        std::string text;
    };
    using Take = void (*)(const Event&, Seen&);
    static const std::map<std::string, Take> events = {
        {"hooked", [](const Event& e, Seen& s) { s.hooked = e.text, s.gl_processes.insert(e.pid); }},
        {"group", [](const Event& e, Seen& s) { s.groups.push_back(e.text); }},
        {"listed", [](const Event& e, Seen& s) { s.listed = e.text.empty() ? "a frame" : e.text; }},
        {"captured", [](const Event& e, Seen& s) { s.capture = e.text; }},
        {"failed",
         [](const Event& e, Seen& s) { s.failed = e.text.empty() ? "the capture failed" : e.text; }},
        {"exit", // of a launcher's helpers, which see no GL, nobody wants to know
         [](const Event& e, Seen& s) { s.at_exit = s.gl_processes.contains(e.pid) ? e.text : s.at_exit; }},
    };
    std::istringstream words(line);
    Event event{};
    std::string kind;
    words >> event.pid >> kind >> std::ws;
    std::getline(words, event.text);
    if (const auto known = events.find(kind); known != events.end()) {
        known->second(event, seen);
    }
}

std::string describe_failure(const Seen& seen, const std::string& ending) {
    if (!seen.failed.empty()) {
        return seen.failed;
    }
    if (seen.hooked.empty()) {
        return "no GL seen: " + ending;
    }
    if (!seen.at_exit.empty()) {
        return seen.at_exit + ": " + ending;
    }
    return seen.hooked + ", but no frame with solid geometry was cast: " + ending;
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
