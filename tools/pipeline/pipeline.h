// From a capture file to levels of detail, and to their files: all that happens behind a capture. Prints
// nothing.
//
//     PipelineOptions how;
//     how.targets = {{SimplifyTarget::Unit::triangles, 2000}};
//     const MeshedCapture made = mesh_capture("gears.exr", "gears.glb", how);
//     for (std::size_t k = 0; k < made.levels.size(); ++k)
//         std::printf("%zu triangles, 99.9 %% within %g samples\n", made.checks[k].triangles,
//                     made.levels[k].error.p999 / made.sample);
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "capture/capture_file.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"
#include "tools/pipeline/max_error.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/simplify/simplify.h"
#include "tools/texture/bake.h"

namespace glcast {

struct PipelineOptions {
    ReconstructOptions surface; ///< complete_layers is what the capture says
    // Levels: by count or by error. None of either: those of default.
    std::vector<SimplifyTarget> targets;
    std::vector<ErrorLimit> max_error;
    int texture = 0;                             ///< texels along an edge of each level's atlas; 0: none
    Compression compression = Compression::none; ///< .glb alone
    std::size_t units = millimetre; ///< .stl, .3mf: what a unit of the model is, of length_units
    bool split = false;                          ///< WriteOptions::split
    std::filesystem::path progressive; ///< .glpm or .pm to write too; empty: none. Its levels are not fitted.
    CheckDepth check = CheckDepth::topology;
    /// Told what is being done, in a few words, each time that something else begins; "" at the end. Never
    /// from two threads at once.
    std::function<void(const std::string& what)> stage = {};
};

/// What came out, and everything there is to tell about it. Lengths in model units.
struct MeshedCapture {
    CaptureInfo info;
    double sample = 0; ///< distance of samples
    ReconstructReport surface;
    // Finest first; the vectors run in parallel. All levels are closed two-manifolds.
    std::vector<Level> levels; ///< measured: LevelError is true of what the files hold
    std::vector<MeshCheck> checks;
    std::vector<TextureReport> textures; ///< empty where there are no textures
    std::vector<std::filesystem::path>
        files; ///< meshes, then what belongs to them; the progressive mesh is not among them
    std::size_t vertex_splits = 0; ///< of the progressive mesh
    struct Seconds {
        double read = 0, surface = 0, simplify = 0, texture = 0, measure = 0, write = 0;
    } seconds;
};

/// Levels in memory, as a .glb would hold them. Throws std::runtime_error with one line for the user: a
/// capture that cannot be read or is empty, a target that is none, an atlas too small.
MeshedCapture mesh_capture(const std::filesystem::path& capture, const PipelineOptions& options = {});

/// The same, then written to `output`, by its extension: all files of the run or none. Throws also where
/// check_output() does, before anything is read.
MeshedCapture mesh_capture(const std::filesystem::path& capture, const std::filesystem::path& output,
                           const PipelineOptions& options = {});

/// Throws std::runtime_error unless files can be made there, in that format, with these options.
void check_output(const std::filesystem::path& output, const PipelineOptions& options);

} // namespace glcast
