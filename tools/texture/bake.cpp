#include "tools/texture/bake.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <stdexcept>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tools/mesh/point_triangle.h"
#include "tools/texture/fill.h"
#include "tools/texture/owners.h"
#include "tools/texture/reach.h"
#include "tools/texture/shading_normals.h"
#include "tools/texture/tangents.h"

namespace glcast {
namespace {

constexpr double crumb = 64;        // samples squared: a chart costs more than that in gutter
constexpr int block = 32;           // texels
constexpr int most_looks = 3;
constexpr float flat_frame = 0.05f; // determinant of a tangent frame too skewed to write a normal in

struct Layout {
    Charts charts;
    Atlas atlas;
    std::vector<glm::vec3> triangle_normals;
};

void check(const Mesh& mesh, const CapturedSurface& captured, const TextureOptions& options) {
    if (options.size < smallest_texture || options.size > largest_texture ||
        !std::has_single_bit(unsigned(options.size)))
        throw std::runtime_error("a texture has 64, 128, 256, ... or 8192 texels along an edge, not " +
                                 std::to_string(options.size));
    if (options.gutter < 2 || options.gutter > 64)
        throw std::runtime_error("the gutter between charts must be 2 to 64 texels");
    if (!(options.texels_per_sample > 0 && options.texels_per_sample <= 1))
        throw std::runtime_error("a texture has more than 0 and at most 1 texel a sample");
    if (mesh.triangles.empty()) throw std::runtime_error("there is no surface to texture");
    if (captured.empty()) throw std::runtime_error("there is no captured surface to take a texture from");
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-6f ? v * (1 / length) : otherwise;
}

/// A normal in the tangent frame of a point as viewers make it: the interpolated normal, tangent and
/// bitangent, each of unit length again, though no longer square to one another.
glm::vec3 in_frame(const glm::vec3& wanted, const glm::vec3& normal, const glm::vec3& tangent,
                   const glm::vec3& bitangent) {
    const glm::vec3 square_to_tangent = glm::cross(bitangent, normal);
    const float determinant = glm::dot(tangent, square_to_tangent);
    if (std::abs(determinant) < flat_frame) {
        const glm::vec3 t = unit_or(tangent - normal * glm::dot(normal, tangent), tangent);
        glm::mat3 frame(t, glm::cross(normal, t), normal);
        if (glm::dot(frame[1], bitangent) < 0) frame[1] = -frame[1];
        return unit_or(wanted * frame, {0, 0, 1}); // its transpose: the inverse of what is square
    }
    // Cramer's rule; of the determinant the sign is enough, as the length is 1 again.
    const glm::vec3 within(glm::dot(square_to_tangent, wanted), glm::dot(glm::cross(normal, tangent), wanted),
                           glm::dot(glm::cross(tangent, bitangent), wanted));
    return unit_or(determinant < 0 ? -within : within, {0, 0, 1});
}

void put(Picture& picture, std::size_t texel, const glm::vec3& value) {
    for (int c = 0; c < 3; ++c)
        picture.rgb[3 * texel + c] = std::uint8_t(double(std::clamp(value[c], 0.0f, 1.0f) * 255) + 0.5);
}

class Baker {
  public:
    Baker(const Mesh& mesh, const Wedges& wedges, const CapturedSurface& captured, const Layout& layout,
          double reach, Texture& texture)
        : mesh(mesh), wedges(wedges), captured(captured), layout(layout), texture(texture), reach(reach),
          looks(std::clamp(int(std::round(1 / (layout.atlas.density * captured.sample()))), 1, most_looks)) {}

    struct Done {
        bool covered, seen; ///< the texel's centre is on the triangle; a ray saw the surface there
    };
    Done bake(int x, int y, std::uint32_t t) {
        if (t != facet.triangle) facet = facet_of(t);
        Texel sum{glm::vec3(0), glm::vec3(0), true};
        int count = 0;
        for (int j = 0; j < looks; ++j)
            for (int i = j % 2; i < looks; i += 2, ++count) {
                const Texel part = look({x + (i + 0.5) / looks, y + (j + 0.5) / looks}, t);
                sum.colour += part.colour, sum.normal += part.normal, sum.seen = sum.seen && part.seen;
            }
        const std::size_t texel = std::size_t(y) * texture.colour.width + x;
        put(texture.colour, texel, sum.colour / float(count));
        put(texture.normal, texel, 0.5f + 0.5f * unit_or(sum.normal, {0, 0, 1}));
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        const glm::dvec3 off = in_triangle(centre).point - glm::dvec3(centre, 0);
        return {std::abs(off.x) + std::abs(off.y) < 1e-6, sum.seen};
    }

