#include "tools/texture/neighbours.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

/// The one corner at a whose triangle has the edge from a to b; no_triangle when there is none or more than
/// one.
std::uint32_t with_edge(const Mesh& mesh, const Neighbours& made, std::uint32_t a, std::uint32_t b) {
    std::uint32_t found = no_triangle;
    for (std::uint32_t corner : made.around(a)) {
        const Triangle& t = mesh.triangles[corner / 3];
        if (t[(corner % 3 + 1) % 3] != b) continue;
        if (found != no_triangle) return no_triangle;
        found = corner;
    }
    return found;
}

/// Both triangles of an edge at once, from the side on which it goes to the larger vertex.
void join_along(const Mesh& mesh, Neighbours& made, std::uint32_t t, std::uint32_t k) {
    const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
    if (a >= b || with_edge(mesh, made, a, b) != 3 * t + k) return;
    const std::uint32_t back = with_edge(mesh, made, b, a);
    if (back == no_triangle) return;
    made.across[t][k] = back / 3;
    made.across[back / 3][back % 3] = t;
}

} // namespace

Neighbours find_neighbours(const Mesh& mesh) {
    Neighbours made;
    const std::size_t triangles = mesh.triangles.size();
    made.start.assign(mesh.positions.size() + 1, 0);
    for (const Triangle& t : mesh.triangles)
        for (std::uint32_t v : t) ++made.start[v + 1];
    for (std::size_t v = 1; v < made.start.size(); ++v) made.start[v] += made.start[v - 1];
    made.corners.resize(3 * triangles);
    std::vector<std::uint32_t> next(made.start.begin(), made.start.end() - 1);
    for (std::uint32_t t = 0; t < triangles; ++t)
        for (std::uint32_t k = 0; k < 3; ++k) made.corners[next[mesh.triangles[t][k]]++] = 3 * t + k;
    made.across.assign(triangles, {no_triangle, no_triangle, no_triangle});
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, std::uint32_t(triangles), 4096),
                      [&](const auto& range) {
                          for (std::uint32_t t = range.begin(); t < range.end(); ++t)
                              for (std::uint32_t k = 0; k < 3; ++k) join_along(mesh, made, t, k);
                      });
    return made;
}

} // namespace glcast
