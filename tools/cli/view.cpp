// glcast view: a page to look at a cast with, in any browser.
#include <algorithm>
#include <memory>
#include <optional>

#include "capture/output_file.h"
#include "tools/cli/captured_views.h"
#include "tools/cli/command.h"
#include "tools/deviation/deviation.h"
#include "tools/deviation/level_error.h"
#include "tools/io/capture_reader.h"
#include "tools/io/level_set.h"
#include "tools/io/mesh_io.h"
#include "tools/pipeline/pipeline.h"
#include "tools/view/page.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::vector<std::string> files;
    std::string output, capture;
    PageOptions page;
    bool json = false;
};

void check_output(const Options& options) {
    if (std::filesystem::path(options.output).extension() != ".html")
        throw std::runtime_error("cannot write '" + options.output + "': name it .html");
    for (const std::string& file : options.files) {
        std::error_code ignored;
        if (std::filesystem::equivalent(file, options.output, ignored))
            throw std::runtime_error("cannot write '" + options.output + "': it is what is to be shown");
    }
    if (const std::string why = why_no_pages(); !why.empty()) throw std::runtime_error(why);
    require_writable(options.output);
}

bool is_capture(const std::string& file) {
    const std::filesystem::path path(file);
    return path.extension() == ".exr" || (std::filesystem::is_regular_file(path) && looks_like_exr(path));
}

/// Whose views to show: as told, or the file itself when it is a capture.
std::string capture_of(const Options& options) {
    if (!options.capture.empty()) return options.capture;
    return options.files.size() == 1 && is_capture(options.files[0]) ? options.files[0] : "";
}

std::vector<Level> levels_of(const std::string& file) {
    if (!is_capture(file)) return read_all_levels(file);
    PipelineOptions how;
    how.stage = progress_of_stages();
    return std::move(mesh_capture(file, how).levels);
}

/// Those that another of them brings along, as a level of its set, are not shown twice (gears*.glb of a
/// shell).
void leave_out_found(std::vector<std::string>& files) {
    std::vector<std::filesystem::path> found;
    for (const std::string& file : files)
        for (auto& beside : levels_beside(file, set_of_file(file))) found.push_back(std::move(beside));
    std::erase_if(files, [&](const std::string& file) {
        return std::any_of(found.begin(), found.end(), [&](const std::filesystem::path& other) {
            std::error_code ignored;
            return std::filesystem::equivalent(file, other, ignored);
        });
    });
}

/// All levels of all files, finest first. What files say of errors counts for their own level 0 alone.
std::vector<Level> gather_levels(const std::vector<std::string>& files) {
    if (files.size() == 1) return levels_of(files[0]);
    std::vector<Level> all;
    for (const std::string& file : files)
        for (Level& level : levels_of(file)) {
            level.error = {};
            level.name = std::filesystem::path(file).filename().string() +
                         (level.name.empty() ? "" : ": " + level.name);
            all.push_back(std::move(level));
        }
    std::stable_sort(all.begin(), all.end(), [](const Level& a, const Level& b) {
        return a.mesh.triangles.size() > b.mesh.triangles.size();
    });
    return all;
}

std::vector<PageLevel> describe_levels(const std::vector<Level>& levels) {
    const Progress progress("measuring");
    std::optional<LevelMeter> meter; // where a file does not tell
    std::vector<PageLevel> described;
    for (const Level& level : levels) {
        PageLevel& one = described.emplace_back();
        one.mesh = &level.mesh;
        one.texture = &level.texture;
        one.wedges = &level.wedges;
        one.name = level.name.empty() ? "level " + std::to_string(described.size() - 1) : level.name;
        one.glb_bytes = glb_size(level);
        one.error = level.error;
        if (&level == &levels[0])
            one.vertex_distance.assign(level.mesh.positions.size(), 0);
        else {
            one.vertex_distance = distances_to(levels[0].mesh, level.mesh.positions);
            if (level.error.max > 0) continue;
            if (!meter) meter.emplace(levels[0]);
            one.error = meter->measure(level);
        }
    }
    return described;
}

