// glcast info: what is in a capture or a mesh, checked.
#include <cstdio>
#include <glm/common.hpp>
#include <memory>

#include "tools/cli/command.h"
#include "tools/cli/progressive.h"
#include "tools/io/capture_reader.h"
#include "tools/io/mesh_io.h"
#include "tools/progressive/stream.h"
#include "tools/words/text.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string file;
    bool json = false;
};

/// A name out of the file, or the file's own, for a terminal.
std::string word(const Json& name) { return printable(name.get<std::string>()); }

Json vector_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json describe_part(const ViewImage& image) {
    std::size_t covered = 0, with_normal = 0;
    for (std::size_t p = 0; p < image.depth.size(); ++p) {
        covered += image.covered(p);
        with_normal += image.normal[p].w > 0;
    }
    const double pixels = double(image.n) * image.n;
    return {{"name", part_name(image.view)},
            {"coveredPixels", covered},
            {"coverage", double(covered) / pixels},
            {"pixelsWithNormal", with_normal}};
}

Json describe_capture(const Options& options) {
    Json parts; // one image in memory at a time
    const CaptureInfo info =
        read_capture(options.file, [&](ViewImage&& image) { parts.push_back(describe_part(image)); });
    Json matrix = Json::array();
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) matrix.push_back(info.eye_to_capture[c][r]);
    Json json = {{"file", options.file},
                 {"kind", "capture"},
                 {"bytes", std::filesystem::file_size(options.file)},
                 {"n", info.n},
                 {"box", {{"lo", vector_json(info.box.lo)}, {"size", info.box.size}}},
                 {"sample", info.box.size / info.n},
                 {"eyeToCapture", matrix},
                 {"program", info.program},
                 {"frame", info.frame},
                 {"renderer", info.renderer},
                 {"normals", info.normals},
                 {"glcastVersion", info.glcast_version},
                 {"layers",
                  {{"state", layers_name(info.layers)},
                   {"method", layer_method_name(info.layer_method)},
                   {"count", info.layer_count}}},
                 {"notUnderstood", Json::object()}};
    if (info.eye) json["eye"] = vector_json(*info.eye);
    for (const glm::dvec3& place : info.seen_places) json["seenPlaces"].push_back(vector_json(place));
    for (const auto& [what, count] : info.not_understood) json["notUnderstood"][what] = count;
    json["parts"] = parts;
    return json;
}

