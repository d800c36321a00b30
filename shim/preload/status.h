// What the shim tells people, and what it tells glcast-run.
//
// People read lines on stderr, each beginning with "glcast: ". glcast-run reads the events in GLCAST_STATUS
// (docs/reference/status-lines.md). All of them are written here; control characters come out as \x1b. None
// waits, raises a signal, or gets into anything of the program's; what cannot be said is counted and told.
#pragma once
#include <string>

namespace glcast::preload {

/// One line on stderr.
[[gnu::format(printf, 1, 2)]] void say(const char* format, ...);
/// The same, but each line only once in the life of the process.
[[gnu::format(printf, 1, 2)]] void say_once(const char* format, ...);

/// One line in GLCAST_STATUS; nothing without it.
void tell(const char* event, const std::string& text);
bool has_status_file();
/// Nobody else tells of captures and lists: there is no GLCAST_STATUS, or GLCAST_VERBOSE wants figures all
/// the same.
bool speaks_alone();

/// File name of the running program.
std::string program_name();

} // namespace glcast::preload
