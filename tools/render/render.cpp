#include "tools/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

#include "tools/mesh/corner_split.h"
#include "tools/render/label.h"
#include "tools/render/lighting.h"
#include "tools/render/osmesa.h"

namespace glcast {
namespace {

struct SheetView {
    const char* label;
    glm::dvec3 direction; ///< the way one looks
};
constexpr std::array<SheetView, 8> sheet_views = {{
    {"-x", {1, 0, 0}},
    {"+x", {-1, 0, 0}},
    {"-y", {0, 1, 0}},
    {"+y", {0, -1, 0}},
    {"-z", {0, 0, 1}},
    {"+z", {0, 0, -1}},
    {"+x +y +z", {-1, -1, -1}},
    {"-x -y -z", {1, 1, 1}},
}};

constexpr int supersampling = 3;
constexpr std::uint8_t paper = 255, border = 205, ink = 60;
constexpr glm::vec3 plain_colour{0.7F, 0.7F, 0.7F}; // where the mesh has none
constexpr double room = 1.04;                       // a thin margin around the bounding sphere
constexpr GLfloat ambient[] = {ambient_light, ambient_light, ambient_light, 1},
                  diffuse[] = {diffuse_light, diffuse_light, diffuse_light, 1},
                  light_direction[] = {towards_light.x, towards_light.y, towards_light.z, 0};
constexpr GLfloat dark[] = {0, 0, 0, 1};

struct Sphere {
    glm::dvec3 centre{0};
    double radius = 1;
};

Sphere bounds(const Mesh& mesh) {
    if (mesh.triangles.empty()) throw std::runtime_error("cannot draw: the mesh has no triangles");
    glm::dvec3 low(mesh.positions.at(mesh.triangles[0][0])), high(low);
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            low = min(low, mesh.positions.at(v));
            high = max(high, mesh.positions.at(v));
        }
    const glm::dvec3 centre = (low + high) * 0.5;
    double radius = 0; // of the corners used, not of the box: fills the picture better
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) radius = std::max(radius, glm::distance(centre, mesh.positions[v]));
    return {centre, radius > 0 ? radius : 1};
}

/// What GL draws: floats about the centre, corners shared if there are normals, otherwise a normal per
/// triangle.
struct Drawable {
    std::vector<glm::vec3> positions, normals, colours;
    std::vector<std::uint32_t> indices;
    bool faceted = false; ///< by the normals of its triangles
};

Drawable prepare(const Mesh& mesh, const Wedges& wedges, const Sphere& sphere) {
    const auto fitted = [&](std::uint32_t v) {
        return glm::vec3((mesh.positions[v] - sphere.centre) / sphere.radius);
    };
    const bool coloured = has_colours(mesh, wedges);
    Drawable out;
    if (has_normals(mesh, wedges)) {
        const CornerSplit split = split_corners(mesh, {}, wedges);
        for (std::size_t v = 0; v < split.vertices(mesh); ++v) {
            out.positions.push_back(fitted(split.original(mesh, v)));
            out.colours.push_back(coloured ? split.colour(mesh, v) : plain_colour);
            out.normals.push_back(split.normal(mesh, v));
        }
        for (const Triangle& t : split.triangles) out.indices.insert(out.indices.end(), t.begin(), t.end());
        return out;
    }
    out.faceted = true;
    for (std::size_t number = 0; number < mesh.triangles.size(); ++number) {
        const Triangle& t = mesh.triangles[number];
        std::array<glm::vec3, 3> colours;
        colours.fill(plain_colour);
        if (coloured) colours = corner_colours(mesh, wedges, number);
        out.colours.insert(out.colours.end(), colours.begin(), colours.end());
        const glm::dvec3& a = mesh.positions[t[0]];
        const glm::dvec3 normal = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        const double length = glm::length(normal);
        for (const std::uint32_t v : t) {
            out.indices.push_back(std::uint32_t(out.positions.size()));
            out.positions.push_back(fitted(v));
            out.normals.emplace_back(length > 0 ? normal / length : normal);
        }
    }
    return out;
}

