// Programs of Windows, in whose processes Wine runs.
#pragma once
#include <string>

namespace glcast::preload {

/// This process runs Wine's loader.
bool is_wine();

/// "game.exe": Wine writes the Windows command line over the arguments that the process began with.
std::string windows_program();

/// A process that Wine starts for itself, and that shows nothing of the program.
bool is_wine_helper();

} // namespace glcast::preload
