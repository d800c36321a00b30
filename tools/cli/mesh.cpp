// glcast mesh: capture -> surface -> levels -> file.
#include <algorithm>
#include <memory>
#include <sys/resource.h>

#include "tools/cli/command.h"
#include "tools/cli/texture.h"
#include "tools/pipeline/pipeline.h"
#include "tools/words/closing.h"
#include "tools/words/text.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;
using Unit = SimplifyTarget::Unit;

struct Options {
    std::string capture, output, pm, method = "contour", exterior = "layers", normals = "drawn";
    double close_gaps = 1, sheet_thickness = 0.1;
    std::vector<double> pixels, edges, triangles, ratio;
    std::vector<std::string> max_error;
    std::string texture = "auto", compress = "none", levels = "files",
                units; ///< units: none said: millimetres
    bool full = false, check = false, json = false, verbose = false;
    bool rehearse = false; ///< options and output are looked at, and nothing else: glcast-run asks before it
                           ///< starts a program
};

const char* exterior_name(ExteriorRule rule) { return rule == ExteriorRule::layers ? "layers" : "axes"; }

ReconstructOptions surface_options(const Options& options) {
    ReconstructOptions how;
    how.method = options.method == "cubes" ? SurfaceMethod::cubes : SurfaceMethod::contour;
    how.exterior = options.exterior == "axes" ? ExteriorRule::axes : ExteriorRule::layers;
    how.close_gaps = options.close_gaps;
    how.sheet_thickness = options.sheet_thickness;
    how.geometric_normals = options.normals == "geometric";
    return how;
}

Compression compression(const Options& options) {
    if (options.compress == "none") return Compression::none;
    return options.compress == "quantize" ? Compression::quantize : Compression::meshopt;
}

PipelineOptions how_to(const Options& options) {
    PipelineOptions how;
    how.surface = surface_options(options);
    for (double e : options.edges) how.targets.push_back({Unit::edges, e});
    for (double t : options.triangles) how.targets.push_back({Unit::triangles, t});
    for (double r : options.ratio) how.targets.push_back({Unit::ratio, r});
    for (const std::string& limit : options.max_error) how.max_error.push_back(parse_error_limit(limit));
    how.pixels = options.pixels;
    how.full = options.full;
    how.texture = texture_choice(options.texture);
    how.compression = compression(options);
    if (!options.units.empty()) how.units = length_unit(options.units);
    how.one_file = options.levels == "one-file";
    how.progressive = options.pm;
    how.check = options.check ? CheckDepth::everything : CheckDepth::topology;
    how.stage = progress_of_stages();
    return how;
}

Json describe_level(const Options& options, const MeshedCapture& made, std::size_t k) {
    const Level& level = made.levels[k];
    Json json = to_json(made.checks[k]);
    json["name"] = level.name;
    json["file"] = made.files[options.levels == "files" ? k : 0].string();
    json["asked"] = made.asked[k].option;
    json["met"] = made.asked[k].met;
    if (level.pixels > 0) json["pixels"] = level.pixels;
    json.update(to_json(level.error));
    json["meanErrorSamples"] = level.error.mean / made.sample;
    json["p999ErrorSamples"] = level.error.p999 / made.sample;
    json["maxErrorSamples"] = level.error.max / made.sample;
    if (made.textures[k]) json["texture"] = to_json(*made.textures[k]);
    return json;
}

