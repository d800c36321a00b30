// bench-reconstruct: each stage of the reconstruction from n = 128 to 2048, time and peak memory, the
// exponent of growth, and, where they were found when this was built, OpenVDB's volumeToMesh and VTK's flying
// edges given the same volume in the same run. Images are cast by rays beforehand; no GL, no files. Usage:
// bench-reconstruct [--sizes 128,256,400] [--body spheres|bracket] [--no-peers] The paper: 30 h and 2.2 GB
// for spheres at n = 400, simplification included.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "tests/bench/peers.h"
#include "tests/reconstruct/bodies.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast {
namespace {

const Box box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Megabytes, by Linux: what is resident now, and the most since `forget_peak`.
double resident(const char* field) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(field)) return std::stod(line.substr(std::strlen(field))) / 1024;
    return 0;
}
void forget_peak() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;
}

test::BodyPtr spheres() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    std::vector<test::BodyPtr> balls;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 centre(unit(random), unit(random), unit(random));
        balls.push_back(test::sphere(centre, 0.4 + 0.2 * unit(random)));
    }
    return test::unite(balls);
}

/// Edges, flat sides at all angles and hollows.
test::BodyPtr bracket() {
    using test::box, test::sphere, test::subtract, test::turned, test::unite;
    const glm::dmat3 turn = turned({0.3, 1, 0.2}, 25);
    const test::BodyPtr plates =
        unite({box({-0.1, 0, 0}, {0.7, 0.5, 0.12}, turn), box({-0.5, 0.1, 0.3}, {0.12, 0.45, 0.5}, turn),
               sphere({0.4, -0.2, 0}, 0.35)});
    return subtract(subtract(plates, sphere({0.45, -0.25, 0.3}, 0.28)), sphere({-0.5, 0.2, 0.5}, 0.3));
}

struct Measured {
    int n = 0;
    std::size_t triangles = 0;
    double carve = 0, contour = 0, attributes = 0, whole = 0, cpu = 0; ///< seconds
    double over_images = 0, in_all = 0, mesh = 0;                      ///< megabytes
};

/// The images as the reader hands them on: sparse, all layers. They are used up when there is one time.
Measured measure(HitBuilder& images, int n, SurfaceMethod method, int times) {
    Measured best{n, 0, 0, 0, 0, 1e9, 0, 0, 0, 0};
    for (int k = 0; k < times; ++k) {
        HitBuilder hits = times > 1 ? images : std::move(images);
        forget_peak();
        const double before = resident("VmRSS:"), start = now(), cpu = test::cpu_seconds();
        ReconstructReport report;
        ReconstructOptions options;
        options.method = method;
        options.complete_layers = true;
        const Mesh mesh = reconstruct(std::move(hits), box, options, &report);
        const double whole = now() - start;
        if (whole > best.whole) continue;
        const double bytes =
            double(mesh.positions.size() *
                       (sizeof mesh.positions[0] + sizeof mesh.normals[0] + sizeof mesh.colours[0]) +
                   mesh.triangles.size() * sizeof mesh.triangles[0]);
        best = {n,
                mesh.triangles.size(),
                report.carve_seconds,
                report.surface_seconds,
                report.attribute_seconds,
                whole,
                test::cpu_seconds() - cpu,
                resident("VmHWM:") - before,
                resident("VmHWM:"),
                bytes / 1048576};
    }
    return best;
}

void print(const char* what, const Measured& m) {
    std::printf("| %s | %d | %zu | %.3f | %.3f | %.3f | %.3f | %.3f | %.1f | %.0f | %.0f | %.0f |\n", what,
                m.n, m.triangles, m.carve, m.contour, m.attributes, m.whole, m.cpu,
                1e9 * (m.carve + m.contour) / std::pow(m.n, 3), m.over_images, m.mesh, m.in_all);
    std::fflush(stdout);
}

/// Least squares of log time over log n, from 512 on.
double exponent(const std::vector<Measured>& all, double Measured::*time) {
    double x = 0, y = 0, xx = 0, xy = 0, count = 0;
    for (const Measured& m : all) {
        if (m.n < 512) continue;
        const double u = std::log(m.n), v = std::log(m.*time);
        x += u, y += v, xx += u * u, xy += u * v, ++count;
    }
    return count < 2 ? 0 : (count * xy - x * y) / (count * xx - x * x);
}