void set_up_state(const GlTable& gl, const Drawable& mesh) {
    gl.ClearColor(tile_grey, tile_grey, tile_grey, 1);
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_LIGHTING);
    gl.Enable(GL_LIGHT0);
    gl.Enable(GL_NORMALIZE);
    gl.Enable(GL_COLOR_MATERIAL);
    gl.ColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, dark);
    gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, mesh.faceted); // normals that were drawn count as they are
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadIdentity();
    gl.Lightfv(GL_LIGHT0, GL_POSITION, light_direction);
    gl.Lightfv(GL_LIGHT0, GL_AMBIENT, ambient);
    gl.Lightfv(GL_LIGHT0, GL_DIFFUSE, diffuse);
    gl.Lightfv(GL_LIGHT0, GL_SPECULAR, dark);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.EnableClientState(GL_NORMAL_ARRAY);
    gl.EnableClientState(GL_COLOR_ARRAY);
    gl.VertexPointer(3, GL_FLOAT, 0, mesh.positions.data());
    gl.NormalPointer(GL_FLOAT, 0, mesh.normals.data());
    gl.ColorPointer(3, GL_FLOAT, 0, mesh.colours.data());
}

/// y up; along y, z up.
glm::dmat4 looking(const glm::dvec3& direction) {
    const glm::dvec3 way = glm::normalize(direction);
    const glm::dvec3 up =
        std::abs(way.y) > 0.999 ? glm::dvec3(0, 0, way.y < 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
    return glm::lookAt(-2.0 * way, glm::dvec3(0), up);
}

void draw(const GlTable& gl, const Drawable& mesh, const glm::dvec3& direction, int pixels) {
    gl.Viewport(0, 0, pixels, pixels);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadIdentity();
    gl.Ortho(-room, room, -room, room, 0.5, 3.5);
    gl.MatrixMode(GL_MODELVIEW);
    const glm::dmat4 view = looking(direction);
    gl.LoadMatrixd(glm::value_ptr(view));
    gl.DrawElements(GL_TRIANGLES, GLsizei(mesh.indices.size()), GL_UNSIGNED_INT, mesh.indices.data());
}

/// Average of factor × factor pixels, turned upright, into `out` at x, y.
void shrink_into(Picture& out, int x, int y, int size, const std::vector<std::uint8_t>& rgba, int factor) {
    const int source_size = size * factor;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            for (int channel = 0; channel < 3; ++channel) {
                int sum = 0;
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i) {
                        const int from_row = source_size - 1 - (row * factor + j), from = column * factor + i;
                        sum +=
                            rgba[(std::size_t(from_row) * std::size_t(source_size) + std::size_t(from)) * 4 +
                                 std::size_t(channel)];
                    }
                const std::size_t at =
                    std::size_t(y + row) * std::size_t(out.width) + std::size_t(x + column);
                out.rgb[at * 3 + std::size_t(channel)] =
                    std::uint8_t((sum + factor * factor / 2) / (factor * factor));
            }
}

Picture blank(int width, int height, std::uint8_t grey) {
    Picture out{width, height, {}};
    out.rgb.assign(std::size_t(width) * std::size_t(height) * 3, grey);
    return out;
}

int check_size(int size) {
    if (size < 16 || size > 4096)
        throw std::runtime_error("cannot draw: the size must be between 16 and 4096 pixels");
    return size;
}

int factor_for(int size) { return std::clamp(Osmesa::largest() / size, 1, supersampling); }

struct Layout {
    int size, scale, strip; ///< a tile, the text's scale, the height of a line of text with its margins
    int width, height;
    Layout(int tile, int rows) : size(tile), scale(std::max(1, tile / 128)) {
        strip = label_height * scale + 4 * scale;
        width = int(sheet_views.size()) * (size + 1) + 1;
        height = strip + rows * (strip + size + 2);
    }
    int column(std::size_t i) const { return int(i) * (size + 1) + 1; }
    int row(std::size_t i) const { return strip + int(i) * (strip + size + 2) + strip + 1; }
};

void draw_caption(Picture& sheet, const Layout& layout, std::size_t row, const std::string& text) {
    draw_label(sheet, 4 * layout.scale, layout.row(row) - layout.strip + 2 * layout.scale, text, layout.scale,
               ink);
}

/// A row of tiles, pixel by pixel. `see`: what is seen in a view, for each column that has one.
template <class See>
void draw_tiles(Picture& sheet, const Layout& layout, std::size_t row, const Sphere& sphere,
                std::size_t columns, int factor, See&& see) {
    for (std::size_t i = 0; i < columns; ++i) {
        const OrthoView view =
            square_view(sheet_views[i].direction, sphere.centre, room * sphere.radius, layout.size * factor);
        shrink_into(sheet, layout.column(i), layout.row(row), layout.size, lit_rgba(see(i, view), view),
                    factor);
    }
}