void print_made(const Options& options, const MeshedCapture& made) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const ReconstructReport& r = made.surface;
    Json json = {{"capture", options.capture},
                 {"n", made.info.n},
                 {"sample", made.sample},
                 {"method", options.method},
                 {"fullTriangles", made.full_triangles},
                 {"notes", made.notes}};
    for (const auto& file : made.files)
        json["files"].push_back({{"path", file.string()}, {"bytes", std::filesystem::file_size(file)}});
    if (!options.pm.empty())
        json["files"].push_back({{"path", options.pm}, {"bytes", std::filesystem::file_size(options.pm)}});
    for (std::size_t k = 0; k < made.levels.size(); ++k)
        json["levels"].push_back(describe_level(options, made, k));
    json["surface"] = {{"exterior", exterior_name(r.exterior)},
                       {"layers", layers_name(made.info.layers)},
                       {"filledSamples", r.filled_samples},
                       {"hiddenSamples", r.hidden_samples},
                       {"thinSamples", r.thin_samples},
                       {"crossings", r.crossings},
                       {"unsupportedCrossings", r.unsupported_crossings},
                       {"unsupportedAreaShare", r.unsupported_area_share},
                       {"disagreeingNormalsShare", r.disagreeing_normals_share},
                       {"verticesWithoutPixel", r.vertices_without_pixel}};
    const MeshedCapture::Seconds& seconds = made.seconds;
    json["seconds"] = {{"read", seconds.read},         {"carve", r.carve_seconds},
                       {"contour", r.surface_seconds}, {"attributes", r.attribute_seconds},
                       {"surface", seconds.surface},   {"simplify", seconds.simplify},
                       {"texture", seconds.texture},   {"measure", seconds.measure},
                       {"write", seconds.write}};
    json["peakBytes"] = usage.ru_maxrss * 1024L;
    print_json(json);
}

/// Each level and each file, with their figures.
void say_figures(const Options& options, const MeshedCapture& made) {
    say(options.capture + ": n = " + std::to_string(made.info.n) + ", sample " + number(made.sample) + ", " +
        number(100 * made.surface.unsupported_area_share) +
        " % of the surface seen by no ray; the full surface has " + std::to_string(made.full_triangles) +
        " triangles");
    for (std::size_t k = 0; k < made.levels.size(); ++k) {
        const Level& level = made.levels[k];
        std::string line = level.name + " (" + made.asked[k].option + "): " + summary(made.checks[k]);
        if (level.error.max > 0) line += ", error " + error_line(level.error, made.sample);
        say(line);
        if (made.textures[k]) say("  " + describe(*made.textures[k]));
    }
    for (const auto& file : made.files)
        say("wrote " + file.string() + " (" + std::to_string(std::filesystem::file_size(file)) + " bytes)");
}

/// What would complete them.
std::string advice_on_layers(const CaptureInfo& info) {
    const int most = std::ranges::max(info.layer_count);
    if (info.layers == Layers::outer) return "capture again with --layers auto";
    if (most >= max_layers) return "a ray hits more than " + std::to_string(most) + " times";
    return "where a ray hits more than " + std::to_string(most) + " times, capture again with --layers " +
           std::to_string(std::min(2 * most, max_layers));
}

void say_made(const Options& options, const MeshedCapture& made) {
    if (options.verbose) say_figures(options, made);
    if (made.surface.exterior == ExteriorRule::axes && options.exterior == "layers")
        say("the capture's depth layers are not complete (" + std::string(layers_name(made.info.layers)) +
            "): cavities that no axis looks into are filled; " + advice_on_layers(made.info));
    if (const std::string advice = normals_advice(made.levels[0].error.disagreeing_normals_share);
        !advice.empty())
        say(advice);
    for (const std::string& note : made.notes) say(printable(note));
    if (!options.pm.empty())
        say("wrote " + printable(options.pm) + " (" + std::to_string(std::filesystem::file_size(options.pm)) +
            " bytes, " + std::to_string(made.vertex_splits) + " vertex splits)");
    say(closing_line({.what = made.info.program + ", frame " + std::to_string(made.info.frame),
                      .triangles = made.checks[0].triangles,
                      .error_samples = made.levels[0].error.p999 / made.sample,
                      .n = made.info.n,
                      .file = options.output,
                      .more_files = options.levels == "files" ? made.levels.size() - 1 : 0}));
}

int make_mesh(const Options& options) {
    if (options.rehearse) {
        check_output(options.output, how_to(options));
        return 0;
    }
    require_file(options.capture);
    const MeshedCapture made = mesh_capture(options.capture, options.output, how_to(options));
    if (const std::string note = note_on(options.output, made.levels[0]); !note.empty()) say(note);
    if (options.json)
        print_made(options, made);
    else
        say_made(options, made);
    return 0;
}

} // namespace

