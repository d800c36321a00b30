// Meshes that the programs drew, where they are known.
#pragma once
#include <string>

#include "tools/mesh/mesh.h"

namespace glcast::pictures {

/// teapot, spheres (of the fixtures), t.obj (as osgviewer shows it), in the axes of their captures, with
/// normals; colours where the mesh itself has them. Throws std::invalid_argument on another name.
Mesh original(const std::string& name);

} // namespace glcast::pictures
