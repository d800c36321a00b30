// OpenMesh's progressive mesh, .pm: what its ModProgMesh writes and its ProgViewer and Analyzer read.
#pragma once
#include "capture/output_file.h"
#include "tools/progressive/progressive_mesh.h"

namespace glcast {

/// Positions as floats and connectivity; the format holds no colours and normals. A vertex of a .pm never
/// moves, so every vertex of every level stands where a vertex of the original does: of the two that a split
/// parts, the one nearer to where the coarser level has its vertex stays, the other comes. Fully refined it
/// is the original. Levels between have the same connectivity as ours, other positions. The mesh is left at
/// the level that it was at. Throws std::runtime_error, one line, where a split brings no triangle, or more
/// than two, or two on one side.
void write_openmesh_pm(OutputFile& file, ProgressiveMesh& mesh);

} // namespace glcast
