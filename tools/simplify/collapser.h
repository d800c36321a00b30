// The run of edge collapses behind simplify(). Internal.
#pragma once
#include <cstdint>
#include <memory>

#include "tools/mesh/mesh.h"

namespace glcast {

class Collapser {
  public:
    /// What is left of the mesh: `sources` names for every vertex one of the original it came from, near it.
    struct Remainder {
        std::vector<glm::dvec3> positions;
        std::vector<std::uint32_t> sources;
        std::vector<std::uint32_t> became; ///< for every vertex of the original, which one it was merged into
        std::vector<Triangle> triangles;
    };

    /// As many as may be left.
    struct Limit {
        std::size_t triangles = SIZE_MAX, edges = SIZE_MAX;
    };

    /// `mesh` must be a two-manifold, closed or with boundaries, and must outlive this.
    explicit Collapser(const Mesh& mesh);
    ~Collapser();

    /// Collapse edges, cheapest first, until the limit is kept, or no edge may collapse.
    void reduce_to(const Limit& limit);
    Remainder remainder();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace glcast
