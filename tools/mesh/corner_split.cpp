#include "tools/mesh/corner_split.h"

#include <stdexcept>

namespace glcast {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// A value per corner of one kind, and per vertex of the split.
template <class Value> class Kind {
  public:
    Kind(std::vector<Value>& out, std::size_t vertices, bool given, const Value& otherwise) : out(out), given(given) {
        if (given) out.resize(vertices, otherwise);
    }
    bool is(std::uint32_t vertex, const Value& value) const { return !given || out[vertex] == value; }
    void set(std::uint32_t vertex, const Value& value) {
        if (given) out[vertex] = value;
    }
    void add(const Value& value) {
        if (given) out.push_back(value);
    }

  private:
    std::vector<Value>& out;
    bool given;
};

struct Corner {
    glm::vec3 normal{0}, colour{0};
    glm::vec2 at{0};
    glm::vec4 tangent{1, 0, 0, 1};
};

/// Hands out vertices to corners.
class Splitter {
  public:
    Splitter(const Mesh& mesh, const Texture& texture, const Wedges& wedges, CornerSplit& split)
        : split(split), count(mesh.positions.size()), taken(count), next(count, none),
          normals(split.normals, count, !wedges.normals.empty(), glm::vec3(0, 0, 1)),
          colours(split.colours, count, !wedges.colours.empty(), glm::vec3(0)),
          coordinates(split.coordinates, count, !texture.empty(), glm::vec2(0)),
          tangents(split.tangents, count, !texture.empty(), glm::vec4(1, 0, 0, 1)) {}

    /// The vertex, or the copy of it, with the values of a corner; made when there is none.
    std::uint32_t vertex_for(std::uint32_t vertex, const Corner& corner) {
        if (!taken[vertex]) {
            taken[vertex] = true;
            normals.set(vertex, corner.normal), colours.set(vertex, corner.colour);
            coordinates.set(vertex, corner.at), tangents.set(vertex, corner.tangent);
            return vertex;
        }
        std::uint32_t last = vertex;
        for (std::uint32_t v = vertex; v != none; last = v, v = next[v])
            if (normals.is(v, corner.normal) && colours.is(v, corner.colour) && coordinates.is(v, corner.at) &&
                tangents.is(v, corner.tangent))
                return v;
        if (next.size() >= none) throw std::runtime_error("the level has too many seams");
        next[last] = static_cast<std::uint32_t>(next.size());
        next.push_back(none);
        split.originals.push_back(vertex);
        normals.add(corner.normal), colours.add(corner.colour);
        coordinates.add(corner.at), tangents.add(corner.tangent);
        return next[last];
    }

  private:
    CornerSplit& split;
    std::size_t count;
    std::vector<bool> taken;         ///< vertices of the mesh that some corner has
    std::vector<std::uint32_t> next; ///< of vertices and copies: the next copy of the same vertex
    Kind<glm::vec3> normals, colours;
    Kind<glm::vec2> coordinates;
    Kind<glm::vec4> tangents;
};

void check(const Mesh& mesh, const Texture& texture, const Wedges& wedges) {
    const std::size_t triangles = mesh.triangles.size();
    if (!texture.empty() && (texture.coordinates.size() != triangles ||
                             (!texture.tangents.empty() && texture.tangents.size() != triangles)))
        throw std::runtime_error("the texture is not one of its mesh");
    if (!fits(mesh, wedges)) throw std::runtime_error("the wedges are not those of the mesh");
}

} // namespace

CornerSplit split_corners(const Mesh& mesh, const Texture& texture, const Wedges& wedges) {
    check(mesh, texture, wedges);
    CornerSplit split;
    split.triangles = mesh.triangles;
    if (texture.empty() && wedges.empty()) return split;
    Splitter splitter(mesh, texture, wedges, split);
    for (std::size_t t = 0; t < split.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            Corner corner;
            if (!wedges.normals.empty()) corner.normal = wedges.normals[wedges.corners[t][k]];
            if (!wedges.colours.empty()) corner.colour = wedges.colours[wedges.corners[t][k]];
            if (!texture.empty()) corner.at = texture.coordinates[t][k];
            if (!texture.tangents.empty()) corner.tangent = texture.tangents[t][k];
            split.triangles[t][k] = splitter.vertex_for(split.triangles[t][k], corner);
        }
    return split;
}

} // namespace glcast
