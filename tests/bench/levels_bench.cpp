// bench-levels: how far levels are from the surface, each way by itself, and what shape they are in: the largest
// distance at every count where few triangles are left, and the mean. Not a test. Usage:
//   bench-levels (--shape teapot --n 128 | --mesh FULL.glb --sample LENGTH) [--from 4 --to 200 | --counts 10000,2000]
//                [--collapsed] [--points 100000]
// A shape is drawn by OSMesa, captured and reconstructed here; FULL.glb is what glcast mesh wrote, its first level
// the full surface. Distances are in samples. One run of collapses makes all levels.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>

#include "fixtures/shapes.h"
#include "tests/mesh/both_ways.h"
#include "tests/paper/cast.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"
#include "tools/simplify/simplify.h"

namespace glcast {
namespace {

struct Options {
    std::string shape, mesh;
    int n = 128;
    double sample = 0;
    std::size_t from = 4, to = 200, points = 100'000;
    std::vector<std::size_t> counts;
    bool collapsed = false;
};

Level surface_of(const Options& options) {
    if (!options.mesh.empty()) {
        Level level = std::move(read_levels(options.mesh).front());
        if (options.sample > 0) level.sample = options.sample;
        if (!(level.sample > 0)) throw std::runtime_error(options.mesh + ": give --sample");
        return level;
    }
    const paper::Capture capture = paper::capture_mesh(fixtures::truth(options.shape), options.n);
    return {paper::reconstruct_capture(capture, SurfaceMethod::contour).mesh, options.shape, {},
            capture.box.size / capture.n, {}};
}

void run(Options options) {
    const Level full = surface_of(options);
    if (options.counts.empty())
        for (std::size_t count = options.from; count <= options.to; ++count)
            if (count % 2 == 0) options.counts.push_back(count); // a closed surface has no others
    std::vector<SimplifyTarget> targets;
    for (const std::size_t count : options.counts)
        targets.push_back({SimplifyTarget::Unit::triangles, double(count)});
    const std::vector<Mesh> levels = simplify_levels(full.mesh, targets, {.refit = !options.collapsed});
    const test::BothWaysMeter meter(full.mesh, options.points);
    const double volume = check_mesh(full.mesh).volume;
    std::printf("| asked | triangles | mean there | mean back | most there | most back | volume | crossings | folds | "
                "slivers |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const test::BothWays d = meter.measure(levels[k]);
        const test::Faults faults = test::faults_of(levels[k]);
        std::printf("| %zu | %zu | %.4f | %.4f | %.2f | %.2f | %.3f | %zu | %zu | %zu |\n", options.counts[k],
                    levels[k].triangles.size(), d.there.mean / full.sample, d.back.mean / full.sample,
                    d.there.most / full.sample, d.back.most / full.sample, check_mesh(levels[k]).volume / volume,
                    faults.crossings, faults.folds, faults.slivers);
        std::fflush(stdout);
    }
}

} // namespace
} // namespace glcast

int main(int count, char** arguments) {
    glcast::Options options;
    CLI::App app("Largest and mean distances of levels, both ways.");
    app.add_option("--shape", options.shape, "of the fixtures");
    app.add_option("--n", options.n);
    app.add_option("--mesh", options.mesh, "instead of a shape");
    app.add_option("--sample", options.sample, "its sample, where the file does not say");
    app.add_option("--from", options.from);
    app.add_option("--to", options.to);
    app.add_option("--counts", options.counts)->delimiter(',');
    app.add_option("--points", options.points);
    app.add_flag("--collapsed", options.collapsed, "without the fit");
    CLI11_PARSE(app, count, arguments);
    try {
        glcast::run(options);
    } catch (const std::exception& error) {
        std::cerr << "bench-levels: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
