#include "tools/view/page.h"

#include <algorithm>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/picture/sample.h"
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

const Texture& texture_of(const PageLevel& level) {
    static const Texture none;
    return level.texture ? *level.texture : none;
}

const Wedges& wedges_of(const PageLevel& level) {
    static const Wedges none;
    return level.wedges ? *level.wedges : none;
}

bool is_textured(const PageLevel& level) {
    return level.texture && !level.texture->empty() && !level.texture->colour.rgb.empty();
}

Json describe(const PageLevel& level, bool included) {
    double mean = 0, largest = 0;
    for (const double d : level.vertex_distance) mean += d, largest = std::max(largest, d);
    const LevelError& error = level.error;
    return {{"name", level.name},
            {"triangles", level.mesh->triangles.size()},
            {"vertices", level.mesh->positions.size()},
            {"bytes", level.glb_bytes},
            {"meanError", error.mean},
            {"p999Error", error.p999},
            {"maxError", error.max},
            {"normalError", error.normal_mean_degrees},
            {"colourError", error.colour_mean},
            {"colourP999", error.colour_p999},
            {"unsupported", error.unsupported_area_share},
            {"vertexMean", mean / double(std::max<std::size_t>(level.vertex_distance.size(), 1))},
            {"vertexMax", largest},
            {"normals", has_normals(*level.mesh, wedges_of(level))},
            {"colours", has_colours(*level.mesh, wedges_of(level))},
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

std::string element(const std::string& id, const char* type, const std::string& content) {
    return "<script type=\"" + std::string(type) + "\" id=\"" + id + "\">" + content + "</script>\n";
}

/// Pictures of textures, each in the page once, however many levels share it.
class Atlases {
  public:
    explicit Atlases(std::string& data) : data(data) {}

    /// Its number in the page; -1: none.
    int add(const Picture& picture) {
        if (picture.rgb.empty()) return -1;
        const auto same = std::find_if(known.begin(), known.end(), [&](const Picture* other) {
            return other->width == picture.width && other->rgb == picture.rgb;
        });
        if (same != known.end()) return int(same - known.begin());
        known.push_back(&picture);
        const std::string text = base64(picture_png(picture));
        bytes += text.size();
        data += element("picture-" + std::to_string(known.size() - 1), "text/plain", text);
        return int(known.size()) - 1;
    }
    std::size_t bytes = 0;

  private:
    std::string& data;
    std::vector<const Picture*> known;
};

/// The level as text, and what the page must know to read it.
std::string pack(const PageLevel& level, const Cube& cube, Json& described, Atlases& atlases) {
    const double largest = described["vertexMax"].get<double>();
    const Wedges& wedges = wedges_of(level);
    if (!is_textured(level) && wedges.empty())
        return base64(packed_level(*level.mesh, level.vertex_distance, largest, cube));
    CutMesh cut = cut_at_seams(*level.mesh, level.vertex_distance, texture_of(level), wedges);
    described["packedVertices"] = cut.mesh.positions.size();
    if (!is_textured(level)) return base64(packed_level(cut, largest, cube));
    if (cut.mesh.colours.empty()) { // files have the texture instead; what is left of it at the vertices
        for (const glm::vec2& at : cut.coordinates) cut.mesh.colours.push_back(sample(level.texture->colour, at));
        described["colours"] = true;
    }
    const bool bent = !level.texture->tangents.empty() && has_normals(*level.mesh, wedges);
    described["texture"] = {{"width", level.texture->colour.width},
                            {"height", level.texture->colour.height},
                            {"colour", atlases.add(level.texture->colour)},
                            {"normal", bent ? atlases.add(level.texture->normal) : -1}};
    return base64(packed_level(cut, largest, cube));
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
    Atlases atlases(data);
    for (const PageLevel& level : input.levels) {
        const bool included = level.mesh->triangles.size() <= options.most_triangles;
        Json described = describe(level, included);
        const std::string text = included ? pack(level, cube, described, atlases) : "";
        page.level_bytes.push_back(text.size());
        if (included)
            data += element("level-" + std::to_string(page.level_bytes.size() - 1), "text/plain", text);
        scene["levels"].push_back(std::move(described));
    }
    page.picture_bytes = atlases.bytes;
    page.html.append(whole.substr(0, mark));
    page.html += element("scene", "application/json", as_script(scene));
    page.html += data;
    page.html.append(whole.substr(mark + data_mark.size()));
    return page;
}

} // namespace glcast
