// Where people read what the shim says: the stderr that the program began with, and nothing else.
//
// Descriptor 2 is the program's. It may be closed, or be its data file or its X connection by now, so what it
// was is remembered when the library is loaded, and what it is is asked before each line
// (docs/reference/status-lines.md has the table).
#pragma once
#include <string_view>

namespace glcast::preload {

/// One line with its end, shorter than PIPE_BUF. Never waits, raises no signal, changes nothing that the
/// program can see. Null when it is written, or when nobody wants to read it (stderr is /dev/null); else why
/// it is lost.
const char* write_to_standard_error(std::string_view line);

} // namespace glcast::preload