  private:
    /// What the texels of one triangle share, which mostly follow one another.
    struct Facet {
        std::uint32_t triangle = no_triangle;
        std::array<glm::dvec2, 3> corners;
        glm::dvec2 slope[2]; ///< of the weights of corners 1 and 2; 0: it has no area
        std::array<glm::vec3, 3> normal;
        glm::vec3 tangent[3], bitangent[3];
    };
    Facet facet_of(std::uint32_t t) const {
        Facet made{t, in_atlas(mesh, layout.charts, layout.atlas, t), {}, corner_normals(mesh, wedges, t), {}, {}};
        const glm::dvec2 a = made.corners[1] - made.corners[0], b = made.corners[2] - made.corners[0];
        if (const double area = a.x * b.y - a.y * b.x; area != 0) {
            made.slope[0] = glm::dvec2(b.y, -b.x) / area;
            made.slope[1] = glm::dvec2(-a.y, a.x) / area;
        }
        for (int k = 0; k < 3; ++k) {
            const glm::vec4& own = texture.tangents[t][k];
            made.tangent[k] = glm::vec3(own);
            made.bitangent[k] = own.w * glm::cross(made.normal[k], made.tangent[k]);
        }
        return made;
    }

    struct Texel {
        glm::vec3 colour, normal; ///< the normal in the tangent frame
        bool seen;
    };
    /// What shows at a point of the atlas that belongs to triangle t.
    Texel look(const glm::dvec2& at, std::uint32_t t) const {
        const Triangle& v = mesh.triangles[t];
        const glm::dvec3 w = in_triangle(at).weights;
        const glm::vec3 weight(w);
        const glm::dvec3 point =
            w.x * mesh.positions[v[0]] + w.y * mesh.positions[v[1]] + w.z * mesh.positions[v[2]];
        const auto mix = [&](const auto& a, const auto& b, const auto& c) {
            return weight.x * a + weight.y * b + weight.z * c;
        };
        const glm::vec3 normal =
            unit_or(mix(facet.normal[0], facet.normal[1], facet.normal[2]), facet.normal[0]);
        const glm::vec3 facing =
            layout.triangle_normals[t] != glm::vec3(0) ? layout.triangle_normals[t] : normal;
        const CapturedPoint seen = captured.look(point, normal, facing, reach);
        if (seen.found) return {seen.colour, encoded(mix, normal, seen.normal), !seen.behind};
        return {mesh.colours.empty() ? glm::vec3(0.5f)
                                     : mix(mesh.colours[v[0]], mesh.colours[v[1]], mesh.colours[v[2]]),
                glm::vec3(0, 0, 1), false};
    }

    /// The point of the atlas, or the nearest one of the triangle.
    TrianglePoint in_triangle(const glm::dvec2& at) const {
        const glm::dvec2 from = at - facet.corners[0];
        const double w1 = glm::dot(facet.slope[0], from), w2 = glm::dot(facet.slope[1], from);
        if (w1 > 0 && w2 > 0 && w1 + w2 < 1) return {{1 - w1 - w2, w1, w2}, {at, 0}};
        const auto& c = facet.corners;
        return nearest_in_triangle({at, 0}, {c[0], 0}, {c[1], 0}, {c[2], 0});
    }

    template <class Mix>
    glm::vec3 encoded(const Mix& mix, const glm::vec3& normal, const glm::vec3& wanted) const {
        const auto &t = facet.tangent, &b = facet.bitangent;
        return in_frame(wanted, normal, unit_or(mix(t[0], t[1], t[2]), t[0]), unit_or(mix(b[0], b[1], b[2]), b[0]));
    }

