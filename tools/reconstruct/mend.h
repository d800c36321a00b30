// A surface that does not pass through itself: where triangles meet, vertices give way.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

class CaptureFrame;
struct CellGrid;
struct QuadReport;
struct Rays;

struct MendReport {
    std::size_t suspects = 0;           ///< quads that the proof does not cover, so that they were looked at
    std::size_t intersections = 0;      ///< pairs of triangles that met before mending
    std::size_t rounds = 0;             ///< of moving and looking again
    std::array<std::size_t, 7> moved{}; ///< vertices by the rung that they ended on (vertices.h)
};

/// Moves positions (samples) until no two triangles meet elsewhere than where they are joined, exact for the
/// positions that `frame` makes of them. The same for any number of threads.
MendReport mend_intersections(const Rays& rays, const CellGrid& grid, const QuadReport& quads,
                              std::span<const Triangle> triangles, const CaptureFrame& frame,
                              std::vector<glm::dvec3>& positions);

} // namespace glcast
