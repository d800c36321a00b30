// From a capture file to levels of detail, and to their files: all that happens behind a capture. Prints
// nothing.
//
// clang-format off
//     PipelineOptions how;
//     how.targets = {{.value = 2000}}; // triangles; without: levels for n/2, n/4, n/8, n/16 pixels
//     const MeshedCapture made = mesh_capture("gears.exr", "gears.glb", how);
//     for (std::size_t k = 0; k < made.levels.size(); ++k)
//         std::printf("%s: %zu triangles, 99.9 %% within %g samples\n", made.files[k].c_str(),
//                     made.checks[k].triangles, made.levels[k].error.p999 / made.sample);
// clang-format on
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/capture_file.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"
#include "tools/pipeline/max_error.h"
#include "tools/pipeline/textures.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/simplify/simplify.h"

namespace glcast {

struct PipelineOptions {
    ReconstructOptions surface; ///< complete_layers is what the capture says
    // Which levels: what is asked for here and nothing else. Nothing: those for default_pixels()
    // (sized_levels.h).
    std::vector<SimplifyTarget> targets; ///< with at most so many triangles or edges
    std::vector<ErrorLimit> max_error;   ///< the coarsest that are nowhere farther from the full surface
    std::vector<double>
        pixels;        ///< for an object drawn so wide on the screen: error_within() (sized_levels.h)
    bool full = false; ///< the full surface

    TextureChoice texture;                       ///< none with SurfaceMethod::cubes
    Compression compression = Compression::none; ///< .glb alone
    std::size_t units = millimetre;              ///< .stl, .3mf: what a unit of the model is, of length_units
    bool one_file = false;                       ///< WriteOptions::one_file
    std::filesystem::path progressive; ///< .glpm or .pm to write too; empty: none. Its levels are not fitted.
    CheckDepth check = CheckDepth::topology;
    /// Told what is being done, in a few words, each time that something else begins; "" at the end. Never
    /// from two threads at once.
    std::function<void(const std::string& what)> stage = {};
};

/// What of the options a level was made for.
struct Asked {
    std::string option; ///< "--triangles 2000"
    bool met = true; ///< the level keeps it; no where collapses leave no fewer triangles, or no smaller error
                     ///< was found
};

/// What came out, and everything there is to tell about it. Lengths in model units.
struct MeshedCapture {
    CaptureInfo info;
    double sample = 0; ///< distance of samples
    ReconstructReport surface;
    std::size_t full_triangles = 0; ///< of the full surface
    // Finest first; the vectors run in parallel. All levels are closed two-manifolds.
    std::vector<Level> levels; ///< measured: LevelError is true of what the files hold
    std::vector<MeshCheck> checks;
    std::vector<Asked> asked;
    std::vector<std::optional<TextureReport>> textures; ///< of those that have one
    std::vector<std::filesystem::path> files; ///< meshes (one, or one a level), then what belongs to them;
                                              ///< the progressive mesh is not among them
    std::vector<std::string> notes; ///< what is not as was asked, or as before: a line each, for the user
    std::size_t vertex_splits = 0;  ///< of the progressive mesh
    struct Seconds {
        double read = 0, surface = 0, simplify = 0, texture = 0, measure = 0, write = 0;
    } seconds;
};

/// Levels in memory. Throws std::runtime_error with one line for the user: a capture that cannot be read or
/// is empty, a target that is none.
MeshedCapture mesh_capture(const std::filesystem::path& capture, const PipelineOptions& options = {});

/// The same, then written to `output`, by its extension: all files of the run or none. What an earlier run
/// wrote there goes with its level 0: gears_LOD3.glb of that run too, where there are only three levels now.
/// Throws also where check_output() does, before anything is read.
MeshedCapture mesh_capture(const std::filesystem::path& capture, const std::filesystem::path& output,
                           const PipelineOptions& options = {});

/// Throws std::runtime_error unless files can be made there, in that format, with these options.
void check_output(const std::filesystem::path& output, const PipelineOptions& options);

} // namespace glcast
