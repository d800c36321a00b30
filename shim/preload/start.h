// How the process stood when the library was loaded. The program may change its folder later, and the preload
// goes on to whatever it starts (a shell, sed).
#pragma once
#include <string>

namespace glcast::preload {

/// False in a process that was started, or forked, by one that has the same preload: it speaks for them.
bool is_meant_program();

/// A name in the folder of then; as it is where that was not to be found out.
std::string absolute_at_start(const std::string& file);

/// A file of that name was written since this process began, by a program that it started perhaps.
bool written_since_start(const std::string& file);

} // namespace glcast::preload
