// What is said at the end: one line, or one JSON object.
#pragma once
#include <string>

#include "tools/run/mesh_step.h"
#include "tools/run/options.h"
#include "tools/run/status.h"

namespace glcast::run {

/// One line on standard error, control characters written out. Returns the exit status of a failure.
int fail(const std::string& why);

/// Each says what there is, and returns the exit status. `ending` says how the wait ended.
int report_list(const Options& options, const Seen& seen);
int report_captures(const Options& options, const Seen& seen, const std::string& ending);
/// Of what was made `glcast mesh` has said its line.
int report_meshes(const Options& options, const Seen& seen, const MeshStep& meshes,
                  const std::string& ending);

/// What the library could not say itself.
void report_unsaid(const Seen& seen);

/// Why nothing was seen, where it is for want of an X server: "; DISPLAY is not set: --headless ...". Else
/// empty.
std::string missing_display();

} // namespace glcast::run
