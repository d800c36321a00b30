#include "tests/paper/figures.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <span>

#include "fixtures/shapes.h"
#include "tests/paper/cast.h"
#include "tools/render/render.h"

namespace glcast::paper {
namespace {

constexpr int tile = 300;
const glm::dvec3 from_front(0.45, 0.75, -0.5);

Mesh cast_of(const Mesh& drawn, int n, SurfaceMethod method, bool geometric_normals = false) {
    return reconstruct_capture(capture_mesh(drawn, n), method, Views::all_layers, geometric_normals).mesh;
}

/// Every triangle with corners and a normal of its own: cubes look like cubes.
Mesh faceted(const Mesh& mesh) {
    Mesh result;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const auto first = std::uint32_t(result.positions.size());
        for (const std::uint32_t v : t) {
            result.positions.push_back(mesh.positions[v]);
            result.normals.push_back(glm::vec3(glm::normalize(glm::cross(b - a, c - a))));
            result.colours.push_back(mesh.colours.empty() ? glm::vec3(0.8f) : mesh.colours[v]);
        }
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

/// The triangles whose middle `keep` likes.
Mesh part(const Mesh& mesh, const std::function<bool(const glm::dvec3&)>& keep) {
    Mesh result = mesh;
    result.triangles.clear();
    for (const Triangle& t : mesh.triangles)
        if (keep((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0))
            result.triangles.push_back(t);
    std::vector<std::uint32_t> number(mesh.positions.size(), UINT32_MAX);
    Mesh packed; // what is left out must not count in the fit of the picture
    for (Triangle t : result.triangles) {
        for (std::uint32_t& v : t) {
            if (number[v] == UINT32_MAX) {
                number[v] = std::uint32_t(packed.positions.size());
                packed.positions.push_back(mesh.positions[v]);
                if (!mesh.normals.empty()) packed.normals.push_back(mesh.normals[v]);
                if (!mesh.colours.empty()) packed.colours.push_back(mesh.colours[v]);
            }
            v = number[v];
        }
        packed.triangles.push_back(t);
    }
    return packed;
}

using Strip = std::vector<Picture>;

void write_rows(const std::filesystem::path& path, std::span<const Strip> rows) {
    std::size_t columns = 0;
    for (const Strip& row : rows) columns = std::max(columns, row.size());
    Picture sheet{int(columns) * tile, int(rows.size()) * tile, {}};
    sheet.rgb.assign(std::size_t(sheet.width) * std::size_t(sheet.height) * 3, 255);
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < rows[r].size(); ++c)
            for (std::size_t y = 0; y < std::size_t(tile); ++y)
                std::copy_n(rows[r][c].rgb.begin() + std::ptrdiff_t(y * tile * 3), tile * 3,
                            sheet.rgb.begin() +
                                std::ptrdiff_t(((r * tile + y) * columns * tile + c * tile) * 3));
    write_png(path, sheet);
}

Picture view(const Mesh& mesh, const glm::dvec3& direction = from_front) {
    return picture(mesh, direction, tile);
}

/// The spout from above: original, the paper's cubes, contour.
Strip spouts() {
    const Mesh teapot = fixtures::truth("teapot");
    const auto spout = [](const glm::dvec3& p) { return p.x > 1.9; };
    Strip strip;
    for (const Mesh& mesh : {teapot, faceted(cast_of(teapot, 160, SurfaceMethod::cubes)),
                             cast_of(teapot, 160, SurfaceMethod::contour)})
        strip.push_back(view(part(mesh, spout), {-0.35, 0.5, -0.8}));
    return strip;
}

/// Original and casts; the right half cut away beside them, to show what is inside.
Strip outside_and_cut(const std::string& shape, int n) {
    const Mesh drawn = fixtures::truth(shape), cast = cast_of(drawn, n, SurfaceMethod::contour);
    const auto behind = [](const glm::dvec3& p) { return p.y > 0; };
    return {view(drawn), view(cast), view(part(drawn, behind), {0, 1, -0.2}),
            view(part(cast, behind), {0, 1, -0.2})};
}

/// Original, normals as drawn, normals of the surface.
Strip invalid_normals() {
    const Mesh drawn = fixtures::truth("knob");
    return {view(drawn), view(cast_of(drawn, 160, SurfaceMethod::contour)),
            view(cast_of(drawn, 160, SurfaceMethod::contour, true))};
}

Strip resolutions(const std::string& shape, SurfaceMethod method) {
    const Mesh drawn = fixtures::truth(shape);
    Strip strip;
    for (const int n : {20, 40, 160}) strip.push_back(view(faceted(cast_of(drawn, n, method))));
    strip.push_back(view(drawn));
    return strip;
}

} // namespace

void write_figures(const std::filesystem::path& folder) {
    const auto write = [&](int number, std::vector<Strip> rows) {
        write_rows(folder / ("paper-figure-" + std::to_string(number) + ".png"), rows);
    };
    write(1, {spouts()});
    write(2, {outside_and_cut("twopot", 160)});
    write(3, {outside_and_cut("spheres", 160)});
    write(4, {invalid_normals()});
    write(5, {resolutions("spheres", SurfaceMethod::cubes), resolutions("spheres", SurfaceMethod::contour),
              resolutions("twopot", SurfaceMethod::cubes), resolutions("twopot", SurfaceMethod::contour)});
}

} // namespace glcast::paper
