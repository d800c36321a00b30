// The models of the paper's tables, as meshes that a simplifier can take and a program can draw.
#pragma once
#include "tools/mesh/mesh.h"

namespace glcast::paper {

/// The GLUT teapot of 32 patches, 6.43 wide, `cells` squares along each side of a patch, as triangles;
/// vertices at one place are one, so that it is a two-manifold with boundaries (four open parts). With
/// `flat_bottom` a patch of the bottom is one cell from the middle to its rim: 3 cells make 780 edges then.
Mesh teapot(int cells, bool flat_bottom = false);

/// The fixture's five spheres (48 x 96 squares times `fineness` each), one inside another as they stand.
Mesh spheres(int fineness);

/// What solid modelling makes of those spheres: the boundary of their union, computed by CGAL with exact
/// predicates and exact constructions, closed, colours left out.
Mesh spheres_union(int fineness);

/// Vertices at the same place become one; normals and colours go, triangles without area too.
Mesh welded(const Mesh& mesh);

} // namespace glcast::paper
