#include "tools/pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>
#include <stdexcept>

#include "capture/output_file.h"
#include "tools/deviation/level_error.h"
#include "tools/io/mesh_endings.h"
#include "tools/io/capture_reader.h"
#include "tools/pipeline/progressive_output.h"
#include "tools/pipeline/textures.h"
#include "tools/reconstruct/captured_surface.h"
#include "tools/texture/outline.h"
#include "tools/texture/wedge_fit.h"

namespace glcast {
namespace {

using Unit = SimplifyTarget::Unit;

constexpr double default_ratios[] = {0.1, 0.01};
constexpr double fewest_by_default = 500; // triangles: fewer and most things lose their shape

struct Stopwatch {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

bool is_glb(const std::filesystem::path& file) { return file.extension() == ".glb"; }

std::vector<SimplifyTarget> default_targets(std::size_t triangles) {
    std::vector<SimplifyTarget> targets;
    double last = double(triangles);
    for (double ratio : default_ratios) {
        const double wanted = std::max(double(triangles) * ratio, fewest_by_default);
        if (wanted > last / 2) break; // hardly a level of its own
        targets.push_back({Unit::triangles, std::floor(wanted)});
        last = wanted;
    }
    return targets;
}

/// Does the full surface meet the target as it is?
bool met(const SimplifyTarget& target, const MeshCheck& full) {
    switch (target.unit) {
    case Unit::edges:
        return double(full.edges) <= target.value;
    case Unit::triangles:
        return double(full.triangles) <= target.value;
    default:
        return target.value >= 1;
    }
}

void require_manifold(const MeshCheck& check, const std::string& what) {
    if (!check.closed_manifold())
        throw std::runtime_error(what + " is not closed: " + describe(check) + "; nothing was written");
}

/// One run, step by step.
class Run {
  public:
    Run(const PipelineOptions& options, bool one_file) : options(options), one_file(one_file) {}

    void make_surface(const std::filesystem::path& capture);
    void make_levels();
    void lay_outlines();
    void fit_corners();
    void bake_textures();
    void measure();
    void measure_and_write(const std::filesystem::path& output);
    MeshedCapture take() {
        stage("");
        return std::move(made);
    }

  private:
    void stage(const std::string& what) const {
        if (options.stage) options.stage(what);
    }
    const Mesh& full() const { return made.levels[0].mesh; }
    std::vector<SimplifyTarget> targets();
    void write(const std::filesystem::path& output, const std::function<void()>& await_errors = {});

