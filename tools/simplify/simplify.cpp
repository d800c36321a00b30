#include "tools/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tools/mesh/check.h"
#include "tools/simplify/attributes.h"
#include "tools/simplify/collapser.h"

namespace glcast {
namespace {

/// The most triangles that fulfil the target. A closed mesh has three edges to two triangles.
std::size_t triangles_wanted(const SimplifyTarget& target, std::size_t have) {
    using Unit = SimplifyTarget::Unit;
    if (!(target.value >= 0) || (target.unit == Unit::ratio && target.value > 1))
        throw std::runtime_error("cannot simplify: the target must be 0 or more, and a ratio 1 or less");
    const double wanted = target.unit == Unit::edges       ? std::floor(target.value / 3) * 2
                          : target.unit == Unit::triangles ? std::floor(target.value)
                                                           : std::floor(target.value * double(have));
    return wanted >= double(have) ? have : std::size_t(wanted);
}

void require_closed_manifold(const Mesh& mesh) {
    const MeshCheck check = check_mesh(mesh);
    if (!check.closed_manifold())
        throw std::runtime_error("cannot simplify: not a closed two-manifold (" +
                                 std::to_string(check.boundary_edges) + " boundary edges, " +
                                 std::to_string(check.non_manifold_edges) + " non-manifold edges, " +
                                 std::to_string(check.non_manifold_vertices) + " non-manifold vertices)");
}

Mesh finished(Collapser::Remainder&& remainder, const SurfaceWalk& surface) {
    Mesh mesh;
    mesh.positions = std::move(remainder.positions);
    mesh.triangles = std::move(remainder.triangles);
    surface.take_attributes(mesh, remainder.sources);
    if (!check_mesh(mesh).closed_manifold())
        throw std::logic_error("simplify made a mesh that is not a closed two-manifold: a bug in glcast");
    return mesh;
}

} // namespace

std::vector<Mesh> simplify_levels(const Mesh& mesh, std::span<const SimplifyTarget> targets) {
    std::vector<std::size_t> wanted(targets.size()), order(targets.size());
    std::transform(targets.begin(), targets.end(), wanted.begin(),
                   [&](const SimplifyTarget& t) { return triangles_wanted(t, mesh.triangles.size()); });
    require_closed_manifold(mesh);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return wanted[a] > wanted[b]; });

    std::vector<Mesh> levels(targets.size(), Mesh{});
    std::unique_ptr<Collapser> collapser;
    const SurfaceWalk surface(mesh);
    for (const std::size_t level : order) {
        if (wanted[level] >= mesh.triangles.size()) {
            levels[level] = mesh;
            continue;
        }
        if (!collapser) collapser = std::make_unique<Collapser>(mesh);
        collapser->reduce_to(wanted[level]);
        levels[level] = finished(collapser->remainder(), surface);
    }
    return levels;
}

Mesh simplify(const Mesh& mesh, const SimplifyTarget& target) {
    return std::move(simplify_levels(mesh, {&target, 1}).front());
}

} // namespace glcast
