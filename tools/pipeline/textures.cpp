#include "tools/pipeline/textures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "tools/deviation/area_samples.h"
#include "tools/deviation/shown.h"
#include "tools/texture/atlas.h"
#include "tools/texture/colour_patches.h"
#include "tools/texture/reach.h"
#include "tools/texture/views.h"

namespace glcast {
namespace {

constexpr std::size_t points = 20'000;
/// Light that a normal changes, of the change of the normal: a lamp of .45 at the viewer, one of .25 a third
/// of a right angle beside it, seen from anywhere.
constexpr float light_of_normal = 0.37f;
/// More is visible: with an outline that is right this leaves 43 dB of a picture that the object fills.
constexpr double visible = 0.007;
constexpr double hardly_worse = 1.1; // times what the colours of corners are off

// Texels average what is drawn: light of a mean normal is no mean of light, and in a small picture a texel
// spans much that differs. Four instead of two a pixel bring geomview's t.off, at 32 pixels, from 37.8
// to 43.8 dB.
constexpr double texels_a_pixel = 2, texels_of_small = 4, small_picture = 64;

double squared_difference(const Shown& shown, const CapturedPoint& captured, float brightest) {
    const glm::vec3 colour = shown.colour - captured.colour;
    // A normal that faces away is lit from behind, by either.
    const float turned =
        std::min(glm::distance(shown.normal, captured.normal), glm::distance(shown.normal, -captured.normal));
    const float light = light_of_normal * brightest * turned;
    return double(glm::dot(colour, colour) / 3 + light * light);
}

TextureReport bake(Level& level, const CapturedSurface& captured, TextureOptions options) {
    const Level before = level;
    TextureReport report;
    for (;; options.size *= 2) try {
            bake_texture(level, captured, options, &report);
            return report;
        } catch (const AtlasTooSmall&) {
            level = before;
            if (options.size >= largest_texture) throw;
        }
}

/// A plain colour a triangle, where that shows it as well. Materials are what every reader shows; colours of
/// vertices are left out by Blender 3.4 and Godot 3.2.
bool take_materials(Level& level, const CapturedSurface& captured, TextureChoice::Kind kind) {
    Level plain = level;
    if (!take_patch_colours(plain)) return false;
    const double wrong = shown_error(plain, captured);
    if (wrong > visible &&
        (kind == TextureChoice::Kind::by_need || wrong > hardly_worse * shown_error(level, captured)))
        return false;
    level = std::move(plain);
    return true;
}

/// A texture would hold no more than they do, as in the full surface.
bool has_vertex_a_sample(const Level& level) {
    double area = 0;
    for (const Triangle& t : level.mesh.triangles) {
        const glm::dvec3& a = level.mesh.positions[t[0]];
        area += glm::length(glm::cross(level.mesh.positions[t[1]] - a, level.mesh.positions[t[2]] - a)) / 2;
    }
    return level.sample > 0 &&
           2 * double(level.mesh.positions.size()) >= area / (level.sample * level.sample);
}

} // namespace

double shown_error(const Level& level, const CapturedSurface& captured) {
    const std::vector<AreaSample> samples = area_samples(level.mesh, points);
    const double reach = needed_reach(level.mesh, captured, triangle_normals(level.mesh));
    std::vector<double> squares(samples.size(), -1);
    tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t i) {
        const glm::vec3 facing(samples[i].normal);
        if (facing == glm::vec3(0)) return;
        const CapturedPoint seen = captured.look(samples[i].position, facing, facing, reach);
        if (!seen.found) return;
        const float brightest = std::max({seen.colour.x, seen.colour.y, seen.colour.z});
        squares[i] =
            squared_difference(shown(level, samples[i].triangle, samples[i].weights), seen, brightest);
    });
    std::erase(squares, -1);
    double sum = 0;
    for (const double square : squares) sum += square;
    return squares.empty() ? 0 : std::sqrt(sum / double(squares.size()));
}

std::optional<TextureReport> texture_level(Level& level, const CapturedSurface& captured,
                                           const TextureChoice& choice, std::string& why_not) {
    using Kind = TextureChoice::Kind;
    if (choice.kind != Kind::sized && take_materials(level, captured, choice.kind)) return {};
    if (choice.kind == Kind::none) return {};
    if (choice.kind == Kind::by_need && has_vertex_a_sample(level) && shown_error(level, captured) <= visible)
        return {};
    TextureOptions options;
    if (choice.kind == Kind::by_need) {
        options.size = largest_texture / 2;
        options.smallest = true;
        if (level.pixels > 0)
            options.texels_per_sample =
                std::min(1.0, (level.pixels > small_picture ? texels_a_pixel : texels_of_small) *
                                  level.pixels / captured.resolution());
    } else
        options.size = choice.size;
    try {
        return bake(level, captured, options);
    } catch (const AtlasTooSmall&) {
        why_not = level.name + " keeps the colours of its vertices: its texture has too many charts for " +
                  std::to_string(largest_texture) + " x " + std::to_string(largest_texture) + " texels";
        return {};
    }
}

} // namespace glcast
