// Colours and normals for vertices that have moved along or off a surface. Internal.
#pragma once
#include <span>

#include "tools/mesh/mesh.h"

namespace glcast {

/// Finds the nearest point of a surface by walking along it from a vertex nearby, so that it never jumps to
/// the other side of a thin sheet or to another part, as a search through space would.
class SurfaceWalk {
  public:
    explicit SurfaceWalk(const Mesh& mesh); ///< `mesh` must outlive this

    /// The attributes of the surface at `positions[i]`, walking from vertex `starts[i]`. A colour is always
    /// the colour of one vertex: mixing would invent colours where parts meet. Normals, of the surface's
    /// vertices, are interpolated.
    void take_attributes(Mesh& into, const std::vector<std::uint32_t>& starts,
                         const std::vector<glm::vec3>& normals) const;

    struct Place {
        std::uint32_t triangle = 0;
        glm::dvec3 weights{1, 0, 0}; ///< of its corners
    };
    /// Of the surface's points the nearest that a walk downhill from vertex `start` comes to.
    Place nearest(const glm::dvec3& point, std::uint32_t start) const;
    glm::dvec3 nearest_point(const glm::dvec3& point, std::uint32_t start) const;

    /// The triangles at a vertex.
    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        return {incident.data() + first[vertex], first[vertex + 1] - first[vertex]};
    }

  private:
    double improve(const glm::dvec3& point, std::uint32_t vertex, double best, Place& place) const;

    const Mesh& mesh;
    std::vector<std::uint32_t>
        first; ///< per vertex, where its triangles begin in `incident`; one more at the end
    std::vector<std::uint32_t> incident;
};

} // namespace glcast
