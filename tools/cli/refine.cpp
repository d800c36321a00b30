// glcast refine: one level out of a progressive mesh, or something between two.
#include <cmath>
#include <memory>

#include "tools/cli/command.h"
#include "tools/io/mesh_endings.h"
#include "tools/io/mesh_io.h"
#include "tools/progressive/geomorph.h"
#include "tools/progressive/stream.h"
#include "tools/texture/wedge_fit.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string file, output;
    double edges = 0, triangles = 0, ratio = 0, to = 0, fraction = 0; ///< 0: not given, but for the fraction
    bool json = false;

    double wanted() const { return edges > 0 ? edges : triangles > 0 ? triangles : ratio; }
};

/// The finest level within a count, in the unit that was asked for.
std::size_t level_of(const ProgressiveFile& file, const Options& options, double most) {
    const auto whole = [](double value) { return value >= 1e18 ? SIZE_MAX : std::size_t(value); };
    if (options.edges > 0) return file.mesh.level_of_edges(whole(most));
    if (options.triangles > 0) return file.mesh.level_of_triangles(whole(most));
    return file.mesh.level_of_triangles(whole(most * double(file.info.triangles)));
}

bool fits(const ProgressiveFile& file, const Options& options, std::size_t level, double most) {
    if (options.edges > 0) return double(file.mesh.edges(level)) <= most;
    const double triangles = options.triangles > 0 ? most : most * double(file.info.triangles);
    return double(file.mesh.triangles(level)) <= triangles;
}

void check_options(const Options& options) {
    if (!has_mesh_ending(options.output))
        throw std::runtime_error("cannot write '" + options.output + "': name it " + listed_mesh_endings());
    if (options.to > 0 && options.wanted() == 0)
        throw std::runtime_error("--to needs --edges, --triangles or --ratio: the level that it starts from");
    if (options.to > 0 && options.to < options.wanted())
        throw std::runtime_error(
            "--to is the finer level: it must be no less than the one that it starts from");
    if (options.ratio > 0 && options.to > 1)
        throw std::runtime_error("--to is a share here, as --ratio is: 1 or less");
    require_writable(options.output);
}

struct Refined {
    Mesh mesh;
    Wedges wedges;                 ///< of a level below the finest
    std::size_t level = 0, to = 0; ///< to: of a geomorph the finer one
    bool within = true;            ///< the level is as small as was asked for
};

/// As glcast mesh --pm fits them: to the finest mesh that the file has.
void add_wedges(ProgressiveFile& file, Refined& out) {
    if (out.level == file.mesh.splits()) return;
    file.mesh.refine_to(file.mesh.splits());
    Level level;
    level.mesh = std::move(out.mesh);
    fit_wedges(level, file.mesh.mesh());
    out.mesh = std::move(level.mesh), out.wedges = std::move(level.wedges);
}

Refined refined(const Options& options, ProgressiveFile& file) {
    Refined out;
    const double wanted = options.wanted();
    out.level = wanted > 0 ? level_of(file, options, wanted) : file.mesh.splits();
    out.within = wanted == 0 || fits(file, options, out.level, wanted);
    out.to = options.to > 0 ? level_of(file, options, options.to) : out.level;
    if (options.to > 0) {
        out.mesh = Geomorph(file.mesh, out.level, out.to).at(options.fraction);
    } else {
        file.mesh.refine_to(out.level);
        out.mesh = file.mesh.mesh();
        add_wedges(file, out);
    }
    return out;
}

void print_refined(const Options& options, const ProgressiveFile& file, const Refined& out,
                   const MeshCheck& check) {
    Json json = {{"file", options.file},
                 {"output", options.output},
                 {"bytes", std::filesystem::file_size(options.output)},
                 {"complete", file.complete},
                 {"splits", file.mesh.splits()},
                 {"level", out.level}};
    if (options.to > 0) json["morph"] = {{"to", out.to}, {"fraction", options.fraction}};
    json["withinTarget"] = out.within;
    json["mesh"] = to_json(check);
    print_json(json);
}

void say_refined(const Options& options, const ProgressiveFile& file, const Refined& out,
                 const MeshCheck& check) {
    if (!file.complete)
        say("'" + options.file + "' is cut off: it has " + std::to_string(file.mesh.splits()) + " of " +
            std::to_string(file.info.splits()) + " vertex splits, so at most " +
            std::to_string(file.mesh.triangles(file.mesh.splits())) + " of " +
            std::to_string(file.info.triangles) + " triangles");
    if (!out.within) say("its base mesh has more than was asked for; this is the base mesh");
    std::string which = "level " + std::to_string(out.level) + " of " + std::to_string(file.mesh.splits());
    if (options.to > 0)
        which += ", " + number(100 * options.fraction) + " % of the way to " + std::to_string(out.to);
    say(which + ": " + summary(check));
    say("wrote " + options.output + " (" + std::to_string(std::filesystem::file_size(options.output)) +
        " bytes)");
}

int refine(const Options& options) {
    check_options(options);
    require_file(options.file);
    ProgressiveFile file = [&] {
        const Progress progress("reading " + options.file);
        return read_progressive(options.file);
    }();
    const Refined out = refined(options, file);
    const MeshCheck check = check_mesh(out.mesh);
    Level level;
    level.mesh = out.mesh, level.wedges = out.wedges, level.sample = file.info.sample;
    level.name = file.info.name.empty() ? "refined" : file.info.name;
    write_levels(options.output, {&level, 1});
    if (options.json)
        print_refined(options, file, out, check);
    else
        say_refined(options, file, out, check);
    return 0;
}

} // namespace

Run declare_refine(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.footer(
        R"(A .glpm is written by glcast mesh --pm. Each level is the mesh that simplifying to the same count gave, bit for
bit; without a count it is the original. A file that is cut off gives what is there, and says so.
Geomorph: --triangles 2000 --to 8000 --fraction 0.25 has the triangles of the finer level, its vertices a
quarter of the way from where they are in the coarser one; at 0 it looks like that one, at 1 it is the finer.)");
    app.add_option("file", options->file, "progressive mesh (.glpm)")->required();
    app.add_option("-o,--output", options->output, "mesh to write: .glb, .obj, .ply, .off, .stl or .3mf")
        ->required();
    auto* edges = app.add_option("--edges", options->edges, "the finest level with at most so many edges");
    auto* triangles =
        app.add_option("--triangles", options->triangles, "the finest level with at most so many triangles");
    auto* ratio = app.add_option("--ratio", options->ratio,
                                 "the finest level with at most such a share of the triangles");
    edges->check(CLI::Range(1.0, 1e10))->excludes(triangles)->excludes(ratio);
    triangles->check(CLI::Range(1.0, 1e10))->excludes(ratio);
    ratio->check(CLI::Range(1e-9, 1.0));
    auto* to = app.add_option("--to", options->to,
                              "geomorph towards the finer level with at most so many, of the same unit");
    to->check(CLI::Range(1e-9, 1e10));
    app.add_option("--fraction", options->fraction, "how far the geomorph has come")
        ->check(CLI::Range(0.0, 1.0))
        ->needs(to);
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    return [options] { return refine(*options); };
}

} // namespace glcast::cli
