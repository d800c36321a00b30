// Self-intersections in the opinion of CGAL, with exact predicates.
#pragma once
#include <vector>

#include "tools/mesh/intersections.h"

namespace glcast::test {

/// Of a soup whose triangles are joined where they share a vertex by index.
std::vector<TrianglePair> cgal_self_intersections(const Mesh& mesh);

} // namespace glcast::test
