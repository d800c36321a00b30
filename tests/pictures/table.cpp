// Rows of docs/measured/levels.md: how far the levels of a cast are from what was drawn, in space and in pictures. See
// make-table.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "capture/output_file.h"
#include "tests/pictures/originals.h"
#include "tests/pictures/quality.h"
#include "tests/pictures/reference.h"
#include "tests/pictures/shown_peers.h"
#include "tools/deviation/deviation.h"
#include "tools/io/capture_reader.h"
#include "tools/io/mesh_io.h"
#include "tools/render/render.h"

namespace glcast::pictures {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string name, capture, full, levels, textured, original, json, pictures;
    std::vector<std::size_t> targets{10'000, 2'000, 500};
    int samples = 4; ///< a pixel, along an axis
    bool peers = true;
};

struct Context {
    const Options& options;
    std::vector<ReferenceView> views;
    Mesh truth;         ///< what geometric errors are measured against
    bool known = false; ///< the program's own mesh, not our full surface
    double sample = 0;
    int n = 0;
    Json rows = Json::array();
};

Json measured(Context& context, const std::string& how, std::size_t target, const Level& level,
              const std::string& of = "cast") {
    const Mesh& mesh = level.mesh;
    DeviationOptions points;
    points.visible_only = context.known; // what a cast cannot see it need not have
    const Deviation d = deviation(context.truth, mesh, points);
    const PictureError error = picture_error(level, context.views, context.options.samples);
    Json row = {{"program", context.options.name},
                {"n", context.n},
                {"how", how},
                {"of", of},
                {"target", target},
                {"triangles", mesh.triangles.size()},
                {"textured", !level.texture.empty()},
                {"against", context.known ? "the program's mesh" : "the full surface of the cast"},
                {"sample", context.sample},
                {"meanError", std::max(d.a_to_b.mean, d.b_to_a.mean)},
                {"p999Error", std::max(d.a_to_b.p999, d.b_to_a.p999)},
                {"maxError", std::max(d.a_to_b.max, d.b_to_a.max)},
                {"diagonal", d.diagonal_a},
                {"views", error.views},
                {"width", error.width},
                {"samples", context.options.samples},
                {"psnr", error.antialiased.psnr},
                {"psnrWorstView", error.antialiased.psnr_worst},
                {"ssim", error.antialiased.ssim},
                {"psnrOneSample", error.one_sample.psnr},
                {"ssimOneSample", error.one_sample.ssim},
                {"psnrCovered", error.psnr_covered},
                {"psnrInside", error.psnr_inside},
                {"psnrOutline", error.psnr_outline},
                {"psnrFilling", error.psnr_filling},
                {"backgroundShare", error.background_share}};
    std::fprintf(
        stderr,
        "%-12s %-14s %7zu triangles: mean %.4f samples, %.2f dB (one sample %.2f, inside %.2f, worst view "
        "%.2f), SSIM %.4f\n",
        context.options.name.c_str(), how.c_str(), mesh.triangles.size(),
        row["meanError"].get<double>() / context.sample, error.antialiased.psnr, error.one_sample.psnr,
        error.psnr_inside, error.antialiased.psnr_worst, error.antialiased.ssim);
    context.rows.push_back(row);
    return row;
}

/// The finest level with at most so many triangles.
const Level* level_of(const std::vector<Level>& levels, std::size_t target) {
    for (const Level& level : levels)
        if (level.mesh.triangles.size() <= target) return &level;
    return nullptr;
}

/// Of one view: where the most is seen.
const ReferenceView& fullest(const std::vector<ReferenceView>& views) {
    const auto covered = [](const ReferenceView& v) {
        return std::count(v.seen.covered.begin(), v.seen.covered.end(), 1);
    };
    return *std::max_element(views.begin(), views.end(),
                             [&](const auto& a, const auto& b) { return covered(a) < covered(b); });
}

void write_picture(const Context& context, const std::string& what, const Level& level) {
    if (context.options.pictures.empty()) return;
    const ReferenceView& view = fullest(context.views);
    write_png(context.options.pictures + "/" + context.options.name + "-" + what + ".png",
              antialiased(lit(rasterise(level, view.camera), view), context.options.samples));
}

