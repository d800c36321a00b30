// Windows programs: what Wine wants of glcast-run.
#pragma once
#include <filesystem>
#include <string>

#include "tools/run/options.h"
#include "tools/run/process.h"

namespace glcast::run {

/// The command is Wine's, by its name.
bool is_wine(const Options& options);

/// "game.exe", of `wine c:/games/game.exe -window`; else the file name of the command.
std::string shown_program(const Options& options);

/// Wine's folder (WINEPREFIX, or ~/.wine), where it is yet to be made; else empty.
std::filesystem::path missing_prefix(const Options& options);

/// What makes it: `wine wineboot -i`, without questions and without us in it. `display`: of its X server;
/// empty: the user's.
Environment prefix_variables(const std::string& display);

/// With which wined3d draws Direct3D 8 and 9 by fixed functions, on any driver. What the user has set stays.
Environment direct3d_variables(const Options& options);

} // namespace glcast::run
