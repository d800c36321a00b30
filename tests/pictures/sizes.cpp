// What the default levels look like at their own sizes: rows of docs/measured/levels.md. See make-table.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tests/pictures/own_size.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

namespace glcast::pictures {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string name, capture, full, levels, json;
};

Json row_of(const std::string& name, const Level& level, const OwnSize& size, bool finest) {
    const MeshCheck check = check_mesh(level.mesh, CheckDepth::everything);
    const bool right = looks_right(size, finest);
    std::fprintf(stderr, "%-12s %4d pixels %7zu triangles: %.2f dB, full surface %.2f: %s; %s\n",
                 name.c_str(), size.pixels, check.triangles, size.level.psnr, size.full.psnr,
                 right ? "right" : "NOT right", describe(check).c_str());
    return {{"program", name},
            {"pixels", size.pixels},
            {"triangles", check.triangles},
            {"texture", level.texture.colour.width},
            {"p999Samples", level.sample > 0 ? level.error.p999 / level.sample : 0},
            {"psnr", size.level.psnr},
            {"psnrWorstView", size.level.psnr_worst},
            {"ssim", size.level.ssim},
            {"psnrOutline", size.psnr_outline},
            {"psnrFilling", size.psnr_filling},
            {"fullPsnr", size.full.psnr},
            {"fullSsim", size.full.ssim},
            {"right", right},
            {"closedManifold", check.closed_manifold()},
            {"selfIntersections", check.self_intersections.value_or(0)}};
}

void run(const Options& options) {
    const std::vector<ReferenceView> views = read_references(options.capture);
    const Level full = std::move(read_levels(options.full).front());
    const std::vector<Level> levels = read_all_levels(options.levels);
    const std::vector<OwnSize> sizes = own_sizes(levels, full, views);
    Json rows = Json::array();
    for (std::size_t k = 0; k < levels.size(); ++k)
        rows.push_back(row_of(options.name, levels[k], sizes[k], k == 0));
    std::ofstream(options.json) << rows.dump(1) << '\n';
}

} // namespace
} // namespace glcast::pictures

int main(int count, char** arguments) {
    glcast::pictures::Options options;
    CLI::App app("What default levels look like at their own sizes, against what the program drew.");
    app.add_option("--name", options.name)->required();
    app.add_option("--capture", options.capture, "made with GLCAST_REFERENCE_VIEWS")->required();
    app.add_option("--full", options.full, "mesh of the full surface")->required();
    app.add_option("--levels", options.levels, "mesh with default levels, those beside it too")->required();
    app.add_option("--json", options.json, "rows to write")->required();
    CLI11_PARSE(app, count, arguments);
    try {
        glcast::pictures::run(options);
    } catch (const std::exception& error) {
        std::cerr << "picture-sizes: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
