// glcast mesh: capture -> surface -> levels -> file.
#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <sys/resource.h>

#include "tools/cli/command.h"
#include "tools/cli/max_error.h"
#include "tools/cli/progressive.h"
#include "tools/cli/texture.h"
#include "tools/deviation/level_error.h"
#include "tools/io/capture_reader.h"
#include "tools/io/mesh_endings.h"
#include "tools/io/mesh_io.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/simplify/simplify.h"
#include "tools/texture/outline.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;
using Unit = SimplifyTarget::Unit;

constexpr double default_ratios[] = {0.1, 0.01};
constexpr double fewest_by_default = 500; // triangles: fewer and most things lose their shape

struct Options {
    std::string capture, output, pm, method = "contour", exterior = "layers", normals = "drawn";
    double close_gaps = 1, sheet_thickness = 0.1;
    std::vector<double> edges, triangles, ratio;
    std::vector<std::string> max_error;
    int texture = 0; ///< texels along an edge; 0: none
    std::string compress = "none";
    bool split = false, check = false, json = false, verbose = false;
    bool rehearse = false; ///< options and output are looked at, and nothing else: glcast-run asks before it starts a program
};

struct Stopwatch {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

const char* exterior_name(ExteriorRule rule) { return rule == ExteriorRule::layers ? "layers" : "axes"; }

/// Everything there is to tell about a run.
struct Made {
    CaptureInfo info;
    ReconstructReport report;
    std::vector<Level> levels;     ///< [0]: the full surface, until write() leaves it out
    std::vector<MeshCheck> checks; ///< of levels
    CapturedSurface captured;      ///< where a texture is asked for
    std::vector<TextureReport> textures; ///< of levels, or none
    CollapseLog log;               ///< for a progressive mesh: of the run that made the levels
    bool keep_full = true;         ///< .glb holds it always, the others when no target was given
    std::vector<std::filesystem::path> files;
    double sample = 0;
    double read_seconds = 0, surface_seconds = 0, simplify_seconds = 0, measure_seconds = 0,
           write_seconds = 0, texture_seconds = 0;

    std::future<std::vector<TextureReport>> full_texture; ///< level 0's, where it is baked beside the last collapses

