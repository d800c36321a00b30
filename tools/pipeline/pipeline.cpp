#include "tools/pipeline/pipeline.h"

#include <stdexcept>

#include "capture/output_file.h"
#include "tools/io/mesh_endings.h"
#include "tools/pipeline/progressive_output.h"
#include "tools/pipeline/run.h"

namespace glcast {

void check_output(const std::filesystem::path& output, const PipelineOptions& options) {
    if (!has_mesh_ending(output))
        throw std::runtime_error("cannot write '" + output.string() + "': name it " + listed_mesh_endings());
    if (output.extension() != ".glb" && (options.one_file || options.compression != Compression::none))
        throw std::runtime_error("--compress and --levels one-file are for .glb alone: name the output .glb");
    if (const std::string why = why_not_writable(output.string()); !why.empty())
        throw std::runtime_error(why);
    if (!options.progressive.empty()) check_pm_output(options.progressive);
}

MeshedCapture mesh_capture(const std::filesystem::path& capture, const PipelineOptions& options) {
    Run run(options, capture);
    run.make_surface(capture);
    run.make_levels();
    run.make_textures();
    run.measure();
    return run.take();
}

MeshedCapture mesh_capture(const std::filesystem::path& capture, const std::filesystem::path& output,
                           const PipelineOptions& options) {
    check_output(output, options);
    Run run(options, output);
    run.make_surface(capture);
    run.make_levels();
    run.make_textures();
    run.measure();
    run.write(output);
    return run.take();
}

} // namespace glcast
