// Meshes that the programs drew, where they are known, and what other people's simplifiers make of them.
#pragma once
#include <string>
#include <vector>

#include "tests/peers/simplify_peers.h"
#include "tools/mesh/mesh.h"

namespace glcast::pictures {

/// teapot, spheres (of the fixtures), t.obj (as osgviewer shows it), in the axes of their captures, with
/// normals; colours where the mesh itself has them. Throws std::invalid_argument on another name.
Mesh original(const std::string& name);

/// At most `triangles`; normals and colours are those of the nearest point of the original.
Mesh simplified_original(const Mesh& original, const test::SimplifyPeer& peer, std::size_t triangles);

} // namespace glcast::pictures
