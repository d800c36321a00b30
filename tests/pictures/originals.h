// Meshes that the programs drew, where they are known, and what other people's simplifiers make of them.
#pragma once
#include <string>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::pictures {

/// teapot, spheres (of the fixtures), t.obj (as osgviewer shows it), in the axes of their captures, with
/// normals; colours where the mesh itself has them. Throws std::invalid_argument on another name.
Mesh original(const std::string& name);

struct Simplifier {
    const char* name;
    /// Triangles with positions alone, those at one place joined: a mesh with boundaries.
    Mesh (*simplify)(const Mesh& mesh, std::size_t triangles);
};
/// OpenMesh's DecimaterT with ModQuadricT, meshopt_simplify, CGAL's edge_collapse as they come.
const std::vector<Simplifier>& simplifiers();

/// At most `triangles`; normals and colours are those of the nearest point of the original.
Mesh simplified_original(const Mesh& original, const Simplifier& simplifier, std::size_t triangles);

} // namespace glcast::pictures
