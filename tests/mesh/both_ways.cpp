#include "tests/mesh/both_ways.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "tools/deviation/deviation.h"
#include "tools/deviation/surface_index.h"
#include "tools/mesh/intersections.h"

namespace glcast::test {
namespace {

std::vector<glm::dvec3> spread(const Mesh& mesh, std::size_t count) {
    std::vector<glm::dvec3> points;
    for (const SurfacePoint& p : sample_by_area(mesh, count)) points.push_back(p.position);
    return points;
}

BothWays::Way distances(const std::vector<glm::dvec3>& points, const std::vector<glm::dvec3>& vertices,
                        const SurfaceIndex& to) {
    std::vector<double> found(points.size() + vertices.size());
    tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t i) {
        found[i] = to.nearest(i < points.size() ? points[i] : vertices[i - points.size()]).distance;
    });
    BothWays::Way way;
    for (std::size_t i = 0; i < points.size(); ++i) way.mean += found[i] / double(points.size());
    for (const double d : found) way.most = std::max(way.most, d);
    return way;
}

} // namespace

BothWaysMeter::BothWaysMeter(const Mesh& of, std::size_t count)
    : surface(of), points(count), index(std::make_unique<SurfaceIndex>(of)), on_surface(spread(of, count)) {}
BothWaysMeter::~BothWaysMeter() = default;

BothWays BothWaysMeter::measure(const Mesh& level) const {
    return {distances(on_surface, surface.positions, SurfaceIndex(level)),
            distances(spread(level, points), level.positions, *index)};
}

Faults faults_of(const Mesh& level) {
    Faults faults;
    faults.crossings = count_self_intersections(level.positions, level.triangles);
    std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> by_edge;
    const double back_to_back = -std::cos(std::numbers::pi / 180);
    for (const Triangle& t : level.triangles) {
        const glm::dvec3 &a = level.positions[t[0]], &b = level.positions[t[1]], &c = level.positions[t[2]];
        const glm::dvec3 normal = cross(b - a, c - a);
        const double squares = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
        faults.slivers += 2 * std::sqrt(3.0) * length(normal) < 1e-4 * squares;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            by_edge[{from, to}] = normal;
            const auto back = by_edge.find({to, from});
            if (back == by_edge.end()) continue;
            const double lengths = length(normal) * length(back->second);
            faults.folds += lengths > 0 && dot(normal, back->second) < back_to_back * lengths;
        }
    }
    return faults;
}

} // namespace glcast::test