    const Mesh& full() const { return levels[0].mesh; }
};

bool is_glb(const std::filesystem::path& file) { return file.extension() == ".glb"; }
bool is_glb(const Options& options) { return is_glb(std::filesystem::path(options.output)); }

void check_output(const Options& options) {
    const std::string extension = std::filesystem::path(options.output).extension();
    if (!has_mesh_ending(options.output))
        throw std::runtime_error("cannot write '" + options.output + "': name it " + listed_mesh_endings());
    if (extension != ".glb" && (options.split || options.compress != "none"))
        throw std::runtime_error("--compress and --split are for .glb alone: name the output .glb");
    require_writable(options.output);
    if (!options.pm.empty()) check_pm_output(options.pm);
}

std::vector<SimplifyTarget> given_targets(const Options& options) {
    std::vector<SimplifyTarget> targets;
    for (double e : options.edges) targets.push_back({Unit::edges, e});
    for (double t : options.triangles) targets.push_back({Unit::triangles, t});
    for (double r : options.ratio) targets.push_back({Unit::ratio, r});
    return targets;
}

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

CheckDepth depth(const Options& options) {
    return options.check ? CheckDepth::everything : CheckDepth::topology;
}

ReconstructOptions how_to(const Options& options, const CaptureInfo& info) {
    ReconstructOptions how;
    how.method = options.method == "cubes" ? SurfaceMethod::cubes : SurfaceMethod::contour;
    how.exterior = options.exterior == "axes" ? ExteriorRule::axes : ExteriorRule::layers;
    how.complete_layers = info.layers == Layers::complete;
    how.close_gaps = options.close_gaps;
    how.sheet_thickness = options.sheet_thickness;
    how.geometric_normals = options.normals == "geometric";
    return how;
}

void make_surface(const Options& options, Made& made) {
    HitBuilder hits;
    {
        const Progress progress("reading " + options.capture);
        const Stopwatch watch;
        made.info = read_capture(options.capture, [&](ViewImage&& image) { hits.add(image); });
        made.read_seconds = watch.seconds();
    }
    const Progress progress("making the surface");
    const Stopwatch watch;
    made.sample = made.info.box.size / made.info.n;
    made.levels.push_back({reconstruct(std::move(hits), made.info.box, how_to(options, made.info), &made.report,
                                       options.texture ? &made.captured : nullptr),
                           "level 0", {}, made.sample, {}});
    made.checks.push_back(check_mesh(made.full(), depth(options)));
    made.surface_seconds = watch.seconds();
    require_manifold(made.checks[0], "the surface");
}

/// Beside the last collapses, which leave cores idle.
void begin_full_texture(const Options& options, Made& made) {
    if (!options.texture || !made.keep_full) return;
    made.full_texture = std::async(std::launch::async, [&] {
        return texture_levels(std::span(made.levels).first(1), made.captured, options.texture);
    });
}

/// The full surface first, then the targets, finest first.
void make_levels(const Options& options, Made& made) {
    const Progress progress("simplifying");
    const Stopwatch watch;
    std::vector<SimplifyTarget> targets = given_targets(options);
    for (const std::string& limit : options.max_error)
        targets.push_back(coarsest_within(made.levels[0], parse_error_limit(limit).in_units(made.levels[0]),
                                          {.refit = options.pm.empty()}));
    std::sort(targets.begin(), targets.end(), [](const auto& a, const auto& b) { return a.value > b.value; });
    made.keep_full = is_glb(options) || targets.empty();
    if (targets.empty() && is_glb(options)) targets = default_targets(made.full().triangles.size());
    const MeshCheck& full_check = made.checks[0];
    if (is_glb(options)) std::erase_if(targets, [&](const auto& target) { return met(target, full_check); });
    made.levels.reserve(1 + targets.size()); // level 0 stays where it is
    std::vector<Mesh> simplified =
        options.pm.empty()
            ? simplify_levels(made.full(), targets,
                              {.checked = &full_check, .last_stretch = [&] { begin_full_texture(options, made); }})
            : levels_of_one_run(made.full(), targets, made.log);
    for (Mesh& mesh : simplified) {
        const std::string name = "level " + std::to_string(made.levels.size());
        made.checks.push_back(check_mesh(mesh, depth(options)));
        require_manifold(made.checks.back(), name);
        made.levels.push_back({std::move(mesh), name, {}, made.sample, {}});
    }
    made.simplify_seconds = watch.seconds();
}

/// Textures hide what lies inside outlines. Not levels that a progressive mesh or a measured limit binds.
void lay_outlines(const Options& options, Made& made) {
    if (!options.texture || !options.pm.empty() || !options.max_error.empty()) return;
    const Stopwatch watch;
    for (std::size_t k = 1; k < made.levels.size(); ++k) {
        fit_outlines(made.levels[k].mesh, made.captured);
        made.checks[k] = check_mesh(made.levels[k].mesh, depth(options));
    }
    made.simplify_seconds += watch.seconds();
}

void bake_textures(const Options& options, Made& made) {
    if (!options.texture) return;
    const Stopwatch watch;
    const bool begun = made.full_texture.valid();
    const std::span<Level> rest = std::span(made.levels).subspan(made.keep_full && !begun ? 0 : 1);
    std::vector<TextureReport> reports = texture_levels(rest, made.captured, options.texture);
    if (begun) made.textures = made.full_texture.get();
    made.textures.insert(made.textures.end(), reports.begin(), reports.end());
    made.captured = {}; // it is large
    made.texture_seconds = watch.seconds();
}

Compression compression(const Options& options) {
    if (options.compress == "none") return Compression::none;
    return options.compress == "quantize" ? Compression::quantize : Compression::meshopt;
}

/// Against the full surface; where the file will hold rounded levels, these, and level 0 too.
void measure_levels(const Options& options, Made& made) {
    const Stopwatch watch;
    made.levels[0].error.unsupported_area_share = made.report.unsupported_area_share;
    std::optional<Level> exact;
    if (compression(options) != Compression::none) {
        exact = made.levels[0];
        round_levels(made.levels, compression(options));
        for (std::size_t k = 0; k < made.levels.size(); ++k)
            made.checks[k] = check_mesh(made.levels[k].mesh, depth(options));
    }
    const std::size_t first = exact ? 0 : 1;
    if (first < made.levels.size()) {
        const LevelMeter meter(exact ? *exact : made.levels[0]);
        for (std::size_t k = first; k < made.levels.size(); ++k)
            made.levels[k].error = meter.measure(made.levels[k]);
    }
    made.measure_seconds = watch.seconds();
}

/// `await_errors`: until then the levels may still be measured.
void write(const Options& options, Made& made, const std::function<void()>& await_errors = {}) {
    const Progress progress((await_errors ? "measuring, and writing " : "writing ") + options.output);
    Stopwatch watch;
    if (!options.pm.empty()) write_pm(options.pm, made.full(), made.log, made.sample);
    if (!made.keep_full) made.levels.erase(made.levels.begin()), made.checks.erase(made.checks.begin());
    made.files = write_levels(options.output, made.levels, {compression(options), options.split, [&] {
                                                                if (!await_errors) return;
                                                                await_errors();
                                                                watch = {};
                                                            }});
    made.write_seconds = watch.seconds();
}

/// Where no level is rounded for the file, it is made ready beside the measuring.
void measure_and_write(const Options& options, Made& made) {
    if (!is_glb(options) || compression(options) != Compression::none) {
        {
            const Progress progress("measuring");
            measure_levels(options, made);
        }
        write(options, made);
        return;
    }
    auto measured = std::async(std::launch::async, [&] { measure_levels(options, made); });
    write(options, made, [&] { measured.get(); });
}

Json describe_level(const Made& made, std::size_t k) {
    const Level& level = made.levels[k];
    Json json = to_json(made.checks[k]);
    json["name"] = level.name;
    json["file"] = made.files[is_glb(made.files[0]) ? 0 : k].string();
    json.update(to_json(level.error));
    json["meanErrorSamples"] = level.error.mean / made.sample;
    json["p999ErrorSamples"] = level.error.p999 / made.sample;
    json["maxErrorSamples"] = level.error.max / made.sample;
    if (!made.textures.empty()) json["texture"] = to_json(made.textures[k]);
    return json;
}

void print_made(const Options& options, const Made& made) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const ReconstructReport& r = made.report;
    Json json = {{"capture", options.capture},
                 {"n", made.info.n},
                 {"sample", made.sample},
                 {"method", options.method}};
    for (const auto& file : made.files)
        json["files"].push_back({{"path", file.string()}, {"bytes", std::filesystem::file_size(file)}});
    if (!options.pm.empty())
        json["files"].push_back({{"path", options.pm}, {"bytes", std::filesystem::file_size(options.pm)}});
    for (std::size_t k = 0; k < made.levels.size(); ++k) json["levels"].push_back(describe_level(made, k));
    json["surface"] = {{"exterior", exterior_name(r.exterior)},
                       {"layers", layers_name(made.info.layers)},
                       {"filledSamples", r.filled_samples},
                       {"hiddenSamples", r.hidden_samples},
                       {"thinSamples", r.thin_samples},
                       {"crossings", r.crossings},
                       {"unsupportedCrossings", r.unsupported_crossings},
                       {"unsupportedAreaShare", r.unsupported_area_share},
                       {"verticesWithoutPixel", r.vertices_without_pixel}};
    json["seconds"] = {{"read", made.read_seconds},       {"carve", r.carve_seconds},
                       {"contour", r.surface_seconds},    {"attributes", r.attribute_seconds},
                       {"surface", made.surface_seconds}, {"simplify", made.simplify_seconds},
                       {"texture", made.texture_seconds}, {"measure", made.measure_seconds},
                       {"write", made.write_seconds}};
    json["peakBytes"] = usage.ru_maxrss * 1024L;
    print_json(json);
}

