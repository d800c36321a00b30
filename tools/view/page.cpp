#include "tools/view/page.h"

#include <algorithm>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/view/packing.h"
#include "tools/view/pictures.h"
#include "tools/view/template.h"

namespace glcast {
namespace {

using Json = nlohmann::ordered_json;
using namespace view;

/// Round all levels and the captured box, so that every picture has one scale.
Cube cube_round(const PageInput& input) {
    glm::dvec3 lo = input.levels.at(0).mesh->positions.at(0), hi = lo;
    for (const PageLevel& level : input.levels)
        for (const glm::dvec3& p : level.mesh->positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    const glm::dvec3 extent = hi - lo;
    const double size = std::max({extent.x, extent.y, extent.z});
    return {(lo + hi) * 0.5 - size * 0.5, size > 0 ? size : 1};
}

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
Json numbers(const glm::ivec3& v) { return {v.x, v.y, v.z}; }

Json describe(const PageLevel& level, bool included) {
    double mean = 0, largest = 0;
    for (const double d : level.vertex_distance) mean += d, largest = std::max(largest, d);
    return {{"name", level.name},
            {"triangles", level.mesh->triangles.size()},
            {"vertices", level.mesh->positions.size()},
            {"bytes", level.glb_bytes},
            {"meanError", level.error.mean},
            {"maxError", level.error.max},
            {"vertexMean", mean / double(std::max<std::size_t>(level.vertex_distance.size(), 1))},
            {"vertexMax", largest},
            {"normals", !level.mesh->normals.empty()},
            {"colours", !level.mesh->colours.empty()},
            {"included", included}};
}

std::string png_url(const ViewImage& image, What what, int pixels) {
    return "data:image/png;base64," + base64(view_png(image, what, pixels));
}

Json describe(const ViewImage& image, int pixels) {
    const Stance s = stance(image.view);
    std::string name = part_name(image.view);
    return {{"name", name.substr(0, name.find('.'))},
            {"right", numbers(s.right)},
            {"up", numbers(s.up)},
            {"back", numbers(s.back)},
            {"colour", png_url(image, What::colour, pixels)},
            {"normal", png_url(image, What::normal, pixels)}};
}

Json describe(const CaptureInfo& info) {
    return {{"program", info.program},
            {"frame", info.frame},
            {"n", info.n},
            {"lo", numbers(info.box.lo)},
            {"size", info.box.size}};
}

/// As the content of a script element: nothing in it may end the element.
std::string as_script(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe.push_back(c);
    return safe;
}

std::string element(const std::string& id, const char* type, const std::string& content) {
    return "<script type=\"" + std::string(type) + "\" id=\"" + id + "\">" + content + "</script>\n";
}

void require_some(const PageInput& input, const PageOptions& options) {
    if (input.levels.empty()) throw std::logic_error("no levels to show");
    std::size_t fewest = input.levels[0].mesh->triangles.size();
    for (const PageLevel& level : input.levels) fewest = std::min(fewest, level.mesh->triangles.size());
    if (fewest > options.most_triangles)
        throw std::runtime_error("no level has at most " + std::to_string(options.most_triangles) +
                                 " triangles (the coarsest has " + std::to_string(fewest) +
                                 "): raise --max-triangles, or make levels with glcast mesh");
}

} // namespace

std::string why_no_pages() {
    if (!page_template().empty()) return "";
    return "this glcast was built without the page's script, as node, or three and esbuild from npm, was missing: "
           "run 'npm ci' in the source folder, then cmake again, and build";
}

Page make_page(const PageInput& input, const PageOptions& options) {
    if (const std::string why = why_no_pages(); !why.empty()) throw std::runtime_error(why);
    require_some(input, options);
    const std::string_view whole = page_template();
    const std::size_t mark = whole.find(data_mark);
    if (mark == std::string_view::npos) throw std::logic_error("the page has no place for its data");

    const Cube cube = cube_round(input);
    Json scene = {{"title", input.title},       {"version", GLCAST_VERSION}, {"lo", numbers(cube.lo)},
                  {"size", cube.size},          {"sample", input.sample},    {"most", options.most_triangles},
                  {"levels", Json::array()},    {"views", Json::array()}};
    if (input.capture) scene["capture"] = describe(*input.capture);
    for (const ViewImage& image : input.views) scene["views"].push_back(describe(image, options.view_pixels));

    Page page;
    std::string data;
    for (const PageLevel& level : input.levels) {
        const bool included = level.mesh->triangles.size() <= options.most_triangles;
        scene["levels"].push_back(describe(level, included));
        std::string text;
        if (included)
            text = base64(packed_level(*level.mesh, level.vertex_distance,
                                       scene["levels"].back()["vertexMax"].get<double>(), cube));
        page.level_bytes.push_back(text.size());
        if (included)
            data += element("level-" + std::to_string(page.level_bytes.size() - 1), "text/plain", text);
    }
    page.html.append(whole.substr(0, mark));
    page.html += element("scene", "application/json", as_script(scene));
    page.html += data;
    page.html.append(whole.substr(mark + data_mark.size()));
    return page;
}

} // namespace glcast