std::string title_of(const Options& options) {
    std::string title = std::filesystem::path(options.files[0]).filename().string();
    if (options.files.size() > 1) title += " and " + std::to_string(options.files.size() - 1) + " more";
    return title;
}

void write(const std::string& path, const std::string& html) {
    OutputFile file(path);
    if (!file.append(html.data(), html.size()) || !file.commit()) throw std::runtime_error(file.error());
}

void print_page(const Options& options, const PageInput& input, const Page& page) {
    Json json = {{"file", options.output}, {"bytes", page.html.size()}, {"pictureBytes", page.picture_bytes}, {"views", input.views.size()}};
    for (std::size_t k = 0; k < input.levels.size(); ++k) {
        const PageLevel& level = input.levels[k];
        json["levels"].push_back({{"name", level.name},
                                  {"triangles", level.mesh->triangles.size()},
                                  {"vertices", level.mesh->positions.size()},
                                  {"glbBytes", level.glb_bytes},
                                  {"pageBytes", page.level_bytes[k]},
                                  {"inPage", page.level_bytes[k] > 0},
                                  {"textured", level.texture && !level.texture->empty()},
                                  {"meanError", level.error.mean},
                                  {"maxError", level.error.max}});
    }
    print_json(json);
}

void say_page(const Options& options, const PageInput& input, const Page& page) {
    for (std::size_t k = 0; k < input.levels.size(); ++k)
        if (page.level_bytes[k] == 0)
            say(input.levels[k].name + " is left out of the page: " +
                std::to_string(input.levels[k].mesh->triangles.size()) + " triangles, more than " +
                std::to_string(options.page.most_triangles) + " (--max-triangles)");
    const auto shown = std::count_if(page.level_bytes.begin(), page.level_bytes.end(),
                                     [](std::size_t bytes) { return bytes > 0; });
    say("wrote " + options.output + " (" + std::to_string(page.html.size()) + " bytes): " +
        std::to_string(shown) + (shown == 1 ? " level, " : " levels, ") +
        (input.views.empty() ? "no captured views; --capture FILE.exr adds them" : "six captured views"));
}

int view(Options options) {
    for (const std::string& file : options.files) require_file(file);
    leave_out_found(options.files);
    if (!options.capture.empty()) require_file(options.capture);
    check_output(options);
    const std::string capture = capture_of(options);
    CapturedSix captured;
    if (!capture.empty()) captured = read_six_views(capture);
    const std::vector<Level> levels = gather_levels(options.files);
    PageInput input;
    input.title = title_of(options);
    input.levels = describe_levels(levels);
    input.views = captured.views;
    if (!capture.empty()) {
        input.capture = &captured.info;
        input.sample = captured.info.box.size / captured.info.n;
    }
    if (levels[0].sample > 0) input.sample = levels[0].sample;
    const Page page = make_page(input, options.page);
    write(options.output, page.html);
    if (options.json)
        print_page(options, input, page);
    else
        say_page(options, input, page);
    return 0;
}

} // namespace

Run declare_view(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.footer(R"(The page is one file: it opens by double-click, and never uses the network. A capture is meshed first, as
glcast mesh does without options. Of several files, each is a level, the one with most triangles level 0.
Sizes: 5 to 12 bytes a triangle, and 0.55 MB for the page itself.)");
    app.add_option("file", options->files,
                   "mesh (.glb, .obj, .ply, .off, .stl) with the levels beside it, several that are a level "
                   "each, or a capture (.exr)")
        ->required();
    app.add_option("-o,--output", options->output, "page to write (.html)")->required();
    app.add_option("--capture", options->capture, "capture (.exr) whose six views stand beside the cast");
    app.add_option("--max-triangles", options->page.most_triangles,
                   "levels with more are listed but left out of the page")
        ->check(CLI::Range(1, 100'000'000))
        ->capture_default_str();
    app.add_option("--view-pixels", options->page.view_pixels, "captured views are scaled down to at most this")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    return [options] { return view(*options); };
}

} // namespace glcast::cli
