// The progressive mesh that a run of the pipeline writes beside its levels.
#pragma once
#include <filesystem>
#include <vector>

#include "tools/simplify/simplify.h"

namespace glcast {

/// Throws std::runtime_error unless `path` is one that write_pm can write: .glpm or .pm, in a place where a
/// file can be made.
void check_pm_output(const std::filesystem::path& path);

/// Levels as simplify_levels makes them, all of one run that goes on to 500 triangles or fewer; `log` has all
/// of it.
std::vector<Mesh> levels_of_one_run(const Mesh& full, std::vector<SimplifyTarget> targets, CollapseLog& log);

/// By extension: ours or OpenMesh's. Throws std::runtime_error.
void write_pm(const std::filesystem::path& path, const Mesh& full, const CollapseLog& log, double sample);

} // namespace glcast