void draw_by_osmesa(Picture& sheet, const Layout& layout, std::size_t row, const Level& of,
                    const Sphere& sphere) {
    const int factor = factor_for(layout.size), pixels = layout.size * factor;
    const Drawable mesh = prepare(of.mesh, of.wedges, sphere);
    Osmesa osmesa(pixels);
    set_up_state(osmesa.gl(), mesh);
    for (std::size_t i = 0; i < sheet_views.size(); ++i) {
        draw(osmesa.gl(), mesh, sheet_views[i].direction, pixels);
        shrink_into(sheet, layout.column(i), layout.row(row), layout.size, osmesa.finish(), factor);
    }
}

/// Textures need light per pixel.
void draw_row(Picture& sheet, const Layout& layout, std::size_t row, const Level& level,
              const Sphere& sphere) {
    draw_caption(sheet, layout, row, level_caption(level));
    if (level.texture.empty()) return draw_by_osmesa(sheet, layout, row, level, sphere);
    draw_tiles(
        sheet, layout, row, sphere, sheet_views.size(), supersampling,
        [&](std::size_t, const OrthoView& view) { return rasterise(level, view); });
}

const ViewImage& outer_view(std::span<const ViewImage> images, std::size_t column) {
    const View wanted{Axis(column / 2), column % 2 ? Side::plus : Side::minus, 0};
    for (const ViewImage& image : images)
        if (image.view == wanted) return image;
    throw std::runtime_error("cannot draw: the capture lacks a view");
}

void draw_captured(Picture& sheet, const Layout& layout, const CapturedViews& captured,
                   const Sphere& sphere) {
    draw_caption(sheet, layout, 0, captured.caption);
    draw_tiles(sheet, layout, 0, sphere, 6, supersampling, [&](std::size_t column, const OrthoView& view) {
        return resampled(outer_view(captured.images, column), captured.box, view);
    });
}

void draw_borders(Picture& sheet, const Layout& layout, std::size_t rows) {
    const auto put = [&](int x, int y) {
        std::fill_n(&sheet.rgb[(std::size_t(y) * std::size_t(sheet.width) + std::size_t(x)) * 3], 3, border);
    };
    for (std::size_t row = 0; row < rows; ++row) {
        const int top = layout.row(row) - 1, bottom = layout.row(row) + layout.size;
        for (int x = 0; x < sheet.width; ++x) put(x, top), put(x, bottom);
        for (std::size_t i = 0; i <= sheet_views.size(); ++i)
            for (int y = top; y <= bottom; ++y) put(layout.column(i) - 1, y);
    }
}

} // namespace

Picture contact_sheet(std::span<const Level> levels, int size, const CapturedViews* captured) {
    if (levels.empty()) throw std::runtime_error("cannot draw: there is no mesh");
    const std::size_t first = captured ? 1 : 0, rows = first + levels.size();
    const Layout layout(check_size(size), int(rows));
    const Sphere sphere = bounds(levels.front().mesh);
    Picture sheet = blank(layout.width, layout.height, paper);
    for (std::size_t i = 0; i < sheet_views.size(); ++i)
        draw_label(sheet, layout.column(i) + (size - label_width(sheet_views[i].label, layout.scale)) / 2,
                   2 * layout.scale, sheet_views[i].label, layout.scale, ink);
    if (captured) draw_captured(sheet, layout, *captured, sphere);
    for (std::size_t k = 0; k < levels.size(); ++k) draw_row(sheet, layout, first + k, levels[k], sphere);
    draw_borders(sheet, layout, rows);
    return sheet;
}

Picture picture(const Mesh& mesh, const glm::dvec3& direction, int size) {
    const int factor = factor_for(check_size(size));
    if (!(glm::length(direction) > 0)) throw std::runtime_error("cannot draw: no direction to look in");
    const Drawable drawable = prepare(mesh, {}, bounds(mesh));
    Osmesa osmesa(size * factor);
    set_up_state(osmesa.gl(), drawable);
    draw(osmesa.gl(), drawable, direction, size * factor);
    Picture out = blank(size, size, paper);
    shrink_into(out, 0, 0, size, osmesa.finish(), factor);
    return out;
}

Picture picture(const Level& level, const glm::dvec3& direction, int size) {
    if (!(glm::length(direction) > 0)) throw std::runtime_error("cannot draw: no direction to look in");
    const Sphere sphere = bounds(level.mesh);
    const OrthoView view =
        square_view(direction, sphere.centre, room * sphere.radius, check_size(size) * supersampling);
    Picture out = blank(size, size, paper);
    shrink_into(out, 0, 0, size, lit_rgba(rasterise(level, view), view), supersampling);
    return out;
}

} // namespace glcast
