// glcast render: a picture of a mesh, without X.
#include <memory>

#include "tools/cli/captured_views.h"
#include "tools/cli/command.h"
#include "tools/io/mesh_io.h"
#include "tools/render/render.h"

namespace glcast::cli {
namespace {

struct Options {
    std::string mesh, output, capture;
    int size = 256;
    bool json = false;
};

std::string caption(const CaptureInfo& info) {
    return "captured: frame " + std::to_string(info.frame) + " of " + info.program + ", " + std::to_string(info.n) +
           " samples along each axis";
}

int render(const Options& options) {
    if (std::filesystem::path(options.output).extension() != ".png")
        throw std::runtime_error("cannot write '" + options.output + "': name it .png");
    require_file(options.mesh);
    if (!options.capture.empty()) require_file(options.capture);
    require_writable(options.output);
    CapturedSix captured;
    if (!options.capture.empty()) captured = read_six_views(options.capture);
    const std::vector<Level> levels = read_all_levels(options.mesh);
    const CapturedViews beside{caption(captured.info), captured.views, captured.info.box};
    Picture sheet;
    {
        const Progress progress("drawing");
        sheet = contact_sheet(levels, options.size, options.capture.empty() ? nullptr : &beside);
    }
    write_png(options.output, sheet);
    if (options.json)
        print_json({{"file", options.output},
                    {"width", sheet.width},
                    {"height", sheet.height},
                    {"levels", levels.size()}});
    else
        say("wrote " + options.output + " (" + std::to_string(sheet.width) + " x " +
            std::to_string(sheet.height) + ")");
    return 0;
}

} // namespace

Run declare_render(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.add_option("mesh", options->mesh, "mesh: .glb, .obj, .ply, .off or .stl")->required();
    app.add_option("-o,--output", options->output, "picture to write (.png)")->required();
    app.add_option("--capture", options->capture, "capture (.exr) whose six views make a first row, in the same light and place");
    app.add_option("--size", options->size, "pixels per view")
        ->check(CLI::Range(16, 1024))
        ->capture_default_str();
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    return [options] { return render(*options); };
}

} // namespace glcast::cli
