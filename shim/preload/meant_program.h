// The preload goes on to whatever a program starts (a shell, sed): which of these was meant.
#pragma once
#include <string>

namespace glcast::preload {

/// False in a process that was started, or forked, by one that has the same preload: it speaks for them.
bool is_meant_program();

/// A file of that name was written since this process began, by a program that it started perhaps.
bool written_since_start(const std::string& file);

} // namespace glcast::preload