Run declare_mesh(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.footer(
        R"(Levels. OUT.glb is the finest, OUT_LOD1.glb, OUT_LOD2.glb, ... beside it are coarser ones, each a file with one mesh.
By default there are four, for an object that is drawn n/2, n/4, n/8 and n/16 pixels wide, n being the samples
of the capture: 99.9 % of the surface is off by an eighth of such a pixel at most, both ways, measured. What asks
for levels (--pixels, --full, --triangles, --edges, --ratio, --max-error) gets those and nothing else.
A level has plain colours by materials where these show it right, else a texture.
Every level is a closed two-manifold and is measured against the full surface, or nothing is written.
With --pm all levels come of one run of collapses, without the fit that halves their error, and are levels of the
progressive mesh, which goes down to 500 triangles or the coarsest level.
Positions are in the captured model's own units and axes. .off and .3mf keep colours but no normals, .stl neither.)");
    app.add_option("capture", options->capture, "capture made by glcast-run (.exr)")->required();
    app.add_option("-o,--output", options->output, "mesh to write: .glb, .obj, .ply, .off, .stl or .3mf")
        ->required();
    app.add_option("--method", options->method,
                   "contour: smooth, sharp edges kept; cubes: a square per exposed face")
        ->check(CLI::IsMember({"contour", "cubes"}))
        ->capture_default_str();
    app.add_option("--exterior", options->exterior,
                   "layers: filled is what the outside does not reach or nobody can see; axes: what no axis "
                   "sees past")
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
    app.add_option("--pixels", options->pixels, "levels for an object drawn so many pixels wide: 512,100")
        ->delimiter(',')
        ->check(CLI::Range(1.0, 65536.0));
    app.add_flag("--full", options->full, "the full surface, not simplified");
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
                   "the coarsest level nowhere farther than this from the full surface, measured: samples "
                   "(0.5), units "
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
                   "auto: levels that plain colours would show wrongly, as large as they need; none; or bake "
                   "colours and normals of every level into "
                   "textures so many texels wide: 64, 128, ... 8192")
        ->check(texture_size())
        ->capture_default_str();
    app.parse_complete_callback([options] {
        const std::string ending = std::filesystem::path(options->output).extension();
        if (!options->units.empty() && ending != ".stl" && ending != ".3mf")
            throw CLI::ValidationError("--units",
                                       "is for .stl and .3mf: other formats have no unit of length to say");
        if (options->texture != "auto" && options->texture != "none" && options->method == "cubes")
            throw CLI::ValidationError("--texture",
                                       "needs --method contour: each step of the cubes would be a chart");
    });
    app.add_option("--compress", options->compress,
                   ".glb: quantize: 16-bit positions, a fifth smaller; meshopt: the same, compressed: a "
                   "sixth of the size")
        ->check(CLI::IsMember({"none", "quantize", "meshopt"}))
        ->capture_default_str();
    app.add_option("--units", options->units,
                   ".stl, .3mf: what a unit of the model is: um, mm, cm, inch, ft or m; default: mm")
        ->check(CLI::IsMember({"um", "mm", "cm", "inch", "ft", "m"}));
    app.add_option("--levels", options->levels,
                   "files: a file each; one-file: .glb with all of them, by MSFT_lod")
        ->check(CLI::IsMember({"files", "one-file"}))
        ->capture_default_str();
    app.add_option("--pm", options->pm,
                   "progressive mesh to write too: .glpm (all, for glcast refine) or .pm (OpenMesh's)");
    app.add_flag("--check", options->check, "count self-intersections of every level too");
    app.add_flag("--verbose", options->verbose, "say the figures of every level and file");
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    app.add_flag("--rehearse", options->rehearse)->group("");
    return [options] { return make_mesh(*options); };
}

} // namespace glcast::cli