    const Mesh& mesh;
    const Wedges& wedges;
    const CapturedSurface& captured;
    const Layout& layout;
    Texture& texture;
    const double reach;
    const int looks; ///< at a texel, along an axis: one a sample that it covers; every other one is made, as on
                     ///< a chessboard, since each mixes its neighbours
    Facet facet{};
};

Picture blank(int size) { return {size, size, std::vector<std::uint8_t>(std::size_t(size) * size * 3)}; }

void bake_texels(const Mesh& mesh, const Wedges& wedges, const CapturedSurface& captured, const Layout& layout,
                 const std::vector<std::uint32_t>& owners, Texture& texture, TextureReport& made) {
    const int size = layout.atlas.size;
    texture.colour = blank(size);
    texture.normal = blank(size);
    std::vector<std::uint8_t> known(owners.size());
    const double reach = needed_reach(mesh, captured, layout.triangle_normals);
    std::atomic<std::size_t> texels = 0, unseen = 0;
    // Square by square: what one row reads of a large mesh is still in the caches for the next.
    const int across = (size + block - 1) / block;
    tbb::parallel_for(0, across * across, [&](int number) {
        Baker baker(mesh, wedges, captured, layout, reach, texture);
        std::size_t mine = 0, missed = 0;
        const int x0 = number % across * block, y0 = number / across * block;
        for (int y = y0; y < std::min(y0 + block, size); ++y)
            for (int x = x0; x < std::min(x0 + block, size); ++x) {
                const std::uint32_t owner = owners[std::size_t(y) * size + x];
                if (owner == no_triangle) continue;
                known[std::size_t(y) * size + x] = 1;
                const Baker::Done done = baker.bake(x, y, owner);
                mine += done.covered;
                missed += done.covered && !done.seen;
            }
        texels += mine;
        unseen += missed;
    });
    made.texels = texels;
    made.texels_unseen = unseen;
    fill_unknown(texture.colour, known);
    fill_unknown(texture.normal, known);
}

/// The mesh cut open where its wedges end, as far as tangents are concerned.
Mesh cut_at_wedges(const Mesh& mesh, const Wedges& wedges) {
    Mesh cut;
    cut.normals = wedges.normals;
    cut.triangles = wedges.corners;
    cut.positions.resize(wedges.normals.size());
    for (std::size_t t = 0; t < cut.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) cut.positions[cut.triangles[t][k]] = mesh.positions[mesh.triangles[t][k]];
    return cut;
}

/// `wedges`: with normals to be shaded with.
Texture baked(const Mesh& mesh, const Wedges& wedges, const Neighbours& neighbours, const CapturedSurface& captured,
              const std::vector<glm::vec3>& normals, const TextureOptions& options, TextureReport* report) {
    const double sample = captured.sample();
    const glm::dvec3 origin = captured.first_sample();
    TextureReport made;
    Texture texture;
    Layout layout;
    layout.triangle_normals = normals;
    layout.charts =
        make_charts(mesh, neighbours, choose_views(mesh, neighbours, normals, crumb * sample * sample), sample, origin);
    layout.atlas = (options.smallest ? pack_tightly : pack)(layout.charts, options.size, options.gutter,
                                                            options.texels_per_sample / sample, origin);
    const auto owners = find_owners(mesh, neighbours, layout.charts, layout.atlas, texture.coordinates);
    if (wedges.empty())
        texture.tangents = make_tangents(mesh, neighbours, layout.charts.of, texture.coordinates);
    else {
        const Mesh cut = cut_at_wedges(mesh, wedges);
        texture.tangents = make_tangents(cut, find_neighbours(cut), layout.charts.of, texture.coordinates);
    }
    bake_texels(mesh, wedges, captured, layout, owners, texture, made);

    made.charts = layout.charts.charts.size();
    made.size = layout.atlas.size;
    made.gutter = layout.atlas.gutter;
    made.texels_per_sample = layout.atlas.density * sample;
    if (report) *report = made;
    return texture;
}

} // namespace

Texture bake_texture(Mesh& mesh, const CapturedSurface& captured, const TextureOptions& options,
                     TextureReport* report) {
    check(mesh, captured, options);
    const Neighbours neighbours = find_neighbours(mesh);
    const std::vector<glm::vec3> normals = triangle_normals(mesh);
    make_shading_normals(mesh, neighbours, normals);
    return baked(mesh, {}, neighbours, captured, normals, options, report);
}

void bake_texture(Level& level, const CapturedSurface& captured, const TextureOptions& options,
                  TextureReport* report) {
    level.wedges.colours.clear();
    if (level.wedges.normals.empty()) {
        level.wedges = {};
        level.texture = bake_texture(level.mesh, captured, options, report);
        return;
    }
    check(level.mesh, captured, options);
    const Neighbours neighbours = find_neighbours(level.mesh);
    const std::vector<glm::vec3> normals = triangle_normals(level.mesh);
    make_shading_normals(level.mesh, neighbours, level.wedges, normals);
    level.texture = baked(level.mesh, level.wedges, neighbours, captured, normals, options, report);
}

} // namespace glcast
