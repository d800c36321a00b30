// Other people's simplification, for comparison: each takes a closed mesh and leaves about so many triangles.
#pragma once
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::test {

struct SimplifyPeerResult {
    Mesh mesh;          ///< positions and triangles
    double cpu_seconds; ///< of the collapses alone, the mesh in the peer's own form before
};

struct SimplifyPeer {
    const char* name;
    SimplifyPeerResult (*run)(const Mesh& mesh, std::size_t triangles);
};

/// OpenMesh's decimater with quadrics, CGAL by Garland and Heckbert and by Lindstrom and Turk, meshoptimizer.
const std::vector<SimplifyPeer>& simplify_peers();

} // namespace glcast::test
