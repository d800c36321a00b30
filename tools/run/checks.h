// What is looked at before anything is started, so that a wrong call costs nothing and leaves nothing.
#pragma once
#include <filesystem>
#include <string>

namespace glcast::run {

/// Each returns one clear line, or an empty string when all is well.

/// `file` (absolute) can be made or replaced; leaves nothing behind.
std::string check_output(const std::filesystem::path& file);

/// The loader will take a preload into `program`: it exists, may be run, is for this processor, is linked
/// dynamically and gains no privileges. A script is judged by its interpreter.
std::string check_program(const std::filesystem::path& program);

/// As execvp finds it: a name with a slash as it is, others along PATH. Empty when there is none.
std::filesystem::path find_program(const std::string& name);

/// libglcast.so: GLCAST_LIBRARY, else beside this program, in the build tree or in the library folder of the
/// install. Empty when there is none.
std::filesystem::path find_shim();

} // namespace glcast::run
