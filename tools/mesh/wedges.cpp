#include "tools/mesh/wedges.h"

#include <algorithm>

namespace glcast {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// Hands out wedges to corners.
class Joiner {
  public:
    Joiner(Mesh& mesh, const CornerValues& normals, const CornerValues& colours)
        : mesh(mesh), normals(normals), colours(colours), first(mesh.positions.size(), none) {
        if (!normals.empty()) mesh.normals.resize(first.size(), glm::vec3(0, 0, 1));
        if (!colours.empty()) mesh.colours.resize(first.size(), glm::vec3(0));
    }

    std::uint32_t wedge_for(std::size_t triangle, std::size_t corner) {
        const std::uint32_t vertex = mesh.triangles[triangle][corner];
        std::uint32_t last = none;
        for (std::uint32_t w = first[vertex]; w != none; last = w, w = next[w])
            if (is(w, triangle, corner)) return w;
        const auto made = std::uint32_t(next.size());
        next.push_back(none);
        if (!normals.empty()) wedges.normals.push_back(normals[triangle][corner]);
        if (!colours.empty()) wedges.colours.push_back(colours[triangle][corner]);
        if (last != none) {
            next[last] = made;
            any_with_two = true;
            return made;
        }
        first[vertex] = made;
        if (!normals.empty()) mesh.normals[vertex] = normals[triangle][corner];
        if (!colours.empty()) mesh.colours[vertex] = colours[triangle][corner];
        return made;
    }
    Wedges wedges;
    bool any_with_two = false;

  private:
    bool is(std::uint32_t wedge, std::size_t triangle, std::size_t corner) const {
        return (normals.empty() || wedges.normals[wedge] == normals[triangle][corner]) &&
               (colours.empty() || wedges.colours[wedge] == colours[triangle][corner]);
    }

    Mesh& mesh;
    const CornerValues &normals, &colours;
    std::vector<std::uint32_t> first, next; ///< wedge of each vertex; the next one of the same
};

} // namespace

Wedges take_corner_values(Mesh& mesh, const CornerValues& normals, const CornerValues& colours) {
    Joiner joiner(mesh, normals, colours);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle& corners = joiner.wedges.corners.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) corners[k] = joiner.wedge_for(t, k);
    }
    return joiner.any_with_two ? std::move(joiner.wedges) : Wedges{};
}

bool fits(const Mesh& mesh, const Wedges& wedges) {
    if (wedges.empty()) return wedges.normals.empty() && wedges.colours.empty();
    if (wedges.corners.size() != mesh.triangles.size()) return false;
    const std::size_t normals = wedges.normals.size(), colours = wedges.colours.size();
    if (normals && colours && normals != colours) return false;
    const std::size_t count = std::max(normals, colours);
    return std::all_of(wedges.corners.begin(), wedges.corners.end(),
                       [&](const Triangle& t) { return t[0] < count && t[1] < count && t[2] < count; });
}

} // namespace glcast
