// The pictures of all groups on one page, numbered as `--group` counts them.
#pragma once
#include <string>
#include <vector>

#include "shim/preload/choice.h"

namespace glcast::preload {

/// Writes a .png; one clear line when it cannot.
std::string write_contact_sheet(const std::vector<Candidate>& candidates, const std::string& path);

} // namespace glcast::preload
