#include "tools/texture/wedge_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tools/deviation/surface_index.h"
#include "tools/mesh/point_triangle.h"
#include "tools/texture/conjugate_gradients.h"
#include "tools/texture/corner_groups.h"
#include "tools/texture/shading_normals.h"
#include "tools/texture/views.h"

namespace glcast {
namespace {

constexpr double smooth = 1e-3; // of a triangle's area: carries values to where nothing is shown
constexpr double anchor = 1e-6; // of the area: holds the vertices' own where nothing is shown around either
constexpr double crumb = 1e-9;  // samples squared: triangles without area count as so much

/// The wedges of a level as unknowns: which corners they are, and the normal equations.
class Equations {
  public:
    Equations(const std::vector<FaceSums>& faces, const std::vector<Triangle>& corners, std::size_t wedges)
        : faces(faces), corners(corners), start(wedges + 1), diagonal(wedges) {
        for (const Triangle& t : corners)
            for (const std::uint32_t w : t) ++start[w + 1];
        for (std::size_t w = 1; w < start.size(); ++w) start[w] += start[w - 1];
        around.resize(start.back());
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        for (std::uint32_t t = 0; t < corners.size(); ++t)
            for (std::uint32_t k = 0; k < 3; ++k) around[next[corners[t][k]]++] = 3 * t + k;
        for (std::size_t w = 0; w < wedges; ++w)
            for (const std::uint32_t corner : of(w))
                diagonal[w] += entry(corner / 3, corner % 3, corner % 3) + anchor * area(corner / 3);
        for (double& d : diagonal) d = 1 / std::sqrt(d);
    }

    std::span<const std::uint32_t> of(std::size_t wedge) const {
        return {around.data() + start[wedge], start[wedge + 1] - start[wedge]};
    }
    double area(std::size_t triangle) const { return std::max(faces[triangle].area, crumb); }
    std::size_t size() const { return diagonal.size(); }

    /// `right`: the sums of a triangle; `own`: what the wedges have now.
    template <class Right> Vectors solved(const Right& right, const Vectors& own) const {
        Vectors scaled(size(), glm::dvec3(0));
        for (std::size_t w = 0; w < size(); ++w) {
            for (const std::uint32_t corner : of(w))
                scaled[w] += right(faces[corner / 3])[corner % 3] + anchor * area(corner / 3) * own[w];
            scaled[w] *= diagonal[w];
        }
        Vectors x = conjugate_gradients(scaled, [&](const Vectors& v) { return times(v); });
        for (std::size_t w = 0; w < size(); ++w) x[w] *= diagonal[w];
        return x;
    }

  private:
    double entry(std::size_t t, std::size_t k, std::size_t l) const {
        return faces[t].products[int(k)][int(l)] + smooth * area(t) * ((k == l) - 1 / 3.0);
    }
    /// Scaled from both sides, so that small triangles take no longer than large ones.
    Vectors times(const Vectors& x) const {
        Vectors out(x.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, x.size(), 1024), [&](const auto& range) {
            for (std::size_t w = range.begin(); w < range.end(); ++w) {
                glm::dvec3 sum(0);
                for (const std::uint32_t corner : of(w)) {
                    const std::size_t t = corner / 3;
                    for (std::size_t l = 0; l < 3; ++l) {
                        const std::uint32_t other = corners[t][l];
                        sum += entry(t, corner % 3, l) * diagonal[other] * x[other];
                    }
                    sum += anchor * area(t) * diagonal[w] * x[w];
                }
                out[w] = diagonal[w] * sum;
            }
        });
        return out;
    }

