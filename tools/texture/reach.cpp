#include "tools/texture/reach.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

constexpr double least_reach = 1.5; // samples
constexpr double most_triangles = 0.95;
constexpr std::size_t most_probes = 5000;

} // namespace

double needed_reach(const Mesh& mesh, const CapturedSurface& captured,
                    const std::vector<glm::vec3>& normals) {
    const std::size_t step = 1 + mesh.triangles.size() / most_probes;
    std::vector<double> far((mesh.triangles.size() + step - 1) / step, -1);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, far.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const std::size_t t = i * step;
            if (normals[t] == glm::vec3(0)) continue;
            const Triangle& v = mesh.triangles[t];
            const glm::dvec3 middle =
                (mesh.positions[v[0]] + mesh.positions[v[1]] + mesh.positions[v[2]]) / 3.0;
            const CapturedPoint seen =
                captured.find(middle, normals[t], normals[t], captured.default_reach());
            if (seen.found) far[i] = glm::distance(seen.position, middle) / captured.sample();
        }
    });
    std::erase(far, -1);
    if (far.empty()) return least_reach;
    const auto most = far.begin() + std::ptrdiff_t(most_triangles * double(far.size() - 1));
    std::nth_element(far.begin(), most, far.end());
    return std::clamp(2 * *most, least_reach, captured.default_reach());
}

} // namespace glcast
