// Normals and colours by corner.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

/// What corners of a vertex share: a vertex has as many wedges as it shows normals or colours, at a crease or where
/// colours meet (Hoppe 1998, "Efficient implementation of progressive meshes"). The mesh stays the two-manifold that
/// it is; a file format that wants all per vertex splits vertices when it writes.
struct Wedges {
    std::vector<Triangle> corners;  ///< of each triangle, the wedge of each corner; no wedge is of two vertices
    std::vector<glm::vec3> normals; ///< by wedge, unit; empty: those of the vertices
    std::vector<glm::vec3> colours; ///< by wedge, display values, 0..1; empty: those of the vertices

    bool empty() const { return corners.empty(); } ///< normals and colours of the vertices are all there is
};

using CornerValues = std::vector<std::array<glm::vec3, 3>>; ///< by triangle

/// From a value for each corner: corners of a vertex that have the same are one wedge, and the vertex gets the values of
/// its first corner. Either list may be empty: then the mesh keeps what it has. Empty where no vertex has two wedges.
Wedges take_corner_values(Mesh& mesh, const CornerValues& normals, const CornerValues& colours);

/// Do they belong to the mesh: a wedge that there is for each corner?
bool fits(const Mesh& mesh, const Wedges& wedges);

inline bool has_normals(const Mesh& mesh, const Wedges& wedges) {
    return !mesh.normals.empty() || !wedges.normals.empty();
}
inline bool has_colours(const Mesh& mesh, const Wedges& wedges) {
    return !mesh.colours.empty() || !wedges.colours.empty();
}

/// The normals of a triangle's corners, of the wedges or else of the vertices. There must be some.
inline std::array<glm::vec3, 3> corner_normals(const Mesh& mesh, const Wedges& wedges, std::size_t triangle) {
    const std::vector<glm::vec3>& of = wedges.normals.empty() ? mesh.normals : wedges.normals;
    const Triangle& at = wedges.normals.empty() ? mesh.triangles[triangle] : wedges.corners[triangle];
    return {of[at[0]], of[at[1]], of[at[2]]};
}
/// Their colours, likewise.
inline std::array<glm::vec3, 3> corner_colours(const Mesh& mesh, const Wedges& wedges, std::size_t triangle) {
    const std::vector<glm::vec3>& of = wedges.colours.empty() ? mesh.colours : wedges.colours;
    const Triangle& at = wedges.colours.empty() ? mesh.triangles[triangle] : wedges.corners[triangle];
    return {of[at[0]], of[at[1]], of[at[2]]};
}

} // namespace glcast
