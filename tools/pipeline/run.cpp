#include "tools/pipeline/run.h"

#include <algorithm>
#include <cstdio>
#include <future>
#include <numeric>
#include <stdexcept>
#include <tbb/parallel_for.h>

#include "tools/io/capture_reader.h"
#include "tools/io/level_set.h"
#include "tools/pipeline/progressive_output.h"
#include "tools/texture/outline.h"
#include "tools/texture/wedge_fit.h"

namespace glcast {
namespace {

using Unit = SimplifyTarget::Unit;

constexpr double hardly_coarser = 0.9; // of the triangles: no level of default of its own
constexpr int most_finer = 12;         // tries, each with more triangles

struct Stopwatch {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

std::string text_of(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::string option_of(const SimplifyTarget& target) {
    const char* name = target.unit == Unit::edges       ? "--edges "
                       : target.unit == Unit::triangles ? "--triangles "
                                                        : "--ratio ";
    return name + text_of(target.value);
}

bool keeps(const MeshCheck& check, const SimplifyTarget& target, std::size_t of_triangles) {
    switch (target.unit) {
    case Unit::edges:
        return double(check.edges) <= target.value;
    case Unit::triangles:
        return double(check.triangles) <= target.value;
    default:
        return double(check.triangles) <= target.value * double(of_triangles);
    }
}

void require_manifold(const MeshCheck& check, const std::string& what) {
    if (!check.closed_manifold())
        throw std::runtime_error(what + " is not closed: " + describe(check) + "; nothing was written");
}

} // namespace

void Run::make_surface(const std::filesystem::path& capture) {
    HitBuilder hits;
    stage("reading " + capture.string());
    Stopwatch watch;
    made.info = read_capture(capture, [&](ViewImage&& image) { hits.add(image); });
    made.seconds.read = watch.seconds();
    stage("making the surface");
    watch = {};
    full.sample = made.sample = made.info.box.size / made.info.n;
    ReconstructOptions how = options.surface;
    how.complete_layers = made.info.layers == Layers::complete;
    how.eyes = made.info.seen_places;
    if (made.info.eye) how.eyes.push_back(*made.info.eye);
    full.mesh = reconstruct(std::move(hits), made.info.box, how, &made.surface, &captured);
    full.error.unsupported_area_share = made.surface.unsupported_area_share;
    if (!how.geometric_normals) full.error.disagreeing_normals_share = made.surface.disagreeing_normals_share;
    full_check = check_mesh(full.mesh);
    made.full_triangles = full_check.triangles;
    made.seconds.surface = watch.seconds();
    require_manifold(full_check, "the surface");
}

/// What becomes of what the collapses leave. `may_move`: nothing binds its vertices to where they are.
Level Run::draft_of(Mesh&& simplified, bool may_move) const {
    Level level = shaped(std::move(simplified), may_move);
    colour(level);
    return level;
}

/// Its vertices are where they stay.
Level Run::shaped(Mesh&& simplified, bool may_move) const {
    Level level;
    level.mesh = std::move(simplified);
    level.sample = full.sample;
    if (is_full(level))
        level.error = full.error;
    else if (may_move && options.progressive.empty())
        fit_outlines(level.mesh, captured);
    return level;
}

/// Normals and colours by corner.
void Run::colour(Level& level) const {
    if (is_full(level) || !options.progressive.empty()) return;
    WedgeOptions corners;
    if (options.texture.kind == TextureChoice::Kind::sized)
        corners.colour = WedgeOptions::any_colour; // the texture has them
    fit_wedges(level, captured, corners);
}

void Run::add_full() { drafts.push_back({draft_of(Mesh(full.mesh), false), {"--full", true}}); }

/// Made by one run of collapses.
void Run::add_counted() {
    std::vector<SimplifyTarget> targets = options.targets;
    for (const ErrorLimit& limit : options.max_error)
        targets.push_back(
            coarsest_within(full, limit.in_units(full), {.refit = options.progressive.empty()}));
    std::vector<Mesh> meshes = options.progressive.empty()
                                   ? simplify_levels(full.mesh, targets, {.checked = &full_check})
                                   : levels_of_one_run(full.mesh, targets, log);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const bool by_error = k >= options.targets.size();
        const MeshCheck check = check_mesh(meshes[k]);
        Asked asked;
        if (by_error) {
            asked = {"--max-error " + options.max_error[k - options.targets.size()].text(), true};
        } else {
            asked = {option_of(targets[k]), keeps(check, targets[k], full_check.triangles)};
            if (!asked.met)
                note(asked.option + ": no fewer than " + std::to_string(check.triangles) +
                     " triangles can be left");
            else if (check.triangles == full_check.triangles && targets[k].value != 1)
                note(asked.option + ": the full surface has no more than " + std::to_string(check.triangles) +
                     " triangles, so that is what the level is");
        }
        drafts.push_back({draft_of(std::move(meshes[k]), !by_error), asked});
    }
}

void Run::add_sized(const std::vector<double>& pixels) {
    simplification = std::make_unique<Simplification>(
        full.mesh, SimplifyOptions{.refit = options.progressive.empty(), .checked = &full_check});
    search = std::make_unique<LevelSearch>(
        *simplification, *meter, full.mesh.triangles.size(),
        [this](Mesh&& mesh, bool outlines) { return shaped(std::move(mesh), outlines); });
    std::vector<double> widths = pixels;
    std::vector<SizedLimit> limits;
    std::sort(widths.begin(), widths.end(), std::greater<>());
    for (const double width : widths) limits.push_back(error_within(width, made.info.n) * made.sample);
    std::vector<SizedLevel> found = search->coarsest_within(limits);
    tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t k) { colour(found[k].level); });
    for (std::size_t k = 0; k < found.size(); ++k) {
        found[k].level.pixels = widths[k];
        drafts.push_back({std::move(found[k].level),
                          {"--pixels " + text_of(widths[k]), true},
                          found[k].count,
                          limits[k].p999,
                          found[k].bare});
    }
    if (!options.progressive.empty()) bind_to_progressive_mesh();
}

