// Points spread evenly over a surface. Internal.
#pragma once
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast {

/// Where a share of a surface's area lies.
struct SurfaceArea {
    const Mesh& surface;
    std::vector<double> up_to; ///< twice the area of the triangles up to each, it included

    explicit SurfaceArea(const Mesh& mesh); ///< `mesh` must outlive this
    double total() const { return up_to.empty() ? 0 : up_to.back() / 2; }
};

struct AreaPoint {
    std::uint32_t triangle = 0;
    glm::dvec3 weights{1, 0, 0}; ///< of its corners
};

/// So many, in the order of the triangles; none where there is no area. Within a triangle they follow
/// Roberts's R2 sequence, folded.
std::vector<AreaPoint> area_points(const SurfaceArea& over, std::size_t count);

} // namespace glcast
