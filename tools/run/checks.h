// What is looked at before anything is started, so that a wrong call costs nothing and leaves nothing.
#pragma once
#include <filesystem>
#include <string>

#include "tools/run/library.h"

namespace glcast::run {

/// Each returns one clear line, or an empty string when all is well.

/// `file` (absolute) can be made or replaced; leaves nothing behind.
std::string check_output(const std::filesystem::path& file);

/// The loader will take `library` into `program`: it exists, may be run, is of a width that there is a
/// library for, is linked dynamically and gains no privileges. A script is judged by its interpreter.
std::string check_program(const std::filesystem::path& program, const Library& library);

/// As execvp finds it: a name with a slash as it is, others along PATH. Empty when there is none.
std::filesystem::path find_program(const std::string& name);

} // namespace glcast::run
