// glcast compare: how far two meshes are apart, and what each of them is.
#include <algorithm>
#include <cstdio>
#include <glm/common.hpp>
#include <memory>

#include "tools/cli/command.h"
#include "tools/deviation/deviation.h"
#include "tools/io/mesh_io.h"
#include "tools/words/text.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string a, b;
    std::size_t level_a = 0, level_b = 0;
    double sample = 0;
    int n = 0;
    std::size_t points = DeviationOptions{}.samples;
    bool all_points = false, json = false;
};

/// Samples of margin that a capture leaves round the object, both sides together (design: 2 and 2).
constexpr int margin = 4;

struct Side {
    Level level;
    MeshCheck check;
};

Side read_side(const std::string& file, std::size_t wanted) {
    std::vector<Level> levels = read_all_levels(file);
    if (wanted >= levels.size())
        throw std::runtime_error("'" + file + "' has " + std::to_string(levels.size()) +
                                 " level(s), no level " + std::to_string(wanted));
    Side side{std::move(levels[wanted]), {}};
    side.check = check_mesh(side.level.mesh);
    return side;
}

double longest_side(const Mesh& mesh) {
    glm::dvec3 lo = mesh.positions.at(0), hi = lo;
    for (const glm::dvec3& p : mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
}

/// Model units per sample, as far as it is known; 0 when not.
double sample_size(const Options& options, const Side& a, const Side& b) {
    if (options.sample > 0) return options.sample;
    if (options.n > 0) return longest_side(a.level.mesh) / (options.n - margin);
    return b.level.sample > 0 ? b.level.sample : a.level.sample;
}

Json lengths(const DistanceStats& s, double unit) {
    return {{"mean", s.mean / unit}, {"rms", s.rms / unit}, {"p999", s.p999 / unit}, {"max", s.max / unit}};
}

Json direction(const DistanceStats& s, double sample, double diagonal) {
    Json json = {{"units", lengths(s, 1)}};
    if (sample > 0) json["samples"] = lengths(s, sample);
    json["percentOfDiagonal"] = lengths(s, diagonal / 100);
    json["normalMeanDegrees"] = s.normal_mean_degrees;
    json["points"] = s.points;
    json["hidden"] = s.hidden;
    return json;
}

void print_direction(const char* name, const DistanceStats& s, double sample, double diagonal) {
    std::printf("%s  %zu points measured, %zu hidden ones left out\n", name, s.points, s.hidden);
    const auto row = [](const char* unit, const DistanceStats& d, double by) {
        std::printf("  %-14s mean %-11.6g RMS %-11.6g 99.9 %% %-11.6g max %.6g\n", unit, d.mean / by,
                    d.rms / by, d.p999 / by, d.max / by);
    };
    row("units", s, 1);
    if (sample > 0) row("samples", s, sample);
    row("% of diagonal", s, diagonal / 100);
    std::printf("  normals        mean %.4g degrees apart\n", s.normal_mean_degrees);
}

void print_side(const char* name, const std::string& file, const MeshCheck& c) {
    std::printf("%s  %s: %s\n", name, printable(file).c_str(), summary(c).c_str());
    std::printf("   volume %.6g, Euler characteristic %ld, %zu component(s), %zu boundary and %zu "
                "non-manifold edges\n",
                c.volume, c.euler, c.components, c.boundary_edges, c.non_manifold_edges);
}

int compare(const Options& options) {
    for (const std::string& file : {options.a, options.b}) require_file(file);
    const Side a = read_side(options.a, options.level_a), b = read_side(options.b, options.level_b);
    for (const Side* side : {&a, &b}) require_measurable(side->level.mesh, side->check);
    const double sample = sample_size(options, a, b);
    DeviationOptions how;
    how.samples = options.points;
    how.visible_only = !options.all_points;
    Deviation d;
    {
        const Progress progress("measuring");
        d = deviation(a.level.mesh, b.level.mesh, how);
    }
    if (options.json) {
        Json json = {{"a", {{"file", options.a}}}, {"b", {{"file", options.b}}}, {"diagonalA", d.diagonal_a}};
        json["a"].update(to_json(a.check));
        json["b"].update(to_json(b.check));
        if (sample > 0) json["sample"] = sample;
        json["aToB"] = direction(d.a_to_b, sample, d.diagonal_a);
        json["bToA"] = direction(d.b_to_a, sample, d.diagonal_a);
        print_json(json);
        return 0;
    }
    print_side("A", options.a, a.check);
    print_side("B", options.b, b.check);
    print_direction("A to B", d.a_to_b, sample, d.diagonal_a);
    print_direction("B to A", d.b_to_a, sample, d.diagonal_a);
    return 0;
}

} // namespace

Run declare_compare(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.footer(
        R"(Points that nobody can see from outside (no free ray in 200 directions) are left out and counted.
Samples: as told by --sample or --n, else as written in a .glb of glcast.)");
    app.add_option("a", options->a, "mesh: .glb, .obj, .ply, .off or .stl; the original, say")->required();
    app.add_option("b", options->b, "mesh: the cast, say")->required();
    auto* sample = app.add_option("--sample", options->sample, "length of a sample, model units");
    auto* n = app.add_option("--n", options->n,
                             "resolution of the cast of A: samples are A's longest side / (N - 4)");
    sample->check(CLI::PositiveNumber)->excludes(n);
    n->check(CLI::Range(8, 8192));
    app.add_option("--level-a", options->level_a, "level of A")->capture_default_str();
    app.add_option("--level-b", options->level_b, "level of B")->capture_default_str();
    app.add_option("--points", options->points, "points per direction, beside all vertices and face centres")
        ->check(CLI::Range(0, 1'000'000'000))
        ->capture_default_str();
    app.add_flag("--all-points", options->all_points, "measure hidden points too");
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    return [options] { return compare(*options); };
}

} // namespace glcast::cli
