// Closed bodies with a known shape and genus, for tests that need many meshes.
#pragma once
#include <functional>
#include <string>

#include "tools/mesh/mesh.h"

namespace glcast::test {

Mesh sphere(double radius, int subdivisions, const glm::dvec3& centre = glm::dvec3(0)); ///< 20·4^k triangles
Mesh torus(double major, double minor, int around, int across);                         ///< about z
Mesh cube(double edge, int cells); ///< cells² squares a side
/// The squares between filled and empty cells of a grid; no two cells may touch in an edge or a corner alone.
Mesh blocks(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled);
Mesh plate_with_holes(int holes); ///< genus `holes`
Mesh tetrahedron();

Mesh joined(Mesh a, const Mesh& b); ///< both, as one mesh of more components
Mesh turned_inside_out(Mesh mesh);
void paint(Mesh& mesh, const std::function<glm::vec3(const glm::dvec3&)>& colour);

struct NamedBody {
    std::string name;
    Mesh mesh;
    long euler; ///< V - E + F
    std::size_t components;
};
/// Bodies of every kind: round, flat, with handles, nested, touching, thin, tiny, huge and far away.
std::vector<NamedBody> bodies();

} // namespace glcast::test
