// Quadric edge collapse (Garland and Heckbert 1997) by OpenMesh.
#pragma once
#include "tools/mesh/mesh.h"

namespace glcast {

struct SimplifyTarget {
    enum class Unit { edges, triangles, ratio } unit = Unit::triangles;
    double value = 0; ///< ratio: share of the triangles to keep, 0..1
};

/// A closed two-manifold with at most the asked number of edges or triangles, or as few as collapses that keep it
/// manifold allow; colours and normals follow the surface. Needs a closed two-manifold.
Mesh simplify(const Mesh& mesh, const SimplifyTarget& target);

} // namespace glcast