void add_levels(Context& context, const std::string& file, const std::string& how) {
    const std::vector<Level> levels = read_levels(file);
    for (const std::size_t target : context.options.targets) {
        const Level* level = level_of(levels, target);
        if (!level)
            throw std::runtime_error(file + " has no level of at most " + std::to_string(target) +
                                     " triangles");
        measured(context, how, target, *level);
        if (how == "textured" && level->texture.empty()) throw std::runtime_error(file + " has no texture");
        write_picture(context, how.substr(0, how.find(' ')) + "-" + std::to_string(target), *level);
    }
}

/// Of one surface, which all of them get; what has no more triangles than asked for is as good as itself.
void add_peers(Context& context, const Level& surface, const std::string& of) {
    for (const ShownPeer& peer : shown_peers())
        for (const std::size_t target : context.options.targets) {
            if (surface.mesh.triangles.size() <= target) {
                measured(context, peer.name, target, surface, of);
                continue;
            }
            try {
                const Level level = peer.run(surface, target);
                measured(context, peer.name, target, level, of);
                write_picture(context, peer.name + ", " + of + "-" + std::to_string(target), level);
            } catch (const std::runtime_error& error) { // a program that is not there, or no memory
                std::cerr << peer.name << " of the " << of << ": " << error.what() << '\n';
            }
        }
}

/// The mean of what was captured: for meshes whose colour the program chose.
void colour_like_the_capture(Mesh& mesh, const std::vector<ReferenceView>& views) {
    glm::dvec3 sum(0);
    double count = 0;
    for (const ReferenceView& view : views)
        for (std::size_t p = 0; p < view.seen.covered.size(); ++p)
            if (view.seen.covered[p]) sum += glm::dvec3(view.seen.colour[p]), ++count;
    mesh.colours.assign(mesh.positions.size(), glm::vec3(sum / count));
}

void run(const Options& options) {
    Context context{options, read_references(options.capture), {}, !options.original.empty()};
    const CaptureInfo info = read_capture_info(options.capture);
    context.sample = info.box.size / info.n;
    context.n = info.n;
    const Level full = std::move(read_levels(options.full).front());
    if (context.known) {
        context.truth = original(options.original);
        if (context.truth.colours.empty()) colour_like_the_capture(context.truth, context.views);
    } else {
        context.truth = full.mesh;
    }
    if (!options.pictures.empty())
        write_png(options.pictures + "/" + options.name + "-original.png",
                  antialiased(lit(fullest(context.views)), options.samples));
    measured(context, "full surface", 0, full);
    write_picture(context, "full", full);
    add_levels(context, options.levels, "vertex colours");
    if (!options.textured.empty()) add_levels(context, options.textured, "textured");
    if (context.known) {
        measured(context, "original", 0, Level{context.truth, ""}, "own mesh");
        if (options.peers) add_peers(context, Level{context.truth, ""}, "own mesh");
    }
    if (options.peers) add_peers(context, split_at_creases(full), "cast");
    std::ofstream(options.json) << context.rows.dump(1) << '\n';
}

} // namespace
} // namespace glcast::pictures

int main(int count, char** arguments) {
    glcast::pictures::Options options;
    CLI::App app("Errors of levels of detail against what the program drew.");
    app.add_option("--name", options.name)->required();
    app.add_option("--capture", options.capture, "made with GLCAST_REFERENCE_VIEWS")->required();
    app.add_option("--full", options.full, "mesh of the full surface")->required();
    app.add_option("--levels", options.levels, "mesh with levels, colours of vertices")->required();
    app.add_option("--textured", options.textured, "mesh with levels, textured");
    app.add_option("--original", options.original, "teapot, spheres or t.obj");
    app.add_option("--json", options.json, "rows to write")->required();
    app.add_option("--pictures", options.pictures, "folder for pictures of the levels");
    app.add_option("--samples", options.samples, "samples a pixel, along an axis")->check(CLI::Range(1, 16));
    app.add_option("--targets", options.targets)->delimiter(',');
    app.add_flag("!--no-peers", options.peers, "our own levels alone");
    CLI11_PARSE(app, count, arguments);
    try {
        glcast::pictures::run(options);
    } catch (const std::exception& error) {
        std::cerr << "picture-table: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