    const PipelineOptions& options;
    const bool one_file;
    bool keep_full = true; ///< .glb holds it always, the others when no target was given
    MeshedCapture made;    ///< levels[0]: the full surface, until write() leaves it out
    CapturedSurface captured;
    CollapseLog log; ///< for a progressive mesh: of the run that made the levels
};

void Run::make_surface(const std::filesystem::path& capture) {
    HitBuilder hits;
    stage("reading " + capture.string());
    Stopwatch watch;
    made.info = read_capture(capture, [&](ViewImage&& image) { hits.add(image); });
    made.seconds.read = watch.seconds();
    stage("making the surface");
    watch = {};
    made.sample = made.info.box.size / made.info.n;
    ReconstructOptions how = options.surface;
    how.complete_layers = made.info.layers == Layers::complete;
    made.levels.push_back({reconstruct(std::move(hits), made.info.box, how, &made.surface, &captured),
                           "level 0",
                           {},
                           made.sample,
                           {}});
    made.checks.push_back(check_mesh(full(), options.check));
    made.seconds.surface = watch.seconds();
    require_manifold(made.checks[0], "the surface");
}

/// Finest first.
std::vector<SimplifyTarget> Run::targets() {
    std::vector<SimplifyTarget> wanted = options.targets;
    for (const ErrorLimit& limit : options.max_error)
        wanted.push_back(coarsest_within(made.levels[0], limit.in_units(made.levels[0]),
                                         {.refit = options.progressive.empty()}));
    std::sort(wanted.begin(), wanted.end(), [](const auto& a, const auto& b) { return a.value > b.value; });
    keep_full = one_file || wanted.empty();
    if (wanted.empty() && one_file) wanted = default_targets(full().triangles.size());
    if (one_file) std::erase_if(wanted, [&](const auto& target) { return met(target, made.checks[0]); });
    return wanted;
}

/// The full surface first, then the targets.
void Run::make_levels() {
    stage("simplifying");
    const Stopwatch watch;
    const std::vector<SimplifyTarget> wanted = targets();
    std::vector<Mesh> simplified = options.progressive.empty()
                                       ? simplify_levels(full(), wanted, {.checked = &made.checks[0]})
                                       : levels_of_one_run(full(), wanted, log);
    for (Mesh& mesh : simplified) {
        const std::string name = "level " + std::to_string(made.levels.size());
        made.checks.push_back(check_mesh(mesh, options.check));
        require_manifold(made.checks.back(), name);
        made.levels.push_back({std::move(mesh), name, {}, made.sample, {}});
    }
    made.seconds.simplify = watch.seconds();
}

/// Outlines are most of what differs where textures hide the rest; elsewhere only levels that come to lie no farther
/// from the surface keep it. Not levels of a progressive mesh, nor textured ones that a limit binds.
void Run::lay_outlines() {
    if (!options.progressive.empty() || made.levels.size() < 2) return;
    const Stopwatch watch;
    const bool freely = options.texture && options.max_error.empty();
    std::optional<LevelMeter> meter;
    for (std::size_t k = 1; k < made.levels.size(); ++k) {
        Level laid = made.levels[k];
        if (!fit_outlines(laid.mesh, captured)) continue;
        if (!freely) {
            if (!meter) meter.emplace(made.levels[0]);
            const LevelError before = meter->measure(made.levels[k]), after = meter->measure(laid);
            if (after.p999 > before.p999 || after.max > before.max) continue;
        }
        made.levels[k].mesh = std::move(laid.mesh);
        made.checks[k] = check_mesh(made.levels[k].mesh, options.check);
    }
    made.seconds.simplify += watch.seconds();
}

/// Normals and colours of all but the full surface, and not of what a progressive mesh holds.
void Run::fit_corners() {
    if (!options.progressive.empty()) return;
    const Stopwatch watch;
    WedgeOptions how;
    if (options.texture) how.colour = WedgeOptions::any_colour; // the texture has them
    for (std::size_t k = 1; k < made.levels.size(); ++k) fit_wedges(made.levels[k], captured, how);
    made.seconds.simplify += watch.seconds();
}

void Run::bake_textures() {
    if (!options.texture) return;
    stage("baking textures");
    const Stopwatch watch;
    const std::size_t first = keep_full ? 0 : 1;
    made.textures = texture_levels(std::span(made.levels).subspan(first), captured, options.texture);
    captured = {}; // it is large
    made.seconds.texture = watch.seconds();
}

/// Against the full surface; where the file will hold rounded levels, these, and level 0 too.
void Run::measure() {
    const Stopwatch watch;
    made.levels[0].error.unsupported_area_share = made.surface.unsupported_area_share;
    if (!options.surface.geometric_normals)
        made.levels[0].error.disagreeing_normals_share = made.surface.disagreeing_normals_share;
    std::optional<Level> exact;
    if (options.compression != Compression::none) {
        exact = made.levels[0];
        round_levels(made.levels, options.compression);
        for (std::size_t k = 0; k < made.levels.size(); ++k)
            made.checks[k] = check_mesh(made.levels[k].mesh, options.check);
    }
    const std::size_t first = exact ? 0 : 1;
    if (first < made.levels.size()) {
        const LevelMeter meter(exact ? *exact : made.levels[0]);
        for (std::size_t k = first; k < made.levels.size(); ++k)
            made.levels[k].error = meter.measure(made.levels[k]);
    }
    made.seconds.measure = watch.seconds();
}

/// `await_errors`: until then the levels may still be measured.
void Run::write(const std::filesystem::path& output, const std::function<void()>& await_errors) {
    Stopwatch watch;
    if (!options.progressive.empty()) {
        write_pm(options.progressive, full(), log, made.sample);
        made.vertex_splits = log.size();
    }
    if (!keep_full) made.levels.erase(made.levels.begin()), made.checks.erase(made.checks.begin());
    made.files = write_levels(output, made.levels, {options.compression, options.split, [&] {
                                                        if (!await_errors) return;
                                                        await_errors();
                                                        watch = {};
                                                    }});
    made.seconds.write = watch.seconds();
}

/// Where no level is rounded for the file, it is made ready beside the measuring.
void Run::measure_and_write(const std::filesystem::path& output) {
    if (!one_file || options.compression != Compression::none) {
        stage("measuring");
        measure();
        stage("writing " + output.string());
        write(output);
        return;
    }
    stage("measuring, and writing " + output.string());
    auto measured = std::async(std::launch::async, [&] { measure(); });
    write(output, [&] { measured.get(); });
}

} // namespace

void check_output(const std::filesystem::path& output, const PipelineOptions& options) {
    if (!has_mesh_ending(output))
        throw std::runtime_error("cannot write '" + output.string() + "': name it " + listed_mesh_endings());
    if (!is_glb(output) && (options.split || options.compression != Compression::none))
        throw std::runtime_error("--compress and --split are for .glb alone: name the output .glb");
    if (const std::string why = why_not_writable(output.string()); !why.empty())
        throw std::runtime_error(why);
    if (!options.progressive.empty()) check_pm_output(options.progressive);
}

MeshedCapture mesh_capture(const std::filesystem::path& capture, const PipelineOptions& options) {
    Run run(options, true);
    run.make_surface(capture);
    run.make_levels();
    run.lay_outlines();
    run.fit_corners();
    run.bake_textures();
    run.measure();
    return run.take();
}

MeshedCapture mesh_capture(const std::filesystem::path& capture, const std::filesystem::path& output,
                           const PipelineOptions& options) {
    check_output(output, options);
    Run run(options, is_glb(output));
    run.make_surface(capture);
    run.make_levels();
    run.lay_outlines();
    run.fit_corners();
    run.bake_textures();
    run.measure_and_write(output);
    return run.take();
}

} // namespace glcast