void say_made(const Options& options, const Made& made) {
    const ReconstructReport& r = made.report;
    say(options.capture + ": n = " + std::to_string(made.info.n) + ", sample " + number(made.sample) + ", " +
        number(100 * r.unsupported_area_share) + " % of the surface seen by no ray");
    if (r.exterior == ExteriorRule::axes && options.exterior == "layers")
        say("the capture's depth layers are not complete (" + std::string(layers_name(made.info.layers)) +
            "): cavities that no axis looks into are filled; capture again with --layers auto");
    for (std::size_t k = 0; k < made.levels.size(); ++k) {
        const Level& level = made.levels[k];
        std::string line = level.name + ": " + summary(made.checks[k]);
        if (level.error.max > 0)
            line += ", error " + error_line(level.error, made.sample);
        say(line);
        if (!made.textures.empty()) say("  " + describe(made.textures[k], options.texture));
    }
    for (const auto& file : made.files)
        say("wrote " + file.string() + " (" + std::to_string(std::filesystem::file_size(file)) + " bytes)");
    if (!options.pm.empty())
        say("wrote " + options.pm + " (" + std::to_string(std::filesystem::file_size(options.pm)) + " bytes, " +
            std::to_string(made.log.size()) + " vertex splits)");
}

int make_mesh(const Options& options) {
    check_output(options);
    if (options.rehearse) return 0;
    require_file(options.capture);
    Made made;
    make_surface(options, made);
    make_levels(options, made);
    lay_outlines(options, made);
    bake_textures(options, made);
    measure_and_write(options, made);
    if (options.json)
        print_made(options, made);
    else
        say_made(options, made);
    return 0;
}

} // namespace

