// Other people's simplification, for comparison, with the settings of their own manuals: each takes a mesh,
// positions and triangles alone, those at one place joined, and leaves about so many triangles.
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
    const char* library;     ///< its name alone
    bool is_default = false; ///< what the library does when nothing is asked for
};

/// OpenMesh's DecimaterT with ModQuadricT, CGAL's edge_collapse by Garland and Heckbert and by Lindstrom and
/// Turk, meshopt_simplify.
const std::vector<SimplifyPeer>& simplify_peers();

} // namespace glcast::test
