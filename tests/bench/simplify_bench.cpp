// bench-simplify: collapses on one core beside OpenMesh, CGAL and meshoptimizer in the same run: CPU time,
// and the mean and largest distance from the full mesh, both ways, the larger. The meshes are casts of eight
// spheres and of a teapot, made here; no GL, no files. Usage: bench-simplify [--triangles 1000000] [--to
// 100000,10000] [--body spheres|teapot|both] [--threads 1] [--no-peers]
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "tests/bench/peers.h"
#include "tests/paper/originals.h"
#include "tests/peers/simplify_peers.h"
#include "tests/reconstruct/bodies.h"
#include "tests/reconstruct/mesh_layers.h"
#include "tools/deviation/deviation.h"
#include "tools/mesh/check.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/simplify/simplify.h"

namespace glcast {
namespace {

struct Options {
    double triangles = 1e6;
    std::vector<std::size_t> to = {100'000};
    std::string body = "both";
    int threads = 1;
    bool peers = true;
};

test::BodyPtr spheres() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    std::vector<test::BodyPtr> balls;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 centre(unit(random), unit(random), unit(random));
        const double radius = 0.4 + 0.2 * unit(random);
        balls.push_back(
            test::sphere(centre, radius, i % 2 ? glm::vec3(0.8F, 0.2F, 0.1F) : glm::vec3(0.1F, 0.3F, 0.9F)));
    }
    return test::unite(balls);
}

Mesh cast_spheres(int n) {
    const Box box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};
    ReconstructOptions options;
    options.complete_layers = true;
    return reconstruct(test::cast_layers(*spheres(), box, n), box, options);
}

Mesh cast_teapot(int n) {
    const Mesh teapot = paper::teapot(12);
    const Box box = test::box_around(teapot, n);
    ReconstructOptions options;
    options.complete_layers = true;
    return reconstruct(test::cast_mesh(teapot, box, n), box, options);
}

/// Of about so many triangles: their number grows with the square of n.
template <typename Make> Mesh cast_of_size(double triangles, int try_at, const Make& make) {
    const double there = double(make(try_at).triangles.size());
    return make(int(std::lround(try_at * std::sqrt(triangles / there))));
}

void print_row(const char* name, const Mesh& full, const Mesh& level, double cpu, double wall) {
    DeviationOptions how;
    how.visible_only = false;
    const Deviation d = deviation(full, level, how);
    const bool manifold = check_mesh(level).closed_manifold();
    std::printf("| %s | %zu | %.2f | %.2f | %.3e | %.3e | %.3e | %s |\n", name, level.triangles.size(), cpu,
                wall, std::max(d.a_to_b.mean, d.b_to_a.mean), std::max(d.a_to_b.rms, d.b_to_a.rms),
                std::max(d.a_to_b.max, d.b_to_a.max), manifold ? "yes" : "no");
    std::fflush(stdout);
}

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void run_ours(const char* name, const Mesh& mesh, const Options& options, const SimplifyOptions& how) {
    std::vector<SimplifyTarget> targets;
    for (const std::size_t t : options.to) targets.push_back({SimplifyTarget::Unit::triangles, double(t)});
    std::vector<Mesh> levels;
    double cpu = 0, wall = 0;
    {
        const tbb::global_control cores(tbb::global_control::max_allowed_parallelism,
                                        std::size_t(options.threads));
        cpu = test::cpu_seconds(), wall = now();
        levels = simplify_levels(mesh, targets, how);
        cpu = test::cpu_seconds() - cpu, wall = now() - wall;
    }
    for (const Mesh& level : levels) print_row(name, mesh, level, cpu, wall);
}

void run_body(const char* name, const Mesh& mesh, const Options& options) {
    std::printf("\n%s, %zu triangles%s\n\n| | triangles | CPU s | wall s | mean error | RMS | max | closed "
                "manifold |\n"
                "|---|---|---|---|---|---|---|---|\n",
                name, mesh.triangles.size(),
                options.to.size() > 1 ? " (ours: the time of all levels together)" : "");
    run_ours("glcast, all it does", mesh, options, {});
    run_ours("glcast, positions alone", mesh, options,
             {.refit = false, .colour_weight = 0, .normal_weight = 0});
    if (!options.peers) return;
    for (const test::SimplifyPeer& peer : test::simplify_peers())
        for (const std::size_t to : options.to) {
            const double start = now();
            const test::SimplifyPeerResult result = peer.run(mesh, to);
            print_row(peer.name, mesh, result.mesh, result.cpu_seconds, now() - start);
        }
}

int run(const Options& options) {
    if (options.body != "teapot")
        run_body("spheres", cast_of_size(options.triangles, 64, cast_spheres), options);
    if (options.body != "spheres")
        run_body("teapot", cast_of_size(options.triangles, 96, cast_teapot), options);
    return 0;
}

} // namespace
} // namespace glcast

int main(int count, char** arguments) {
    glcast::Options options;
    for (int k = 1; k < count; ++k) {
        const std::string option = arguments[k], value = k + 1 < count ? arguments[k + 1] : "";
        if (option == "--no-peers") {
            options.peers = false;
            continue;
        }
        ++k;
        if (option == "--triangles") {
            options.triangles = std::atof(value.c_str());
        } else if (option == "--body") {
            options.body = value;
        } else if (option == "--threads") {
            options.threads = std::atoi(value.c_str());
        } else if (option == "--to") {
            options.to.clear();
            std::stringstream list(value);
            for (std::string t; std::getline(list, t, ',');)
                options.to.push_back(std::size_t(std::atol(t.c_str())));
        } else {
            std::fprintf(stderr,
                         "usage: %s [--triangles 1000000] [--to 100000,10000] [--body spheres|teapot|both] "
                         "[--threads 1] [--no-peers]\n",
                         arguments[0]);
            return 2;
        }
    }
    return glcast::run(options);
}
