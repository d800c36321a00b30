// Distances and topology, measured independently of the code under test.
#pragma once
#include <ostream>

#include "tests/reconstruct/bodies.h"
#include "tools/mesh/mesh.h"

namespace glcast::test {

struct Distance {
    double mean = 0, max = 0;
    std::size_t points = 0;
};

/// From points all over the mesh (vertices, edge and face middles) to the body, and back from points of the
/// body that an axis ray sees; in samples.
Distance mesh_to_body(const Mesh& mesh, const Body& body, double sample);
Distance points_to_mesh(const std::vector<glm::dvec3>& points, const Mesh& mesh, double sample);

struct Topology {
    std::size_t bad_edges = 0, bad_vertices = 0, components = 0, unused = 0;
    long euler = 0;
    double volume = 0;
    bool closed() const { return bad_edges == 0 && bad_vertices == 0 && unused == 0; }
};
std::ostream& operator<<(std::ostream& out, const Topology& t);
Topology topology(const Mesh& mesh);

} // namespace glcast::test
