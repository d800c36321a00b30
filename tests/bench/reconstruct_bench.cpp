// bench-reconstruct: carve and contour of eight intersecting spheres (the paper: 30 h and 2.2 GB at n = 400).
// Images are cast beforehand. `over_images_MB` is the growth of the peak of resident memory while
// reconstructing: it only means something for the first size run, so give one: --benchmark_filter=/400
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <map>

#include "tests/reconstruct/bodies.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast {
namespace {

const Box box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};

const std::vector<ViewImage>& spheres(int n) {
    static std::map<int, std::vector<ViewImage>> made;
    if (made.contains(n)) return made[n];
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    std::vector<test::BodyPtr> balls;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 centre(unit(random), unit(random), unit(random));
        balls.push_back(test::sphere(centre, 0.4 + 0.2 * unit(random)));
    }
    made.clear();
    return made[n] = test::cast_body(*test::unite(balls), box, n);
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

void reconstruct_spheres(benchmark::State& state, SurfaceMethod method) {
    const auto& images = spheres(int(state.range(0)));
    const double before = peak_megabytes();
    ReconstructReport report;
    ReconstructOptions options;
    options.method = method;
    std::size_t triangles = 0;
    for (auto _ : state) {
        const Mesh mesh = reconstruct(images, box, options, &report);
        triangles = mesh.triangles.size();
        benchmark::DoNotOptimize(mesh.positions.data());
    }
    state.counters["carve_s"] = report.carve_seconds;
    state.counters["surface_s"] = report.surface_seconds;
    state.counters["attributes_s"] = report.attribute_seconds;
    state.counters["triangles"] = double(triangles);
    state.counters["over_images_MB"] = peak_megabytes() - before;
}

BENCHMARK_CAPTURE(reconstruct_spheres, contour, SurfaceMethod::contour)
    ->Arg(128)
    ->Arg(256)
    ->Arg(400)
    ->Arg(512)
    ->Arg(1024)
    ->Arg(2048)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(reconstruct_spheres, cubes, SurfaceMethod::cubes)
    ->Arg(128)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace
} // namespace glcast

BENCHMARK_MAIN();