/// Levels that were found are those of a run that the progressive mesh logs.
void Run::bind_to_progressive_mesh() {
    std::vector<SimplifyTarget> targets;
    for (Draft& draft : drafts) {
        for (int k = 0; k < most_finer && draft.limit > 0 && !is_full(draft.level) &&
                        meter->measure(draft.level).p999 > draft.limit;
             ++k) {
            const double pixels = draft.level.pixels;
            SizedLevel finer = search->finer({{}, draft.count, draft.bare});
            draft.level = std::move(finer.level), draft.level.pixels = pixels, draft.count = finer.count;
        }
        targets.push_back({Unit::triangles, double(draft.level.mesh.triangles.size())});
    }
    std::vector<Mesh> meshes = levels_of_one_run(full.mesh, targets, log);
    for (std::size_t k = 0; k < drafts.size(); ++k)
        drafts[k].level.mesh = std::move(meshes[k]), drafts[k].count = 0;
}

/// Finest first. Of those for sizes on the screen a finer one may have fewer triangles, as errors of fits are
/// not quite in the order of their counts; then it serves for both.
void Run::drop_doubles() {
    const bool by_default =
        options.targets.empty() && options.max_error.empty() && options.pixels.empty() && !options.full;
    if (!by_default)
        std::stable_sort(drafts.begin(), drafts.end(), [](const Draft& a, const Draft& b) {
            return a.level.mesh.triangles.size() > b.level.mesh.triangles.size();
        });
    for (std::size_t k = 1; k < drafts.size();) {
        const double finer = double(drafts[k - 1].level.mesh.triangles.size()),
                     own = double(drafts[k].level.mesh.triangles.size());
        if (own < finer && !(by_default && own > hardly_coarser * finer)) {
            ++k;
            continue;
        }
        note((by_default ? "the level for " + text_of(drafts[k].level.pixels) + " pixels"
                         : "the level of " + drafts[k].asked.option) +
             " would have " + (own < finer ? "hardly fewer" : "no fewer") +
             " triangles than the one before, which serves for both");
        drafts.erase(drafts.begin() + std::ptrdiff_t(k));
    }
}

void Run::make_levels() {
    stage("simplifying");
    const Stopwatch watch;
    const bool by_default =
        options.targets.empty() && options.max_error.empty() && options.pixels.empty() && !options.full;
    const std::vector<double> pixels = by_default ? default_pixels(made.info.n) : options.pixels;
    const bool needs_meter = !pixels.empty() || !options.targets.empty() || !options.max_error.empty() ||
                             options.compression != Compression::none;
    if (needs_meter) meter = std::make_unique<LevelMeter>(full);
    if (options.full) add_full();
    if (!pixels.empty()) add_sized(pixels);
    if (!options.targets.empty() || !options.max_error.empty()) add_counted();
    if (drafts.size() == std::size_t(options.full) && !options.progressive.empty())
        (void)levels_of_one_run(full.mesh, {}, log);
    drop_doubles();
    if (!options.progressive.empty()) // as glcast refine has it, without the capture
        for (Draft& draft : drafts)
            if (!is_full(draft.level)) fit_wedges(draft.level, full.mesh);
    for (std::size_t k = 0; k < drafts.size(); ++k) drafts[k].level.name = level_name(named, k);
    made.seconds.simplify = watch.seconds();
}

/// Or materials. What a progressive mesh holds stays as it is.
bool Run::has_textures() const {
    return options.surface.method != SurfaceMethod::cubes &&
           (options.texture.kind != TextureChoice::Kind::none || options.progressive.empty());
}

