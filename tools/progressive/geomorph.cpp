#include "tools/progressive/geomorph.h"

#include <glm/geometric.hpp>
#include <numeric>
#include <stdexcept>

namespace glcast {
namespace {

/// Off the ends the nearer of the two where they cancel out.
glm::vec3 between(const glm::vec3& a, const glm::vec3& b, double fraction) {
    const glm::dvec3 sum = (1 - fraction) * glm::dvec3(a) + fraction * glm::dvec3(b);
    const double length = glm::length(sum);
    return length > 1e-6 ? glm::vec3(sum / length) : fraction < 0.5 ? a : b;
}

} // namespace

Geomorph::Geomorph(ProgressiveMesh& mesh, std::size_t coarse, std::size_t fine) {
    if (coarse > fine || fine > mesh.splits())
        throw std::runtime_error("a geomorph goes from a level to a finer one of the same progressive mesh");
    const std::size_t before = mesh.level();
    mesh.refine_to(coarse);
    from = mesh.mesh();
    std::vector<std::uint32_t> came_from(mesh.vertices(fine)); // by number: the index in `from`
    const std::vector<std::uint32_t> coarse_order = mesh.vertex_order();
    for (std::size_t v = 0; v < coarse_order.size(); ++v) came_from[coarse_order[v]] = std::uint32_t(v);
    for (std::size_t split = coarse; split < fine; ++split)
        came_from[mesh.vertices(split)] = came_from[mesh.kept_of(split)];
    mesh.refine_to(fine);
    to = mesh.mesh();
    for (const std::uint32_t number : mesh.vertex_order()) ancestor.push_back(came_from[number]);
    mesh.refine_to(before);
}

Mesh Geomorph::at(double fraction) const {
    if (!(fraction >= 0 && fraction <= 1)) throw std::runtime_error("the fraction of a geomorph is 0 to 1");
    Mesh mesh = to;
    if (fraction == 1) return mesh;
    for (std::size_t v = 0; v < ancestor.size(); ++v) {
        const std::uint32_t a = ancestor[v];
        const auto blend = [&](auto& mine, const auto& its) {
            using T = std::decay_t<decltype(mine)>;
            mine = fraction == 0 ? its : T((1 - fraction) * glm::dvec3(its) + fraction * glm::dvec3(mine));
        };
        blend(mesh.positions[v], from.positions[a]);
        if (!mesh.colours.empty()) blend(mesh.colours[v], from.colours[a]);
        if (!mesh.normals.empty())
            mesh.normals[v] =
                fraction == 0 ? from.normals[a] : between(from.normals[a], mesh.normals[v], fraction);
    }
    return mesh;
}

} // namespace glcast
