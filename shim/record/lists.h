// Display lists: what was compiled, and how calls to lists reach the frame.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

/// Writes what has become of lists since the frame last looked (this context's doing or another's) into the
/// frame.
void note_list_changes(Context& context);

} // namespace glcast::record