void Run::texture(Draft& draft) {
    std::string why_not;
    draft.texture = texture_level(draft.level, captured, options.texture, why_not);
    if (!why_not.empty()) note(why_not);
}

void Run::make_textures() {
    if (!has_textures()) return;
    stage("baking textures");
    const Stopwatch watch;
    for (Draft& draft : drafts) texture(draft);
    made.seconds.texture = watch.seconds();
}

/// Against the full surface; where the files will hold rounded levels, these.
void Run::measure_drafts(const std::vector<std::size_t>& which) {
    const bool rounds = options.compression != Compression::none;
    if (!rounds && options.progressive.empty())
        for (const std::size_t k : which)
            if (!is_full(drafts[k].level)) hold_in_floats(drafts[k].level.mesh);
    if (rounds) {
        rounded.clear();
        for (const Draft& draft : drafts) rounded.push_back(draft.level);
        round_levels(rounded, options.compression);
    }
    tbb::parallel_for(std::size_t(0), which.size(), [&](std::size_t i) {
        Draft& draft = drafts[which[i]];
        if (rounds)
            draft.level.error = rounded[which[i]].error = meter->measure(rounded[which[i]]);
        else if (!is_full(draft.level))
            draft.level.error = meter->measure(draft.level);
    });
}

std::vector<std::size_t> Run::too_far() const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < drafts.size(); ++k)
        if (const Draft& draft = drafts[k]; draft.limit > 0 && draft.count > 0 && !is_full(draft.level) &&
                                            draft.level.error.p999 > draft.limit)
            found.push_back(k);
    return found;
}

/// What was found by estimates is made finer where the certificate says otherwise.
void Run::measure() {
    stage("measuring");
    const Stopwatch watch;
    std::vector<std::size_t> which(drafts.size());
    std::iota(which.begin(), which.end(), 0);
    measure_drafts(which);
    for (int round = 0; round < most_finer && !(which = too_far()).empty(); ++round) {
        for (const std::size_t k : which) {
            Draft& draft = drafts[k];
            SizedLevel finer = search->finer({{}, draft.count, draft.bare});
            colour(finer.level);
            finer.level.name = draft.level.name, finer.level.pixels = draft.level.pixels;
            draft.level = std::move(finer.level), draft.count = finer.count;
            if (has_textures()) texture(draft);
        }
        if (options.compression != Compression::none) {
            which.resize(drafts.size());
            std::iota(which.begin(), which.end(), 0);
        }
        measure_drafts(which);
    }
    captured = {}; // it is large
    for (std::size_t k = 0; k < drafts.size(); ++k) {
        Draft& draft = drafts[k];
        if (draft.limit > 0 && draft.level.error.p999 > draft.limit) draft.asked.met = false;
        made.levels.push_back(rounded.empty() ? std::move(draft.level) : std::move(rounded[k]));
        made.checks.push_back(check_mesh(made.levels[k].mesh, options.check));
        require_manifold(made.checks[k], made.levels[k].name);
        made.asked.push_back(draft.asked);
        made.textures.push_back(draft.texture);
        if (!draft.asked.met && draft.limit > 0)
            note(draft.asked.option +
                 ": the level is farther from the full surface than an eighth of a pixel");
    }
    join_as_set(made.levels);
    made.seconds.measure = watch.seconds();
}

/// What the file that was there before had beside it, and is not written anew.
void Run::remove_left_over(const std::filesystem::path& output, const LevelSet& before) {
    constexpr unsigned looked_for = 16;
    const std::size_t written = options.one_file ? 1 : made.levels.size();
    for (unsigned k = unsigned(std::max<std::size_t>(written, 1)); k < std::max(before.count, looked_for);
         ++k) {
        const std::filesystem::path file = level_path(output, k);
        std::error_code wrong;
        if (k > 64 || !std::filesystem::exists(file, wrong)) continue;
        const LevelSet set = set_of_file(file);
        const bool of_that_run =
            before.count > 0 && set.id == before.id && set.level == k && set.count == before.count;
        if (of_that_run && std::filesystem::remove(file, wrong))
            note("removed " + file.string() + ": it belonged to the levels that were here before");
        else
            note(file.string() + " is not of this run; it was there before and is left");
    }
}

void Run::write(const std::filesystem::path& output) {
    stage("writing " + output.string());
    const Stopwatch watch;
    if (!options.progressive.empty()) {
        write_pm(options.progressive, full.mesh, log, made.sample);
        made.vertex_splits = log.size();
    }
    if (options.one_file)
        for (Level& level : made.levels) level.set = {};
    const LevelSet before = set_of_file(output);
    made.files = write_levels(output, made.levels, {options.compression, options.one_file, options.units});
    remove_left_over(output, before);
    made.seconds.write = watch.seconds();
}

MeshedCapture Run::take() {
    stage("");
    return std::move(made);
}

} // namespace glcast