std::vector<Level> mesh_capture(const std::string& capture) {
    Options options;
    options.capture = capture;
    options.output = "levels.glb"; // for its levels; nothing is written
    Made made;
    make_surface(options, made);
    make_levels(options, made);
    const Progress progress("measuring");
    measure_levels(options, made);
    return std::move(made.levels);
}

Run declare_mesh(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.footer(
        "Levels. A .glb holds the full surface as level 0, which is what viewers show, and the levels asked "
        "for behind\n"
        "it (MSFT_lod); by default those have 1/10 and 1/100 of the triangles, at least 500. The other "
        "formats hold one\n"
        "mesh: the full surface, or with targets one file per target: OUT.ply for the finest, OUT.lod1.ply, "
        "...\n"
        "Every level is a closed two-manifold and is measured against the full surface, or nothing is "
        "written.\n"
        "With --pm all levels come of one run of collapses, without the fit that halves their error, and are levels of the\n"
        "progressive mesh, which goes down to 500 triangles or the coarsest level.\n"
        "Positions are in the captured model's own units and axes. .off keeps colours but no normals.");
    app.add_option("capture", options->capture, "capture made by glcast-run (.exr)")->required();
    app.add_option("-o,--output", options->output, "mesh to write: .glb, .obj, .ply or .off")->required();
    app.add_option("--method", options->method,
                   "contour: smooth, sharp edges kept; cubes: a square per exposed face")
        ->check(CLI::IsMember({"contour", "cubes"}))
        ->capture_default_str();
    app.add_option("--exterior", options->exterior,
                   "layers: filled is what the outside does not reach or nobody can see; axes: what no axis sees past")
        ->check(CLI::IsMember({"layers", "axes"}))
        ->capture_default_str();
    app.add_option("--sheet-thickness", options->sheet_thickness,
                   "distance between the sides of a sheet drawn without thickness, in samples")
        ->check(CLI::Range(0.01, 1.0))
        ->capture_default_str();
    app.add_option("--close-gaps", options->close_gaps,
                   "close slits up to this radius, in samples; 0 keeps every gap")
        ->check(CLI::Range(0.0, 64.0))
        ->capture_default_str();
    auto* edges = app.add_option("--edges", options->edges, "levels with at most so many edges: 5000,782")
                      ->delimiter(',');
    auto* triangles =
        app.add_option("--triangles", options->triangles, "levels with at most so many triangles")
            ->delimiter(',');
    auto* ratio =
        app.add_option("--ratio", options->ratio, "levels with such a share of the triangles: 0.1,0.01")
            ->delimiter(',');
    edges->check(CLI::Range(6.0, 1e10))->excludes(triangles)->excludes(ratio);
    triangles->check(CLI::Range(4.0, 1e10))->excludes(ratio);
    ratio->check(CLI::Range(1e-9, 1.0));
    app.add_option("--max-error", options->max_error,
                   "the coarsest level nowhere farther than this from the full surface, measured: samples (0.5), units "
                   "(0.5u), % of the diagonal (0.1%)")
        ->delimiter(',')
        ->check([](const std::string& text) {
            try {
                parse_error_limit(text);
            } catch (const std::exception& wrong) {
                return std::string(wrong.what());
            }
            return std::string();
        })
        ->excludes(edges)
        ->excludes(triangles)
        ->excludes(ratio);
    app.add_option("--normals", options->normals, "drawn: as the program lit it; geometric: of the surface")
        ->check(CLI::IsMember({"drawn", "geometric"}))
        ->capture_default_str();
    app.add_option("--texture", options->texture,
                   "bake colours and normals of every level into textures so many texels wide: 64, 128, ... 8192")
        ->check(texture_size());
    app.parse_complete_callback([options] {
        if (options->texture && options->method == "cubes")
            throw CLI::ValidationError("--texture", "needs --method contour: each step of the cubes would be a chart");
    });
    app.add_option("--compress", options->compress,
                   ".glb: quantize: 16-bit positions, a fifth smaller; meshopt: the same, compressed: a sixth of the size")
        ->check(CLI::IsMember({"none", "quantize", "meshopt"}))
        ->capture_default_str();
    app.add_flag("--split", options->split, ".glb: beside it one file a level: OUT.lod0.glb, OUT.lod1.glb, ...");
    app.add_option("--pm", options->pm, "progressive mesh to write too: .glpm (all, for glcast refine) or .pm (OpenMesh's)");
    app.add_flag("--check", options->check, "count self-intersections of every level too");
    app.add_flag("--verbose", options->verbose, "say also how, with figures");
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    app.add_flag("--rehearse", options->rehearse)->group("");
    return [options] { return make_mesh(*options); };
}

} // namespace glcast::cli
