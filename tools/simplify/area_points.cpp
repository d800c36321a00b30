#include "tools/simplify/area_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/simplify/corners.h"

namespace glcast {
namespace {

/// Of what is not negative: std::fmod(x, 1), which takes far longer.
double fraction(double x) { return x - std::floor(x); }

} // namespace

SurfaceArea::SurfaceArea(const Mesh& mesh) : surface(mesh), up_to(mesh.triangles.size()) {
    tbb::parallel_for(std::size_t(0), up_to.size(), [&](std::size_t t) {
        up_to[t] = glm::length(Corners(surface, surface.triangles[t]).normal());
    });
    std::partial_sum(up_to.begin(), up_to.end(), up_to.begin()); // in one order
}

std::vector<AreaPoint> area_points(const SurfaceArea& over, std::size_t count) {
    const double all = 2 * over.total();
    std::vector<AreaPoint> points;
    if (!(all > 0)) return points;
    points.resize(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
        const double before = (double(i) + 0.5) * all / double(count);
        const auto found = std::upper_bound(over.up_to.begin(), over.up_to.end(), before);
        const auto triangle = std::min(std::size_t(found - over.up_to.begin()), over.up_to.size() - 1);
        const double k = double(i + 1);
        double u = fraction(0.5 + k * 0.7548776662466927), v = fraction(0.5 + k * 0.5698402909980532);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        points[i] = {std::uint32_t(triangle), {1 - u - v, u, v}};
    });
    return points;
}

} // namespace glcast