/// 1 inside, 0 outside, x fastest: the samples that lie between first and last hit along all three axes.
std::vector<unsigned char> volume_of(const std::vector<ViewImage>& images, int n) {
    std::vector<unsigned char> volume(std::size_t(n) * n * n, 1);
    for (std::size_t k = 0; k < 6; k += 2) {
        const ImageAxes axes = image_axes(images[k].view.axis);
        std::array<std::size_t, 3> at{};
        for (at[2] = 0; at[2] < std::size_t(n); ++at[2])
            for (at[1] = 0; at[1] < std::size_t(n); ++at[1])
                for (at[0] = 0; at[0] < std::size_t(n); ++at[0]) {
                    const std::size_t pixel = at[std::size_t(axes.v)] * n + at[std::size_t(axes.u)];
                    const float depth = float((double(at[std::size_t(axes.depth)]) + 0.5) / n);
                    if (depth < images[k].depth[pixel] || depth > images[k + 1].depth[pixel])
                        volume[(at[2] * n + at[1]) * n + at[0]] = 0;
                }
    }
    return volume;
}

void run_peers(const std::vector<ViewImage>& images, int n) {
    if (test::peers().empty()) return;
    const std::vector<unsigned char> volume = volume_of(images, n);
    for (const test::Peer& peer : test::peers()) {
        const test::PeerResult result = peer.run(volume, n, [] { forget_peak(); });
        std::printf("| %s | %d | %zu | | %.3f | | %.3f | %.3f | %.1f | %.0f | | |\n", peer.name, n,
                    result.triangles, result.seconds, result.seconds, result.cpu_seconds,
                    1e9 * result.seconds / std::pow(n, 3), resident("VmHWM:") - result.resident_before);
        std::fflush(stdout);
    }
}

int run(const std::vector<int>& sizes, const std::string& body_name, bool peers) {
    const test::BodyPtr body = body_name == "bracket" ? bracket() : spheres();
    std::printf(
        "| %s | n | triangles | carve s | contour s | attributes s | whole s | CPU s | carve and contour, ns "
        "a cell | "
        "MB over the images | MB of it the mesh | MB in all "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        body_name.c_str());
    std::vector<Measured> all;
    for (const int n : sizes) {
        std::vector<ViewImage> images = test::cast_layers(*body, box, n);
        HitBuilder hits;
        for (ViewImage& image : images) {
            hits.add(image);
            if (n > 512) image = {};
        }
        all.push_back(measure(hits, n, SurfaceMethod::contour, n <= 512 ? 3 : 1));
        print("contour", all.back());
        if (n > 512) continue;
        print("cubes", measure(hits, n, SurfaceMethod::cubes, 1));
        std::erase_if(images, [](const ViewImage& image) { return image.view.layer > 0; });
        if (peers) run_peers(images, n);
    }
    std::printf(
        "\nExponent of growth from n = 512 on: carve %.2f, contour %.2f, attributes %.2f, whole %.2f\n",
        exponent(all, &Measured::carve), exponent(all, &Measured::contour),
        exponent(all, &Measured::attributes), exponent(all, &Measured::whole));
    return 0;
}

} // namespace
} // namespace glcast

int main(int count, char** arguments) {
    std::vector<int> sizes = {128, 256, 400, 512, 1024, 2048};
    std::string body = "spheres";
    bool peers = true;
    for (int k = 1; k < count; ++k) {
        const std::string option = arguments[k];
        if (option == "--no-peers") {
            peers = false;
        } else if (option == "--body" && k + 1 < count) {
            body = arguments[++k];
        } else if (option == "--sizes" && k + 1 < count) {
            sizes.clear();
            std::stringstream list(arguments[++k]);
            for (std::string n; std::getline(list, n, ',');) sizes.push_back(std::atoi(n.c_str()));
        } else {
            std::fprintf(stderr, "usage: %s [--sizes 128,256,400] [--body spheres|bracket] [--no-peers]\n",
                         arguments[0]);
            return 2;
        }
    }
    return glcast::run(sizes, body, peers);
}
