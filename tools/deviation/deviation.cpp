#include "tools/deviation/deviation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "tools/deviation/area_samples.h"
#include "tools/deviation/surface_index.h"

namespace glcast {
namespace {

constexpr std::uint32_t no_triangle = UINT32_MAX;

struct Samples {
    std::vector<SurfacePoint> points; ///< by area, then face centres, then vertices
    /// The same, but vertices a little inside their largest triangle: at the bottom of a crease a vertex lies
    /// on its other triangles, which would hide it.
    std::vector<SurfacePoint> look_from;
    std::size_t first_vertex = 0;
};

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

/// Normal of a triangle, as long as twice its area.
glm::dvec3 area_normal(const Mesh& mesh, const Triangle& t) {
    const glm::dvec3& a = mesh.positions.at(t[0]);
    return cross(mesh.positions.at(t[1]) - a, mesh.positions.at(t[2]) - a);
}

glm::dvec3 centre(const Mesh& mesh, const Triangle& t) {
    return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
}

/// For each vertex its largest triangle.
std::vector<std::uint32_t> largest_triangles(const Mesh& mesh) {
    std::vector<std::uint32_t> largest(mesh.positions.size(), no_triangle);
    std::vector<double> area(mesh.positions.size(), -1);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::dvec3 normal = area_normal(mesh, mesh.triangles[i]);
        for (const std::uint32_t v : mesh.triangles[i])
            if (dot(normal, normal) > area[v]) area[v] = dot(normal, normal), largest[v] = i;
    }
    return largest;
}

Samples sample(const Mesh& mesh, std::size_t by_area) {
    Samples samples;
    samples.points = sample_by_area(mesh, by_area);
    for (const Triangle& t : mesh.triangles)
        samples.points.push_back({centre(mesh, t), unit(area_normal(mesh, t))});
    samples.first_vertex = samples.points.size();
    samples.look_from = samples.points;
    const std::vector<std::uint32_t> largest = largest_triangles(mesh);
    for (std::size_t v = 0; v < largest.size(); ++v) {
        if (largest[v] == no_triangle) continue;
        const Triangle& t = mesh.triangles[largest[v]];
        const glm::dvec3 &at = mesh.positions[v], normal = unit(area_normal(mesh, t));
        samples.points.push_back({at, normal});
        samples.look_from.push_back({at + 0.01 * (centre(mesh, t) - at), normal});
    }
    return samples;
}

/// In an order in which neighbours follow one another late, so that a point in the open finds a free one
/// soon.
std::vector<glm::dvec3> fibonacci_sphere(int count) {
    if (count < 1) throw std::runtime_error("cannot measure: needs at least one direction to look from");
    std::vector<glm::dvec3> directions;
    const std::size_t n = std::size_t(count);
    std::size_t stride = std::size_t(double(n) / std::numbers::phi) | 1;
    while (std::gcd(stride, n) != 1) ++stride;
    for (std::size_t k = 0; k < n; ++k) {
        const double i = double(k * stride % n);
        const double z = 1 - (2 * i + 1) / double(n), r = std::sqrt(1 - z * z),
                     angle = 2 * std::numbers::pi * i / std::numbers::phi;
        directions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    return directions;
}

std::vector<char> visible(const SurfaceIndex& index, std::span<const SurfacePoint> points, int count) {
    const std::vector<glm::dvec3> directions = fibonacci_sphere(count);
    std::vector<char> seen(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        seen[i] = index.seen(points[i].position, points[i].normal, directions);
    });
    return seen;
}

double angle_degrees(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(cross(a, b)), std::abs(dot(a, b))) * 180 / std::numbers::pi;
}

DistanceStats summary(std::vector<double>& distances) {
    DistanceStats stats;
    stats.points = distances.size();
    if (distances.empty()) return stats;
    for (const double d : distances) {
        stats.mean += d;
        stats.rms += d * d;
        stats.max = std::max(stats.max, d);
    }
    stats.mean /= double(distances.size());
    stats.rms = std::sqrt(stats.rms / double(distances.size()));
    const std::size_t rank = std::size_t(std::ceil(0.999 * double(distances.size()))) - 1;
    std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(rank), distances.end());
    stats.p999 = distances[rank];
    return stats;
}

DistanceStats measure(const Mesh& from, const SurfaceIndex& from_index, const Mesh& to,
                      const SurfaceIndex& to_index, const DeviationOptions& options) {
    const Samples samples = sample(from, options.samples);
    const std::size_t count = samples.points.size();
    const std::vector<char> counts = options.visible_only
                                         ? visible(from_index, samples.look_from, options.directions)
                                         : std::vector<char>(count, 1);

    std::vector<SurfaceIndex::Nearest> nearest(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
        if (counts[i]) nearest[i] = to_index.nearest(samples.points[i].position);
    });

    std::vector<double> distances;
    double degrees = 0;
    std::size_t angles = 0;
    for (std::size_t i = 0; i < count; ++i) { // in order: the sums are the same on any number of threads
        if (!counts[i]) continue;
        distances.push_back(nearest[i].distance);
        const glm::dvec3& own = samples.points[i].normal;
        const glm::dvec3 other = area_normal(to, to.triangles[nearest[i].triangle]);
        if (i >= samples.first_vertex || own == glm::dvec3(0) || other == glm::dvec3(0)) continue;
        degrees += angle_degrees(own, other);
        ++angles;
    }
    DistanceStats stats = summary(distances);
    stats.hidden = count - stats.points;
    stats.normal_mean_degrees = angles ? degrees / double(angles) : 0;
    return stats;
}

double diagonal(const Mesh& mesh) {
    glm::dvec3 low(mesh.positions.at(0)), high(low);
    for (const glm::dvec3& p : mesh.positions) low = min(low, p), high = max(high, p);
    return glm::length(high - low);
}

} // namespace

std::vector<SurfacePoint> sample_by_area(const Mesh& mesh, std::size_t samples) {
    std::vector<SurfacePoint> points;
    for (const AreaSample& s : area_samples(mesh, samples)) points.push_back({s.position, s.normal});
    return points;
}

std::vector<double> distances_to(const Mesh& surface, std::span<const glm::dvec3> points) {
    const SurfaceIndex index(surface);
    std::vector<double> distances(points.size());
    tbb::parallel_for(std::size_t(0), points.size(),
                      [&](std::size_t i) { distances[i] = index.nearest(points[i]).distance; });
    return distances;
}

std::vector<char> visible_points(const Mesh& mesh, std::span<const SurfacePoint> points, int directions) {
    return visible(SurfaceIndex(mesh), points, directions);
}

Deviation deviation(const Mesh& a, const Mesh& b, const DeviationOptions& options) {
    const SurfaceIndex index_a(a), index_b(b);
    Deviation result;
    result.a_to_b = measure(a, index_a, b, index_b, options);
    result.b_to_a = measure(b, index_b, a, index_a, options);
    result.diagonal_a = diagonal(a);
    return result;
}

} // namespace glcast
