#include "tools/pipeline/progressive_output.h"

#include <stdexcept>

#include "capture/output_file.h"
#include "tools/progressive/openmesh_pm.h"
#include "tools/progressive/stream.h"

namespace glcast {
namespace {

constexpr double base_triangles = 500; ///< of a progressive mesh, or fewer where a level has fewer

} // namespace

void check_pm_output(const std::filesystem::path& path) {
    if (path.extension() != ".glpm" && path.extension() != ".pm")
        throw std::runtime_error(
            "cannot write '" + path.string() +
            "': name a progressive mesh .glpm (everything) or .pm (OpenMesh's, geometry)");
    if (const std::string why = why_not_writable(path.string()); !why.empty()) throw std::runtime_error(why);
}

std::vector<Mesh> levels_of_one_run(const Mesh& full, std::vector<SimplifyTarget> targets, CollapseLog& log) {
    targets.push_back({SimplifyTarget::Unit::triangles, base_triangles});
    std::vector<Mesh> levels = simplify_levels(full, targets, {.refit = false}, &log);
    levels.pop_back();
    return levels;
}

void write_pm(const std::filesystem::path& path, const Mesh& full, const CollapseLog& log, double sample) {
    ProgressiveMesh mesh(full, log);
    OutputFile file(path.string());
    if (path.extension() == ".pm") {
        write_openmesh_pm(file, mesh);
    } else {
        ProgressiveInfo info;
        info.name = path.stem().string(), info.sample = sample;
        write_progressive(file, mesh, info);
    }
    if (!file.commit()) throw std::runtime_error(file.error());
}

} // namespace glcast
