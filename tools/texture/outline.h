// Outlines of a level, laid along those of the captured surface.
#pragma once
#include "tools/mesh/mesh.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast {

/// Moves the vertices of a closed level so that its outlines, seen from anywhere, lie as near to those of the
/// surface as they can, and the level itself about as near as before: a texture hides what lies inside
/// outlines. The outline of a mesh runs along its convex edges, and the angle between the triangles that meet
/// there is the share of directions for which it does; so it needs no pictures. Moves of a few samples at
/// most; no triangle turns by more than 60 degrees, and none crosses another that it did not cross before.
/// Triangles, colours and normals stay. A level of more than 30,000 triangles is left as it is. The same
/// input gives the same positions, bit for bit, on any number of threads. False where nothing moved.
bool fit_outlines(Mesh& mesh, const CapturedSurface& captured);

} // namespace glcast
