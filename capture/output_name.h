// The name of a capture, of which there may be several in a run.
#pragma once
#include <string>

namespace glcast {

/// "%p" becomes the process id, "%f" the frame's number, "%%" a per cent sign; anything else stays.
std::string output_name(const std::string& pattern, long process, long frame);

/// Would output_name change it?
bool is_pattern(const std::string& name);

} // namespace glcast
