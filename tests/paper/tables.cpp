#include "tests/paper/tables.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>

#include "tests/paper/originals.h"
#include "tools/mesh/check.h"

namespace glcast::paper {
namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Original {
    const Mesh& mesh;
    PaperPoints points;
};

Row measured(const std::string& name, const Mesh& mesh, double make_seconds, const Original& original,
             const std::vector<double>& edges, const TableOptions& options) {
    Row row{name, mesh.triangles.size(), paper_error(original.points, mesh), {}, make_seconds, 0, 0};
    std::vector<SimplifyTarget> targets;
    for (const double count : edges) targets.push_back({SimplifyTarget::Unit::edges, count});
    forget_peak_memory();
    const double start = now();
    const auto levels =
        simplify_levels(mesh, targets, {.allow_boundaries = true, .refit = options.levels == Levels::fitted});
    row.simplify_seconds = now() - start;
    row.peak_megabytes = peak_megabytes();
    for (const Mesh& level : levels) {
        Cell cell{check_mesh(level).edges, paper_error(original.points, level), 0};
        if (options.symmetric) {
            DeviationOptions how;
            how.samples = 50'000;
            const Deviation d = deviation(original.mesh, level, how);
            cell.symmetric = std::max(d.a_to_b.mean, d.b_to_a.mean);
        }
        row.cells.push_back(cell);
    }
    return row;
}

void add_casts(Table& table, const Mesh& drawn, int n, const Original& original,
               const TableOptions& options) {
    const Capture capture = capture_mesh(drawn, n);
    const auto add = [&](const std::string& name, SurfaceMethod method, Views views) {
        const Cast cast = reconstruct_capture(capture, method, views);
        table.rows.push_back(measured(name + " " + std::to_string(n), cast.mesh,
                                      capture.seconds + cast.seconds, original, table.edges, options));
    };
    add("contour", SurfaceMethod::contour, Views::all_layers);
    if (options.six_views) add("contour, six views,", SurfaceMethod::contour, Views::six);
    if (options.cubes) add("cubes", SurfaceMethod::cubes, Views::six);
}

Table begin(const Original& original, std::vector<double> edges) {
    return {std::move(edges),
            check_mesh(original.mesh).edges,
            original.points.seen.size(),
            original.points.hidden,
            {}};
}

} // namespace

const Row& Table::row(const std::string& name) const {
    for (const Row& row : rows)
        if (row.name == name) return row;
    throw std::out_of_range("no row " + name);
}

Table table_one(bool fine, const TableOptions& options) {
    const Mesh teapot_mesh = fine ? teapot(16) : teapot(3, true);
    const Original original{teapot_mesh, paper_points(teapot_mesh)};
    Table table = begin(original, {782, 500, 250, 100});
    table.rows.push_back(measured("original", teapot_mesh, 0, original, table.edges, options));
    for (const int n : {160, 40}) add_casts(table, teapot_mesh, n, original, options);
    return table;
}

Table table_two(const TableOptions& options) {
    const double start = now();
    const Mesh solid = spheres_union(1);
    const double seconds = now() - start;
    const Original original{solid, paper_points(solid)};
    Table table = begin(original, {5000, 500, 250, 100});
    table.rows.push_back(measured("union", solid, seconds, original, table.edges, options));
    add_casts(table, spheres(1), 400, original, options);
    return table;
}

double peak_megabytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
    return 0;
}

void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

} // namespace glcast::paper
