#include "tools/cli/command.h"

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <unistd.h>

#include "capture/output_file.h"
#include "tools/mesh/error_names.h"
#include "tools/words/text.h"

namespace glcast::cli {

void say(const std::string& line) { std::fprintf(stderr, "glcast: %s\n", printable(line).c_str()); }

Progress::Progress(const std::string& what) : shown(isatty(STDERR_FILENO)) {
    if (shown) std::fprintf(stderr, "glcast: %s ...", printable(what).c_str());
}

Progress::~Progress() {
    if (shown) std::fputs("\r\033[K", stderr);
}

std::function<void(const std::string& what)> progress_of_stages() {
    return [now = std::shared_ptr<Progress>()](const std::string& what) mutable {
        now.reset(); // clears its line before the next is written
        if (!what.empty()) now = std::make_shared<Progress>(what);
    };
}

void print_json(const nlohmann::ordered_json& object) {
    const std::string text = object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::printf("%s\n", text.c_str());
    if (std::fflush(stdout) != 0) throw std::runtime_error("cannot write to standard output");
}

void require_writable(const std::filesystem::path& path) {
    const std::string why = why_not_writable(path.string());
    if (!why.empty()) throw std::runtime_error(why);
}

nlohmann::ordered_json to_json(const MeshCheck& c) {
    nlohmann::ordered_json json = {{"vertices", c.vertices},
                                   {"edges", c.edges},
                                   {"triangles", c.triangles},
                                   {"components", c.components},
                                   {"euler", c.euler},
                                   {"boundaryEdges", c.boundary_edges},
                                   {"nonManifoldEdges", c.non_manifold_edges},
                                   {"nonManifoldVertices", c.non_manifold_vertices},
                                   {"degenerateTriangles", c.degenerate_triangles},
                                   {"unusedVertices", c.unused_vertices},
                                   {"volume", c.volume},
                                   {"area", c.area},
                                   {"closedManifold", c.closed_manifold()}};
    if (c.self_intersections) json["selfIntersections"] = *c.self_intersections;
    return json;
}

nlohmann::ordered_json to_json(const LevelError& error) {
    nlohmann::ordered_json json;
    for (const ErrorName& e : error_names) json[e.name] = error.*e.value;
    return json;
}

std::string error_line(const LevelError& error, double sample) {
    const auto length = [&](double value) {
        return number(value) + (sample > 0 ? " (" + number(value / sample) + " samples)" : "");
    };
    return "mean " + length(error.mean) + ", 99.9 % " + length(error.p999) + ", max " + length(error.max) +
           "; normals " + number(error.normal_mean_degrees) + " degrees; colours mean " + number(error.colour_mean) +
           ", 99.9 % " + number(error.colour_p999);
}

std::string summary(const MeshCheck& check) {
    return std::to_string(check.triangles) + " triangles, " + std::to_string(check.edges) + " edges, " +
           describe(check);
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

} // namespace glcast::cli
