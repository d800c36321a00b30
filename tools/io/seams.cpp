#include "tools/io/seams.h"

#include <stdexcept>

namespace glcast::format {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// Hands out vertices to corners.
class Splitter {
  public:
    Splitter(const Level& level, SeamSplit& split) : texture(level.texture), split(split) {
        const std::size_t count = level.mesh.positions.size();
        split.coordinates.resize(count, glm::vec2(0));
        split.tangents.resize(count, glm::vec4(1, 0, 0, 1));
        taken.resize(count, false);
        next.resize(count, none);
    }

    /// The vertex, or the copy of it, with the coordinates and the tangent of a corner; made when there is
    /// none.
    std::uint32_t vertex_for(std::uint32_t vertex, std::size_t triangle, int corner) {
        const glm::vec2& at = texture.coordinates[triangle][corner];
        const glm::vec4& tangent = texture.tangents[triangle][corner];
        if (!taken[vertex]) {
            taken[vertex] = true;
            split.coordinates[vertex] = at, split.tangents[vertex] = tangent;
            return vertex;
        }
        std::uint32_t last = vertex;
        for (std::uint32_t v = vertex; v != none; last = v, v = next[v])
            if (split.coordinates[v] == at && split.tangents[v] == tangent) return v;
        if (next.size() >= none) throw std::runtime_error("the texture has too many seams");
        next[last] = static_cast<std::uint32_t>(next.size());
        next.push_back(none);
        split.originals.push_back(vertex);
        split.coordinates.push_back(at), split.tangents.push_back(tangent);
        return next[last];
    }

  private:
    const Texture& texture;
    SeamSplit& split;
    std::vector<bool> taken;         ///< vertices of the mesh that some corner has
    std::vector<std::uint32_t> next; ///< of vertices and copies: the next copy of the same vertex
};

} // namespace

SeamSplit split_along_seams(const Level& level) {
    SeamSplit split;
    split.triangles = level.mesh.triangles;
    if (level.texture.empty()) return split;
    if (level.texture.coordinates.size() != level.mesh.triangles.size() ||
        level.texture.tangents.size() != level.mesh.triangles.size())
        throw std::logic_error("a texture of another mesh");
    Splitter splitter(level, split);
    for (std::size_t t = 0; t < split.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) split.triangles[t][k] = splitter.vertex_for(split.triangles[t][k], t, k);
    return split;
}

bool are_copies(const Mesh& mesh, std::span<const std::uint32_t> originals) {
    if (originals.size() >= mesh.positions.size()) return false;
    const std::size_t first = mesh.positions.size() - originals.size();
    for (std::size_t k = 0; k < originals.size(); ++k)
        if (originals[k] >= first || mesh.positions[originals[k]] != mesh.positions[first + k]) return false;
    return true;
}

void join_copies(Mesh& mesh, std::span<const std::uint32_t> originals) {
    const std::size_t first = mesh.positions.size() - originals.size();
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t)
            if (v >= first) v = originals[v - first];
    mesh.positions.resize(first);
    if (mesh.normals.size() > first) mesh.normals.resize(first);
    if (mesh.colours.size() > first) mesh.colours.resize(first);
}

} // namespace glcast::format
