// All six views and layers of a triangle mesh, by exact sampling at pixel centres: no GL.
#pragma once
#include <vector>

#include "capture/view_image.h"
#include "tools/mesh/mesh.h"

namespace glcast::test {

/// Hits nearer to one another than 1/1000 sample are one, as in a capture. Images as in cast_layers().
std::vector<ViewImage> cast_mesh(const Mesh& mesh, const Box& box, int n);
/// The smallest cube about the mesh with two samples of margin at n.
Box box_around(const Mesh& mesh, int n);

} // namespace glcast::test