Json describe_level(const Level& level, const MeshCheck& check) {
    glm::dvec3 lo = level.mesh.positions.at(0), hi = lo;
    for (const glm::dvec3& p : level.mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    Json json = {{"name", level.name}};
    json.update(to_json(check));
    json["bounds"] = {{"lo", vector_json(lo)}, {"hi", vector_json(hi)}};
    json["hasNormals"] = !level.mesh.normals.empty();
    json["hasColours"] = !level.mesh.colours.empty();
    if (!level.texture.empty())
        json["texture"] = {{"width", level.texture.colour.width}, {"height", level.texture.colour.height}};
    json.update(to_json(level.error));
    if (level.sample > 0) json["sample"] = level.sample;
    return json;
}

void print_layers(const Json& layers) {
    if (layers["state"] == "outer") {
        std::printf("layers    the six views from outside only\n");
        return;
    }
    const Json& count = layers["count"];
    std::printf("layers    x %d, y %d, z %d, %s, by %s\n", count[0].get<int>(), count[1].get<int>(),
                count[2].get<int>(), layers["state"].get<std::string>().c_str(),
                layers["method"].get<std::string>().c_str());
}

void print_capture(const Json& j) {
    const auto& lo = j["box"]["lo"];
    std::printf("capture   %s, %ld bytes, complete\n", word(j["file"]).c_str(), j["bytes"].get<long>());
    std::printf("program   %s, frame %ld, %s\n", word(j["program"]).c_str(), j["frame"].get<long>(),
                word(j["renderer"]).c_str());
    std::printf("lattice   n = %d, box from (%.6g, %.6g, %.6g), size %.6g, sample %.6g\n", j["n"].get<int>(),
                lo[0].get<double>(), lo[1].get<double>(), lo[2].get<double>(), j["box"]["size"].get<double>(),
                j["sample"].get<double>());
    std::printf("normals   %s; made by glcast %s\n", word(j["normals"]).c_str(),
                word(j["glcastVersion"]).c_str());
    print_layers(j["layers"]);
    for (const Json& part : j["parts"])
        std::printf("view %-5s %6.2f %% covered, %ld pixels, %ld of them with a normal\n",
                    part["name"].get<std::string>().c_str(), part["coverage"].get<double>() * 100,
                    part["coveredPixels"].get<long>(), part["pixelsWithNormal"].get<long>());
    if (j["notUnderstood"].empty()) std::printf("understood everything that was called in the frame\n");
    for (const auto& [what, count] : j["notUnderstood"].items())
        std::printf("not understood: %s, %ld times\n", printable(what).c_str(), count.get<long>());
}

void print_level(const Json& j, const Level& level, const MeshCheck& check) {
    const auto &lo = j["bounds"]["lo"], &hi = j["bounds"]["hi"];
    std::printf("%s\n", printable(level.name).c_str());
    std::printf("  %s\n", summary(check).c_str());
    std::printf("  %ld vertices%s%s, %ld component%s, Euler characteristic %ld\n", j["vertices"].get<long>(),
                j["hasNormals"].get<bool>() ? ", normals" : "",
                j["hasColours"].get<bool>() ? ", colours" : "", j["components"].get<long>(),
                j["components"].get<long>() == 1 ? "" : "s", j["euler"].get<long>());
    std::printf("  volume %.6g, area %.6g\n", j["volume"].get<double>(), j["area"].get<double>());
    std::printf("  bounds (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g)\n", lo[0].get<double>(),
                lo[1].get<double>(), lo[2].get<double>(), hi[0].get<double>(), hi[1].get<double>(),
                hi[2].get<double>());
    if (level.error.max > 0)
        std::printf("  error to the full surface: %s\n", error_line(level.error, level.sample).c_str());
    if (const std::string advice = normals_advice(level.error.disagreeing_normals_share); !advice.empty())
        std::printf("  %s\n", advice.c_str());
    if (!level.texture.empty())
        std::printf("  texture %d x %d\n", level.texture.colour.width, level.texture.colour.height);
}

int info(const Options& options) {
    require_file(options.file);
    if (looks_like_exr(options.file) || std::filesystem::path(options.file).extension() == ".exr") {
        const Json json = describe_capture(options);
        options.json ? print_json(json) : print_capture(json);
        return 0;
    }
    if (looks_like_progressive(options.file)) return progressive_info(options.file, options.json);
    const std::vector<Level> levels = read_all_levels(options.file);
    Json json = {
        {"file", options.file}, {"kind", "mesh"}, {"bytes", std::filesystem::file_size(options.file)}};
    std::vector<MeshCheck> checks;
    for (const Level& level : levels) {
        checks.push_back(check_mesh(level.mesh, CheckDepth::everything));
        require_measurable(level.mesh, checks.back());
        json["levels"].push_back(describe_level(level, checks.back()));
    }
    if (options.json) {
        print_json(json);
        return 0;
    }
    std::printf("mesh      %s, %ld bytes\n", printable(options.file).c_str(), json["bytes"].get<long>());
    for (std::size_t k = 0; k < levels.size(); ++k) print_level(json["levels"][k], levels[k], checks[k]);
    return 0;
}

} // namespace

Run declare_info(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.add_option("file", options->file,
                   "capture (.exr), mesh (.glb, .obj, .ply, .off, .stl) or progressive mesh (.glpm)")
        ->required();
    app.add_flag("--json", options->json, "print one JSON object on standard output");
    return [options] { return info(*options); };
}

} // namespace glcast::cli
