// Is a mesh a closed two-manifold? Used by every command that writes one.
#pragma once
#include <optional>
#include <string>

#include "tools/mesh/mesh.h"

namespace glcast {

struct MeshCheck {
    std::size_t vertices = 0, edges = 0, triangles = 0, components = 0;
    std::size_t boundary_edges = 0;     ///< edges with one triangle
    std::size_t non_manifold_edges = 0; ///< edges with more than two, or two that run the same way
    std::size_t non_manifold_vertices =
        0; ///< vertices whose triangles are not one fan (closed, or open at a boundary)
    std::size_t degenerate_triangles = 0; ///< two equal corners, or a corner that is no vertex
    std::size_t unused_vertices = 0;
    long euler = 0;              ///< V - E + F over used vertices and triangles that are not degenerate
    double volume = 0, area = 0; ///< signed volume: positive when triangles face outwards
    /// Pairs of triangles that meet elsewhere than where they are joined (intersections.h); unset when not
    /// counted.
    std::optional<std::size_t> self_intersections;
    bool more_self_intersections = false; ///< there are more than that: counting stopped

    bool closed_manifold() const {
        return triangles > 0 && boundary_edges == 0 && non_manifold_edges == 0 &&
               non_manifold_vertices == 0 && degenerate_triangles == 0;
    }
};

enum class CheckDepth {
    topology,   ///< one pass over the edges
    everything, ///< self-intersections too: some microseconds a triangle, all cores
};

/// O(triangles) memory and about linear time.
MeshCheck check_mesh(const Mesh& mesh, CheckDepth depth = CheckDepth::topology);

/// "closed two-manifold", or what is wrong with it: "3 boundary edges, 1 non-manifold vertex"; then, where
/// they were counted, ", no self-intersections" or how many.
std::string describe(const MeshCheck& check);

} // namespace glcast