    const std::vector<FaceSums>& faces;
    const std::vector<Triangle>& corners;
    std::vector<std::uint32_t> start, around; ///< corners by wedge
    std::vector<double> diagonal;             ///< 1 / its root
};

/// The values of the vertices, by wedge.
Vectors own_values(const std::vector<glm::vec3>& values, const Mesh& mesh,
                   const std::vector<Triangle>& corners, std::size_t wedges) {
    Vectors own(wedges, glm::dvec3(0));
    if (values.empty()) return own;
    for (std::size_t t = 0; t < corners.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) own[corners[t][k]] = values[mesh.triangles[t][k]];
    return own;
}

std::vector<glm::vec3> units(const Vectors& fitted, const Vectors& own) {
    std::vector<glm::vec3> out(fitted.size());
    for (std::size_t w = 0; w < out.size(); ++w) {
        const double length = glm::length(fitted[w]);
        out[w] = length > 1e-3 ? glm::vec3(fitted[w] / length) : glm::vec3(own[w]);
    }
    return out;
}

std::vector<glm::vec3> in_range(const Vectors& fitted) {
    std::vector<glm::vec3> out(fitted.size());
    for (std::size_t w = 0; w < out.size(); ++w) out[w] = glm::vec3(glm::clamp(fitted[w], 0.0, 1.0));
    return out;
}

/// The vertices get the values of their largest wedges; true where one has several.
bool take_largest(Mesh& mesh, const Wedges& wedges, const std::vector<FaceSums>& faces) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<double> area(wedges.normals.size());
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (const std::uint32_t w : wedges.corners[t]) area[w] += faces[t].area;
    std::vector<std::uint32_t> largest(mesh.positions.size(), none);
    bool several = false;
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& best = largest[mesh.triangles[t][k]];
            const std::uint32_t w = wedges.corners[t][k];
            several = several || (best != none && best != w);
            if (best == none || area[w] > area[best]) best = w;
        }
    mesh.normals.resize(mesh.positions.size(), glm::vec3(0, 0, 1));
    mesh.colours.resize(mesh.positions.size(), glm::vec3(0));
    for (std::size_t v = 0; v < largest.size(); ++v) {
        if (largest[v] == none) continue;
        mesh.normals[v] = wedges.normals[largest[v]];
        mesh.colours[v] = wedges.colours[largest[v]];
    }
    return several;
}

/// Whatever the sums are of.
void fit_to(const std::vector<FaceSums>& faces, Level& level, const std::vector<glm::vec3>& normals,
            const WedgeOptions& options) {
    Mesh& mesh = level.mesh;
    const Neighbours neighbours = find_neighbours(mesh);
    Wedges wedges;
    std::uint32_t count = 0;
    wedges.corners =
        group_corners(mesh, neighbours, faces, normals, {options.degrees, options.colour}, count);
    const Equations equations(faces, wedges.corners, count);
    const Vectors own_normals = own_values(mesh.normals, mesh, wedges.corners, count);
    wedges.normals =
        units(equations.solved([](const FaceSums& f) { return f.normal; }, own_normals), own_normals);
    wedges.colours = in_range(equations.solved([](const FaceSums& f) { return f.colour; },
                                               own_values(mesh.colours, mesh, wedges.corners, count)));
    bound_normals(mesh, wedges, normals, options.farthest_degrees);
    if (take_largest(mesh, wedges, faces)) level.wedges = std::move(wedges);
}

/// Length of a sample, by the surface that has about a vertex for each.
double sample_of(const Mesh& surface) {
    double area = 0;
    for (const Triangle& t : surface.triangles) {
        const glm::dvec3& a = surface.positions[t[0]];
        area += glm::length(glm::cross(surface.positions[t[1]] - a, surface.positions[t[2]] - a)) / 2;
    }
    return std::sqrt(area / double(surface.positions.size()));
}

/// Of the triangles that face as asked, the nearest point.
CapturedPoint look_at(const Mesh& surface, const SurfaceIndex& index, const glm::dvec3& point,
                      const glm::vec3& facing) {
    const std::uint32_t t = index.nearest_facing(point, facing, index.nearest(point)).triangle;
    const std::array<glm::dvec3, 3> corners = index.corners(t);
    const TrianglePoint at = nearest_in_triangle(point, corners[0], corners[1], corners[2]);
    CapturedPoint seen{at.point};
    for (int k = 0; k < 3; ++k) {
        seen.normal += float(at.weights[k]) * surface.normals[surface.triangles[t][std::size_t(k)]];
        seen.colour += float(at.weights[k]) * surface.colours[surface.triangles[t][std::size_t(k)]];
    }
    const float length = glm::length(seen.normal);
    seen.found = length > 1e-6f;
    if (seen.found) seen.normal *= 1 / length;
    return seen;
}

} // namespace

void fit_wedges(Level& level, const CapturedSurface& captured, const WedgeOptions& options) {
    level.wedges = {};
    if (captured.empty() || level.mesh.triangles.empty()) return;
    const std::vector<glm::vec3> normals = triangle_normals(level.mesh);
    fit_to(sum_faces(level.mesh, captured, normals), level, normals, options);
}

void fit_wedges(Level& level, const Mesh& surface, const WedgeOptions& options) {
    level.wedges = {};
    if (level.mesh.triangles.empty() || surface.triangles.empty() || surface.normals.empty() ||
        surface.colours.empty())
        return;
    const SurfaceIndex index(surface, SurfaceIndex::Tree::quick);
    const std::vector<glm::vec3> normals = triangle_normals(level.mesh);
    const auto look = [&](const glm::dvec3& point, const glm::vec3& facing) {
        return look_at(surface, index, point, facing);
    };
    fit_to(sum_faces(level.mesh, look, sample_of(surface), normals), level, normals, options);
}

} // namespace glcast
